// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraView.h"
#include "TileCensus.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <osg/Camera>

#include <map>
#include <set>
#include <string>

namespace osgAnalyticBin::bench {

/// The tiles, by key, of those drawn without any culling, that a view needs.
struct NeededTiles {
    std::set<std::string> keys;  ///< their bins' hulls meet the frustum, and are not hidden
    std::uint64_t hidden = 0;    ///< bins that meet the frustum wholly behind the globe
};

/// Says which tiles are truly needed: the hull of the tile's bin meets the frustum, and the bin is not wholly
/// behind the globe. The body that hides is the ellipsoid lowered to the lowest surface drawn nearer than that body's
/// own horizon: a line of sight that enters it has passed through the terrain before.
/// The bin is the one that the kit culls the tile by, with all finer descendants in it; where there is none, the bin of
/// the tile's own surface.
/// The hulls are parted by the faces of both and by the edges of the frustum; what is left undecided counts as needed
/// (a thousandth above the truth at most: TileTruth.AgreesWithHullsAndLinesOfSight).
/// Skirts do not hide; they are in the bins, and count as needed.
class TileTruth {
public:
    /// Takes note of the bins that the kit has installed on tiles.
    void learnBins(const std::vector<flight::DrawnTile>& tiles);

    /// `tiles`: all that are drawn without any culling.
    /// Cost: the surface of every tile not met before, and some microseconds a tile.
    [[nodiscard]] NeededTiles neededTiles(const std::vector<flight::DrawnTile>& tiles, const osg::Camera& view,
                                          const flight::Globe& globe);

private:
    // What the tile's own meshes cover. Not valid: that is not known.
    [[nodiscard]] const AnalyticBin& surfaceOf(const flight::DrawnTile& tile, const flight::Globe& globe);

    std::map<std::string, AnalyticBin> _surfaces;
    std::map<std::string, AnalyticBin> _bins;
};

/// The least depth below the ellipsoid, in metres and not negative, such that no surface nearer to the eye than the
/// horizon of the ellipsoid lowered by it lies deeper.
[[nodiscard]] double occluderDepth(const std::vector<core::GeodeticBin>& bins, const core::Ellipsoid& ellipsoid,
                                   const glm::dvec3& eye);

}  // namespace osgAnalyticBin::bench
