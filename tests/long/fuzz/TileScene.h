// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Files of a database as no builder makes them, from the bytes of an input.

#pragma once

#include "Bytes.h"

#include <osg/Node>
#include <osg/ref_ptr>

#include <string>

namespace osgAnalyticBin::test {

/// Where a tile claims to stand: degrees, and metres.
struct ScenePlace {
    double south = -90.0, north = 90.0, west = -180.0, east = 180.0, height = 0.0;
};

/// What the file of a database holds. `isRoot`: below a CoordinateSystemNode. Files name each other "0.osgb", "1.osgb"
/// and so on, themselves too.
[[nodiscard]] osg::ref_ptr<osg::Node> makeFile(Bytes& bytes, const ScenePlace& place, bool isRoot);

/// Whether nothing in the scene makes OSG itself read where there is no memory, or number that its text cannot hold.
struct SceneTraits {
    bool hasWildIndices = false;
    bool hasOddNumbers = false;
    bool hasTerrainTiles = false;
};
[[nodiscard]] SceneTraits traitsOf(osg::Node& scene);

}  // namespace osgAnalyticBin::test
