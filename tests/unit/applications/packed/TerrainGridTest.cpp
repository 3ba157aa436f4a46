// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The bytes of a grid: all of it comes back, and broken bytes are refused. That the mesh is right is tested on whole
// databases: tests/unit/applications/osgbindem.

#include "TerrainGrid.h"

#include <gtest/gtest.h>

namespace {

using osgAnalyticBin::packed;
using osgAnalyticBin::TerrainGrid;
using osgAnalyticBin::unpacked;

TerrainGrid rough() {
    TerrainGrid grid;
    grid.ellipsoid = osgAnalyticBin::core::Ellipsoid(6378137.0, 6356752.3142);
    grid.cells = 6;
    grid.columns = std::int64_t{16} * 6 << 20;
    grid.firstColumn = grid.columns - 6;
    grid.firstRow = 12345678;
    grid.quantum = 1.0 / 1024.0;
    grid.origin = {-1234567.125, 7654321.0, -0.0009765625};
    // from one end of what terrain can be to the other
    for (int i = 0; i < 81; ++i) grid.heights.push_back((i * 7919 % 13 - 6) * 1000000 + i);
    for (TerrainGrid::Skirt& skirt : grid.skirts) {
        for (int i = 0; i < 7; ++i) {
            skirt.depth.push_back(i * 1000 % 3001);
            skirt.lean.push_back(i % 2);
        }
    }
    grid.colours = {{-10.5F, {1, 2, 3}}, {20.0F, {255, 254, 253}}};
    grid.relief = true;
    grid.textureSize = 256;
    return grid;
}

}  // namespace

TEST(TerrainGrid, AllOfItComesBack) {
    const TerrainGrid grid = rough();
    const auto again = unpacked(packed(grid));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->ellipsoid.equatorialRadius(), grid.ellipsoid.equatorialRadius());
    EXPECT_EQ(again->ellipsoid.polarRadius(), grid.ellipsoid.polarRadius());
    EXPECT_EQ(again->cells, grid.cells);
    EXPECT_EQ(again->columns, grid.columns);
    EXPECT_EQ(again->firstColumn, grid.firstColumn);
    EXPECT_EQ(again->firstRow, grid.firstRow);
    EXPECT_EQ(again->quantum, grid.quantum);
    EXPECT_EQ(again->origin, grid.origin);
    EXPECT_EQ(again->heights, grid.heights);
    EXPECT_EQ(again->textureSize, grid.textureSize);
    for (std::size_t edge = 0; edge < 4; ++edge) {
        EXPECT_EQ(again->skirts[edge].depth, grid.skirts[edge].depth);
        EXPECT_EQ(again->skirts[edge].lean, grid.skirts[edge].lean);
    }
    ASSERT_EQ(again->colours.size(), 2U);
    EXPECT_EQ(again->colours[0].height, -10.5F);
    EXPECT_EQ(again->colours[1].colour, grid.colours[1].colour);
    EXPECT_EQ(again->relief, grid.relief);
    EXPECT_EQ(packed(*again), packed(grid));
}

TEST(TerrainGrid, EveryBeginningAndEveryAdditionAndAGlobeWithoutHeightIsRefused) {
    const std::string bytes = packed(rough());
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(unpacked(bytes.substr(0, size))) << size;
    EXPECT_FALSE(unpacked(bytes + '\0'));
    EXPECT_FALSE(unpacked(std::string(100000, '\xff')));
    TerrainGrid flat = rough();
    flat.ellipsoid = osgAnalyticBin::core::Ellipsoid(1e12, 1e-3);
    EXPECT_FALSE(unpacked(packed(flat)));
}

TEST(TerrainGrid, WhateverTheBytesTheMeshIsOfItsSize) {
    // Changed bytes may be a grid of other heights: then it has all the vertices that its triangles name.
    const std::string bytes = packed(rough());
    std::size_t accepted = 0;
    for (std::size_t place = 0; place < bytes.size(); ++place) {
        for (const int change : {0x01, 0x40, 0x80, 0xff}) {
            std::string changed = bytes;
            changed[place] = static_cast<char>(changed[place] ^ change);
            const auto grid = unpacked(changed);
            if (!grid) continue;
            ++accepted;
            const std::size_t count = osgAnalyticBin::verticesOf(*grid).size();
            for (const std::uint16_t index : osgAnalyticBin::trianglesOf(grid->cells)) ASSERT_LT(index, count);
        }
    }
    EXPECT_GT(accepted, 100U);
}

namespace {

/// A slope that rises eastward or northward, at 45 degrees north.
TerrainGrid slope(int eastward, int northward) {
    TerrainGrid grid;
    grid.ellipsoid = osgAnalyticBin::core::Ellipsoid(6378137.0, 6356752.3142);
    grid.cells = 4;
    grid.columns = 36000;
    grid.firstColumn = 18000;
    grid.firstRow = 13500;
    grid.quantum = 1.0 / 1024.0;
    for (int row = -1; row <= 5; ++row)
        for (int column = -1; column <= 5; ++column)
            grid.heights.push_back(64 * (1000 + 300 * (eastward * column + northward * row)));
    for (TerrainGrid::Skirt& skirt : grid.skirts) skirt.depth = skirt.lean = std::vector<std::int32_t>(5, 1);
    grid.colours = {{-10.0F, {100, 100, 100}}, {9000.0F, {101, 101, 101}}};
    grid.relief = true;
    return grid;
}

int brightness(const TerrainGrid& grid) {
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osgAnalyticBin::fillGeometry(grid, *geometry);
    return (*dynamic_cast<const osg::Vec4ubArray*>(geometry->getColorArray()))[12].r();
}

}  // namespace

TEST(TerrainGrid, ReliefIsLitFromTheNorthWest) {
    const int level = brightness(slope(0, 0));
    EXPECT_NEAR(level, 100, 1);
    EXPECT_GT(brightness(slope(1, 0)), level + 10);   // looks west
    EXPECT_LT(brightness(slope(-1, 0)), level - 10);  // looks east
    EXPECT_GT(brightness(slope(0, -1)), level + 10);  // looks north
    EXPECT_LT(brightness(slope(0, 1)), level - 10);   // looks south
    TerrainGrid plain = slope(-1, 0);
    plain.relief = false;
    EXPECT_EQ(brightness(plain), 100);
}

TEST(TerrainGrid, ReliefHasSnowByHeightAndLatitude) {
    TerrainGrid grid = slope(0, 0);
    grid.heights.assign(grid.heights.size(), 64 * 3600);
    EXPECT_GT(brightness(grid), 230);  // at 45 degrees
    grid.firstRow = 9000;
    EXPECT_EQ(brightness(grid), 100);  // at the equator
    grid.heights.assign(grid.heights.size(), 64 * 6000);
    EXPECT_GT(brightness(grid), 230);
    grid.firstRow = 500;  // Antarctica, and the sea beside it
    grid.heights.assign(grid.heights.size(), 64 * 10);
    EXPECT_GT(brightness(grid), 230);
    grid.heights.assign(grid.heights.size(), -64 * 5);
    EXPECT_EQ(brightness(grid), 100);
}
