// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A small database of a map, built as VirtualPlanetBuilder builds them: a quadtree of four levels, each tile's four
// parts in a file of their own, skirts below the border of every tile.

#pragma once

#include <osgAnalyticBin/CullOptions.h>

#include <osg/CoordinateSystemNode>
#include <osg/Group>
#include <osg/PrimitiveSet>
#include <osgTerrain/Terrain>

namespace osgAnalyticBin::test {

struct PlanarMap {
    bool isTerrain = true;  // osgTerrain tiles, else geometry below a translation
    osg::Vec3d origin{500000.0, 4600000.0, 0.0};
    double size = 64000.0;
    double heightUnit = 1.0;  // metres in a map unit

    /// Map units, within 0 .. 2600 metres, at a post of a tile of this width. The finest tiles alone have peaks and
    /// pits.
    [[nodiscard]] double height(double x, double y, double width) const;

    /// Writes all files but the root's into the folder. Returns: the root, ready for paging.
    [[nodiscard]] osg::ref_ptr<osg::CoordinateSystemNode> build(const std::string& folder) const;

    /// One tile without children.
    [[nodiscard]] osg::ref_ptr<osg::Node> mesh(int level, int x, int y) const;

private:
    [[nodiscard]] osg::ref_ptr<osg::Node> tile(const std::string& folder, int level, int x, int y) const;
};

/// From option text that is right.
[[nodiscard]] CullOptions optionsOf(const std::string& text);

inline constexpr const char* kUtm = "PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\"]]";

}  // namespace osgAnalyticBin::test
