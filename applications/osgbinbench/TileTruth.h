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

/// Says which tiles are truly needed: the hull of the tile's surface bin meets the frustum, and the bin is not wholly
/// behind the globe. The body that hides is the ellipsoid lowered to the lowest surface drawn nearer than that body's
/// own horizon: a line of sight that enters it has passed through the terrain before.
/// The hulls are parted by the faces of both and by the edges of the frustum; what is left undecided counts as needed
/// (one or two percent above the truth: tests/core/Tightness.cpp).
/// Skirts count neither as needed nor as hiding.
class TileTruth {
public:
    /// Returns: the keys of the tiles, of those drawn without any culling, that the view needs.
    /// Cost: the surface bin of every tile not met before, and some microseconds a tile.
    [[nodiscard]] std::set<std::string> neededTiles(const std::vector<DrawnTile>& tiles, const osg::Camera& view,
                                                    const flight::Globe& globe);

private:
    [[nodiscard]] const core::GeodeticBin& binOf(const DrawnTile& tile, const core::Ellipsoid& ellipsoid,
                                                 const osg::Matrixd& worldToEcef);

    std::map<std::string, core::GeodeticBin> _bins;
};

/// The least depth below the ellipsoid, in metres and not negative, such that no surface nearer to the eye than the
/// horizon of the ellipsoid lowered by it lies deeper.
[[nodiscard]] double occluderDepth(const std::vector<core::GeodeticBin>& bins, const core::Ellipsoid& ellipsoid,
                                   const glm::dvec3& eye);

}  // namespace osgAnalyticBin::bench
