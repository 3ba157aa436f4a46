// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// How voids are filled. The oracle is the raster that they were cut into: no filled post may differ from it by more
// than the relief of its neighbourhood, which reaches kAround posts farther than the nearest post with data.

#include "DemMosaic.h"
#include "Program.h"
#include "TestRaster.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

constexpr int kAround = 20;

using osgbindem::DemMosaic;
using osgbindem::PositionDeg;
using osgbindem::Settings;

/// Columns and rows of posts.
using Cut = std::function<bool(int column, int row)>;

/// Heights with voids, and what stood there before.
struct Grid {
    double west = 0.0;
    double north = 0.0;
    double spacing = 0.0;
    int width = 0;
    int height = 0;
    std::vector<double> truth;
    std::vector<double> heights;

    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    }
    [[nodiscard]] bool isMissing(int column, int row) const { return std::isnan(heights[index(column, row)]); }
    [[nodiscard]] PositionDeg position(int column, int row) const {
        return {north - row * spacing, west + column * spacing};
    }
    void cut(const Cut& isCut) {
        for (int row = 0; row < height; ++row)
            for (int column = 0; column < width; ++column)
                if (isCut(column, row)) heights[index(column, row)] = std::nan("");
    }
    void write(const std::string& path) const {
        TestRaster raster(west, north, spacing, spacing, width, height, [this](double latitude, double longitude) {
            return heights[index(static_cast<int>(std::lround((longitude - west) / spacing)),
                                 static_cast<int>(std::lround((north - latitude) / spacing)))];
        });
        raster.setNodata(-32768.0);
        raster.write(path);
    }
};

Grid gridOf(const TestRaster::Height& height, int size, double spacing) {
    Grid grid{10.0, 50.0, spacing, size, size, {}, {}};
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            grid.truth.push_back(height(50.0 - row * spacing, 10.0 + column * spacing));
    grid.heights = grid.truth;
    return grid;
}

/// Posts from a missing one to the nearest with data, in the larger of both directions.
int distanceToData(const Grid& grid, int column, int row) {
    for (int reach = 1;; ++reach)
        for (int v = std::max(0, row - reach); v <= std::min(grid.height - 1, row + reach); ++v)
            for (int u = std::max(0, column - reach); u <= std::min(grid.width - 1, column + reach); ++u)
                if (!grid.isMissing(u, v)) return reach;
}

/// Between the lowest and the highest true height of the neighbourhood.
double reliefAround(const Grid& grid, int column, int row) {
    const int reach = distanceToData(grid, column, row) + kAround;
    Range range;
    for (int v = std::max(0, row - reach); v <= std::min(grid.height - 1, row + reach); ++v)
        for (int u = std::max(0, column - reach); u <= std::min(grid.width - 1, column + reach); ++u)
            if (!std::isnan(grid.truth[grid.index(u, v)])) range.include(grid.truth[grid.index(u, v)]);
    return range.upper - range.lower;
}

Settings settingsFor(const std::vector<std::string>& rasters) {
    Settings settings;
    settings.blend = 0.0;
    for (const std::string& raster : rasters) settings.dems.push_back({raster});
    return settings;
}

/// Compares a fifth of the missing posts of which the truth is known. Returns: how many.
int expectFilled(const Grid& grid, DemMosaic& mosaic) {
    int count = 0;
    for (int row = 0; row < grid.height; ++row) {
        for (int column = 0; column < grid.width; ++column) {
            const double truth = grid.truth[grid.index(column, row)];
            if ((row + 2 * column) % 5 != 0 || !grid.isMissing(column, row) || std::isnan(truth)) continue;
            const double difference = std::abs(mosaic.height(grid.position(column, row)) - truth);
            EXPECT_LE(difference, reliefAround(grid, column, row) + 1.0) << "column " << column << " row " << row;
            ++count;
        }
    }
    return count;
}

/// Rectangles from one post to `largest` posts wide, one in each cell of a lattice.
Cut rectangles(int lattice, int largest) {
    return [=](int column, int row) {
        const int size = 1 + (column / lattice * 7 + row / lattice * 13) % largest;
        const int x = column % lattice - lattice / 8;
        const int y = row % lattice - lattice / 8;
        return x >= 0 && y >= 0 && x < size && y < std::max(1, size * 3 / 4);
    };
}

/// A coarse surface that is 300 m too high and knows no valleys.
double vague(double latitudeDeg, double longitudeDeg) {
    return 1000.0 + hills(std::round(latitudeDeg), std::round(longitudeDeg));
}

class Voids : public testing::Test {
protected:
    [[nodiscard]] std::string fine() const { return _folder.file("fine.tif"); }
    [[nodiscard]] std::string coarse() const { return _folder.file("coarse.tif"); }

    const TempFolder _folder;
};

TEST_F(Voids, SmallOnesAreInterpolatedWithoutAnotherRaster) {
    Grid grid = gridOf(hills, 400, 0.01);
    grid.cut(rectangles(40, 15));
    grid.write(fine());
    DemMosaic mosaic(settingsFor({fine()}));
    EXPECT_GT(expectFilled(grid, mosaic), 600);
}

TEST_F(Voids, LargeOnesFollowTheCoarserRasterWithoutItsError) {
    Grid grid = gridOf(hills, 600, 0.01);
    grid.cut(rectangles(150, 70));
    grid.write(fine());
    TestRaster::globe(0.5, vague).write(coarse());
    DemMosaic mosaic(settingsFor({coarse(), fine()}));
    EXPECT_GT(expectFilled(grid, mosaic), 1600);
}

TEST_F(Voids, FarFromItsRimALargeVoidIsTheCoarserRaster) {
    Grid grid = gridOf([](double, double) { return 700.0; }, 600, 0.01);
    grid.cut([](int column, int row) { return column > 100 && row > 100 && column < 500 && row < 500; });
    grid.write(fine());
    TestRaster::globe(1.0, [](double, double) { return 400.0; }).write(coarse());
    DemMosaic mosaic(settingsFor({coarse(), fine()}));
    EXPECT_NEAR(mosaic.height(grid.position(102, 300)), 700.0, 1.0);
    EXPECT_NEAR(mosaic.height(grid.position(150, 300)), 700.0, 1.0);
    EXPECT_NEAR(mosaic.height(grid.position(300, 300)), 400.0, 1e-3);
    double before = 700.0;
    for (int column = 101; column <= 300; ++column) {
        const double height = mosaic.height(grid.position(column, 300));
        EXPECT_LE(height, before + 0.01) << column;
        EXPECT_GE(height, before - 10.0) << column;
        before = height;
    }
}

TEST_F(Voids, OfTheSeaStayTheSea) {
    Grid grid = gridOf([](double, double) { return 20.0; }, 300, 0.01);
    grid.cut([](int column, int) { return column >= 150; });
    grid.write(fine());
    TestRaster::globe(1.0, [](double, double) { return -15.0; }).write(coarse());
    DemMosaic mosaic(settingsFor({coarse(), fine()}));
    EXPECT_NEAR(mosaic.height(grid.position(140, 100)), 20.0, 1e-3);
    EXPECT_NEAR(mosaic.height(grid.position(160, 100)), -15.0, 1e-3);
    // Without a coarser raster a large void is none: what is missing there is 0, not land.
    DemMosaic alone(settingsFor({fine()}));
    EXPECT_EQ(alone.height(grid.position(151, 100)), 0.0);
}

TEST_F(Voids, TheWayThroughThemDoesNotCount) {
    Grid grid = gridOf(hills, 700, 0.01);
    grid.cut(rectangles(180, 120));
    grid.write(fine());
    TestRaster::globe(0.5, vague).write(coarse());
    DemMosaic forward(settingsFor({coarse(), fine()}));
    DemMosaic backward(settingsFor({coarse(), fine()}));
    std::vector<double> heights;
    for (int row = 0; row < 700; row += 3)
        for (int column = 0; column < 700; column += 3) heights.push_back(forward.height(grid.position(column, row)));
    for (int row = 699; row >= 0; row -= 3)
        for (int column = 699; column >= 0; column -= 3) {
            if (column % 90 == 0) (void)backward.range({12.0, 45.0, 13.0, 46.0});
            ASSERT_EQ(backward.height(grid.position(column, row)), heights.back()) << column << ' ' << row;
            heights.pop_back();
        }
}

TEST_F(Voids, HaveNoSeamBetweenBlocks) {
    // Posts 255 and 256 are in two blocks.
    Grid grid = gridOf(hills, 520, 0.002);
    grid.cut([](int column, int row) { return std::abs(column - 256) < 60 && std::abs(row - 256) < 60; });
    grid.write(fine());
    TestRaster::globe(0.5, vague).write(coarse());
    DemMosaic mosaic(settingsFor({coarse(), fine()}));
    for (int along = 200; along < 310; ++along) {
        const auto step = [&](int column) {
            return std::abs(mosaic.height(grid.position(column, along)) -
                            mosaic.height(grid.position(column - 1, along)));
        };
        EXPECT_LE(step(256), 2.0 * std::max(step(255), step(257)) + 2.0) << along;
    }
}

TEST_F(Voids, LongOnesAreAsWideAsTheyAreNarrow) {
    Grid grid = gridOf(hills, 400, 0.01);
    grid.cut([](int column, int row) { return column == 200 || row == column / 2 + 20; });
    grid.write(fine());
    TestRaster::globe(0.5, [](double, double) { return -2000.0; }).write(coarse());
    DemMosaic mosaic(settingsFor({coarse(), fine()}));
    EXPECT_GT(expectFilled(grid, mosaic), 100);
}

TEST_F(Voids, DataOfOneRasterWinsOverFillsOfTheOther) {
    // What one has the other lacks; both of one grid, and of two whose posts lie between each other's.
    const auto isWest = [](int column, int row) { return column + row / 3 < 260; };
    Grid west = gridOf(hills, 400, 0.01);
    Grid east = west;
    west.cut([&](int column, int row) { return !isWest(column, row); });
    east.cut(isWest);
    west.write(fine());
    TestRaster::globe(0.5, [](double, double) { return -2000.0; }).write(coarse());
    for (const double shift : {0.0, 0.4}) {
        east.west = west.west + shift * east.spacing;
        for (int row = 0; row < 400; ++row)
            for (int column = 0; column < 400; ++column)
                if (!isWest(column, row))
                    east.heights[east.index(column, row)] = hills(50.0 - row * 0.01, east.west + column * 0.01);
        east.write(_folder.file("east.tif"));
        for (const auto& rasters :
             {std::vector{fine(), _folder.file("east.tif")}, std::vector{coarse(), fine(), _folder.file("east.tif")}}) {
            DemMosaic mosaic(settingsFor(rasters));
            for (int row = 5; row < 395; ++row) {
                const int column = 260 - row / 3;
                for (int away = -20; away <= 20; away += 4) {
                    const PositionDeg position = west.position(column + away, row);
                    EXPECT_NEAR(mosaic.height(position), hills(position.latitudeDeg, position.longitudeDeg), 12.0);
                }
            }
        }
    }
}

}  // namespace
