// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A globe of tiles at depths of their own, some with parts loaded, and what OSG's rule shows of it from an eye.

#pragma once

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <glm/vec3.hpp>
#include <osg/Group>
#include <osg/LOD>

#include <cstddef>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin::test {

/// A tile of the globe, with its four parts when they are loaded.
struct DeepTile {
    core::Interval latitude, longitude;
    double surface = 0.0, low = 0.0, high = 0.0;  // metres
    float cutoff = 0.0f;                          // nearer than that its parts are shown
    glm::dvec3 center{0.0};
    std::vector<DeepTile> parts;
    bool isUncertain = false;  // all that is loaded may be shown
    osg::ref_ptr<AnalyticBinCullCallback> callback;
};

/// How the globe is made.
struct DeepTerrain {
    double deepShare = 0.1;
    double loadedShare = 0.6;
    double airShare = 0.5;  // of bins that reach far above their surfaces
    osg::LOD::RangeMode mode = osg::LOD::DISTANCE_FROM_EYE_POINT;
    double movedShare = 0.0;  // of start tiles below a transform
    bool hasCallbackInFront = false;
};

/// 32 start tiles, 45 degrees wide, and two levels below them.
class DeepGlobe {
public:
    DeepGlobe(const DeepTerrain& terrain, Random& random);

    /// To be called when the tiles are as they are to be.
    void build();

    /// The altitude of the surface that OSG shows there from the eye; the lowest where that is uncertain.
    [[nodiscard]] double shownAltitude(double latitude, double longitude, const glm::dvec3& eye) const;

    /// The altitude of the highest surface that OSG may show there.
    [[nodiscard]] double mostAltitude(double latitude, double longitude, const glm::dvec3& eye) const;

    [[nodiscard]] DeepTile& start(std::size_t i) { return _tiles[i]; }

    template <class Visit>
    void forEachShown(const glm::dvec3& eye, const Visit& visit) const {
        for (const DeepTile& tile : _tiles) forEachShown(tile, eye, visit);
    }

    osg::ref_ptr<osg::Group> root = new osg::Group;

private:
    [[nodiscard]] DeepTile made(const core::GeodeticBin& extents, int level, bool isUncertain);
    [[nodiscard]] static bool isFine(const DeepTile& tile, const glm::dvec3& eye);
    [[nodiscard]] static double mostAt(const DeepTile& tile, double latitude, double longitude, const glm::dvec3& eye);
    [[nodiscard]] static double shownAt(const DeepTile& tile, double latitude, double longitude, const glm::dvec3& eye);

    template <class Visit>
    static void forEachShown(const DeepTile& tile, const glm::dvec3& eye, const Visit& visit) {
        const bool fine = isFine(tile, eye);
        if (tile.isUncertain || !fine) visit(tile);
        if (fine || (tile.isUncertain && !tile.parts.empty())) {
            for (const DeepTile& part : tile.parts) forEachShown(part, eye, visit);
        }
    }

    const DeepTerrain _terrain;
    Random& _random;
    std::vector<DeepTile> _tiles;
    std::vector<bool> _moved;
};

}  // namespace osgAnalyticBin::test
