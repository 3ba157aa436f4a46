// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// All rasters as one: how borders of rasters inside coarser ones are blended, what heights are above, and how voids are
// filled. That bins hold what is made of it, and that updates know what changes, is tested on whole databases.

#include "RasterTest.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

namespace {

using osgbindem::DemMosaic;

class Blend : public RasterTest {
protected:
    /// A raster of four degrees at 900 m on the globe at 100 m, from its north-western post on.
    Words onGlobe(double west, double north) {
        return {savedGlobe(1.0, flat(100.0)), saved(TestRaster(west, north, 0.02, 201, flat(900.0)))};
    }
};

TEST_F(Blend, ClimbsFromTheCoarserRasterWithoutAStep) {
    DemMosaic mosaic = mosaicOf(onGlobe(10.0, 52.0));
    EXPECT_EQ(mosaic.height({50.0, 12.0}), 900.0);
    EXPECT_EQ(mosaic.height({50.0, 9.0}), 100.0);
    EXPECT_NEAR(mosaic.height({50.0, 9.9901}), 100.0, 1.0);
    // The band is an eighth of the side: 0.32 degrees, the inset being narrower in longitude.
    EXPECT_EQ(mosaic.height({50.0, 10.6}), 900.0);
    double before = 100.0;
    for (double longitude = 9.9; longitude < 10.7; longitude += 0.01) {
        const double height = mosaic.height({50.0, longitude});
        EXPECT_GE(height, before - 1e-9);
        EXPECT_LE(height, before + 40.0) << longitude;
        before = height;
    }
    EXPECT_NEAR(mosaic.height({51.9, 12.0}), mosaic.height({48.1, 12.0}), 1e-6);
}

TEST_F(Blend, HasTheWidthThatIsGiven) {
    const Words rasters = onGlobe(10.0, 2.0);
    // At the equator a degree is 111.3 km; the border is half a pixel beyond the first post.
    DemMosaic wide = mosaicOf(joined(rasters, {"--blend", "111319.49"}));
    EXPECT_NEAR(wide.height({0.0, 10.49}), 500.0, 0.1);
    EXPECT_EQ(wide.height({0.0, 11.0}), 900.0);
    EXPECT_LT(wide.height({0.0, 10.9}), 900.0);
    DemMosaic none = mosaicOf(joined(rasters, {"--blend", "0"}));
    EXPECT_EQ(none.height({0.0, 10.0}), 900.0);
    EXPECT_EQ(none.height({0.0, 9.98}), 100.0);
}

TEST_F(Blend, RastersSideBySideHaveNoTrenchBetweenThem) {
    // As tiles of a survey: they share a row of posts.
    const std::string coarse = savedGlobe(1.0, flat(100.0));
    const std::string west = saved(TestRaster(10.0, 52.0, 0.01, 101, flat(900.0)));
    const std::string east = saved(TestRaster(11.0, 52.0, 0.01, 101, flat(900.0)));
    DemMosaic mosaic = mosaicOf({coarse, west, east});
    for (double longitude = 10.5; longitude <= 11.5; longitude += 0.01)
        EXPECT_EQ(mosaic.height({51.5, longitude}), 900.0) << longitude;
    EXPECT_LT(mosaic.height({51.5, 10.0}), 200.0);
    EXPECT_LT(mosaic.height({51.5, 12.0}), 200.0);
    // One of another resolution that only meets them is no ground below either.
    DemMosaic three = mosaicOf({coarse, west, saved(TestRaster(10.0, 51.0, 0.03, 34, flat(900.0)))});
    EXPECT_EQ(three.height({51.01, 10.5}), 900.0);
    EXPECT_EQ(three.height({50.97, 10.5}), 900.0);
}

TEST_F(Blend, InsetsWithinInsetsMeetTheNextOne) {
    DemMosaic mosaic = mosaicOf({savedGlobe(1.0, flat(0.0)), saved(TestRaster(10.0, 50.0, 0.05, 81, flat(500.0))),
                                 saved(TestRaster(11.5, 48.5, 0.01, 101, flat(800.0)))});
    EXPECT_NEAR(mosaic.height({48.0, 11.4951}), 500.0, 1.0);
    EXPECT_EQ(mosaic.height({48.0, 12.0}), 800.0);
}

TEST_F(Blend, NothingIsBlendedWithoutACoarserRaster) {
    DemMosaic alone = mosaicOf({saved(TestRaster(10.0, 52.0, 0.02, 201, flat(900.0)))});
    EXPECT_EQ(alone.height({50.0, 10.0}), 900.0);
    EXPECT_EQ(alone.height({50.0, 9.9}), 0.0);
}

TEST_F(Blend, PassesTheDateLine) {
    DemMosaic mosaic = mosaicOf(onGlobe(178.0, -16.0));
    EXPECT_EQ(mosaic.height({-18.0, 180.0}), 900.0);
    EXPECT_EQ(mosaic.height({-18.0, -180.0}), 900.0);
    EXPECT_NEAR(mosaic.height({-18.0, -178.2}), mosaic.height({-18.0, 178.2}), 1e-6);
    EXPECT_LT(mosaic.height({-18.0, -178.2}), 900.0);
}

constexpr const char* kEgm96 = "/usr/share/proj/egm96_15.gtx";

class Geoid : public RasterTest {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(kEgm96)) GTEST_SKIP() << "package proj-data is not installed";
    }

    /// A globe at 100 m.
    std::string globe(const std::string& reference) { return saved(TestRaster::globe(2.0, flat(100.0)).in(reference)); }
};

TEST_F(Geoid, IsAddedWhereItIsAskedFor) {
    const std::string raster = globe("EPSG:4326");
    EXPECT_EQ(mosaicOf({raster}).height({0.0, 0.0}), 100.0);
    for (const char* geoid : {"egm96", kEgm96}) {
        osgbindem::DemMosaic mosaic = mosaicOf({raster, "--geoid", geoid});
        EXPECT_NEAR(mosaic.height({0.0, 0.0}), 117.16, 0.1) << geoid;
        EXPECT_NEAR(mosaic.height({4.75, 78.75}), 100.0 - 106.9, 0.5) << geoid;
        EXPECT_EQ(mosaic.height({10.0, 180.0}), mosaic.height({10.0, -180.0})) << geoid;
        const osgbindem::Interval range = mosaic.range({75.0, 0.0, 80.0, 8.0});
        EXPECT_LE(range.lower, 100.0 - 106.9);
        EXPECT_GE(range.upper, mosaic.height({0.0, 75.0}));
        EXPECT_LT(range.upper - range.lower, 50.0);
    }
}

TEST_F(Geoid, IsReadFromTheRastersReference) {
    const std::string egm96 = globe("EPSG:4326+5773");
    EXPECT_NEAR(mosaicOf({egm96}).height({0.0, 0.0}), 117.16, 0.1);
    EXPECT_EQ(mosaicOf({egm96, "--geoid", "none"}).height({0.0, 0.0}), 100.0);
    EXPECT_EQ(mosaicOf({globe("EPSG:4979")}).height({0.0, 0.0}), 100.0) << "above the ellipsoid already";
}

TEST_F(Geoid, IsAddedOnceToMapProjections) {
    // The geoid is 28.7 m below the ellipsoid in the middle.
    const std::string metres = saved(TestRaster(600500.0, 3700500.0, 1000.0, 60, flat(5000.0)).in("EPSG:32614+5773"));
    const osgbindem::PositionDeg middle{33.162, -97.613};
    EXPECT_NEAR(mosaicOf({metres}).height(middle), 4971.3, 0.1);
    EXPECT_NEAR(mosaicOf({metres, "--geoid", "egm96"}).height(middle), 4971.3, 0.1);
    EXPECT_NEAR(mosaicOf({metres, "--geoid", "none"}).height(middle), 5000.0, 1e-6);
    // Texas and heights, both in feet of the US survey; the user's word counts more than the raster's.
    const std::string feet = saved(TestRaster(2300500.0, 7000500.0, 1000.0, 60, flat(5000.0)).in("EPSG:2276+6360"));
    const osgbindem::PositionDeg texas{32.7835, -97.3237};
    EXPECT_NEAR(mosaicOf({feet, "--geoid", "none"}).height(texas), 5000.0 * 1200.0 / 3937.0, 1e-6);
    EXPECT_NEAR(mosaicOf({feet, "--geoid", "none", "--height-unit", "0.1"}).height(texas), 500.0, 1e-6);
}

TEST_F(Geoid, WithoutItsGridIsRefused) {
    // No package of Debian has the grid of the Dutch NAP.
    const std::string nap = globe("EPSG:4326+5709");
    expectFailure({nap, "-o", file("earth.osgb")}, "--geoid");
    EXPECT_FALSE(std::filesystem::exists(file("earth.osgb")));
    EXPECT_EQ(databaseOf({nap, "--geoid", "none", "--levels", "0", "--cells", "4"}).deepestLevel(), 0);
}

constexpr int kAround = 20;

using osgbindem::PositionDeg;

/// Columns and rows of posts.
using Cut = std::function<bool(int column, int row)>;

/// A square of heights from 10 E, 50 N on with voids, and what stood there before.
struct Grid {
    Grid(const TestRaster::Height& height, int posts, double degrees, const Cut& isCut, double westDeg = 10.0)
        : size(posts), spacing(degrees), west(westDeg) {
        for (int row = 0; row < size; ++row) {
            for (int column = 0; column < size; ++column) {
                const PositionDeg at = position(column, row);
                truth.push_back(height(at.latitudeDeg, at.longitudeDeg));
                heights.push_back(isCut(column, row) ? std::nan("") : truth.back());
            }
        }
    }

    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
    }
    [[nodiscard]] bool isMissing(int column, int row) const { return std::isnan(heights[index(column, row)]); }
    [[nodiscard]] PositionDeg position(int column, int row) const {
        return {50.0 - row * spacing, west + column * spacing};
    }
    [[nodiscard]] TestRaster raster() const {
        TestRaster raster(west, 50.0, spacing, size, [this](double latitude, double longitude) {
            return heights[index(static_cast<int>(std::lround((longitude - west) / spacing)),
                                 static_cast<int>(std::lround((50.0 - latitude) / spacing)))];
        });
        return raster.withNodata(-32768.0);
    }
    /// Calls `visit(column, row)` for the posts that are not farther away than that; ends where it returns true.
    template <class Visit>
    bool visitAround(int column, int row, int reach, const Visit& visit) const {
        for (int v = std::max(0, row - reach); v <= std::min(size - 1, row + reach); ++v)
            for (int u = std::max(0, column - reach); u <= std::min(size - 1, column + reach); ++u)
                if (visit(u, v)) return true;
        return false;
    }

    int size;
    double spacing, west;
    std::vector<double> truth, heights;
};

/// Between the lowest and the highest true height of the neighbourhood of a missing post.
double reliefAround(const Grid& grid, int column, int row) {
    int distance = 1;
    while (!grid.visitAround(column, row, distance, [&](int u, int v) { return !grid.isMissing(u, v); })) ++distance;
    Range range;
    grid.visitAround(column, row, distance + kAround, [&](int u, int v) {
        range.include(grid.truth[grid.index(u, v)]);
        return false;
    });
    return range.upper - range.lower;
}

/// Compares a fifth of the missing posts. Returns: how many.
int expectFilled(const Grid& grid, DemMosaic& mosaic) {
    int count = 0;
    for (int row = 0; row < grid.size; ++row) {
        for (int column = 0; column < grid.size; ++column) {
            const double truth = grid.truth[grid.index(column, row)];
            if ((row + 2 * column) % 5 != 0 || !grid.isMissing(column, row)) continue;
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

class Voids : public RasterTest {
protected:
    /// The grid's raster over a coarser globe.
    DemMosaic over(const TestRaster& globe, const Grid& grid) {
        return mosaicOf({saved(globe), saved(grid.raster()), "--blend", "0"});
    }
    DemMosaic alone(const Grid& grid) { return mosaicOf({saved(grid.raster()), "--blend", "0"}); }
};

TEST_F(Voids, SmallOnesAreInterpolatedWithoutAnotherRaster) {
    const Grid grid(hills, 400, 0.01, rectangles(40, 15));
    DemMosaic mosaic = alone(grid);
    EXPECT_GT(expectFilled(grid, mosaic), 600);
}

TEST_F(Voids, LargeOnesFollowTheCoarserRasterWithoutItsError) {
    const Grid grid(hills, 600, 0.01, rectangles(150, 70));
    DemMosaic mosaic = over(TestRaster::globe(0.5, vague), grid);
    EXPECT_GT(expectFilled(grid, mosaic), 1600);
}

TEST_F(Voids, FarFromItsRimALargeVoidIsTheCoarserRaster) {
    const Grid grid(flat(700.0), 600, 0.01,
                    [](int column, int row) { return column > 100 && row > 100 && column < 500 && row < 500; });
    DemMosaic mosaic = over(TestRaster::globe(1.0, flat(400.0)), grid);
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
    const Grid grid(flat(20.0), 300, 0.01, [](int column, int) { return column >= 150; });
    DemMosaic mosaic = over(TestRaster::globe(1.0, flat(-15.0)), grid);
    EXPECT_NEAR(mosaic.height(grid.position(140, 100)), 20.0, 1e-3);
    EXPECT_NEAR(mosaic.height(grid.position(160, 100)), -15.0, 1e-3);
    // Without a coarser raster a large void is none: what is missing there is 0, not land.
    EXPECT_EQ(alone(grid).height(grid.position(151, 100)), 0.0);
}

TEST_F(Voids, HaveNoSeamBetweenBlocks) {
    // Posts 255 and 256 are in two blocks.
    const Grid grid(hills, 520, 0.002,
                    [](int column, int row) { return std::abs(column - 256) < 60 && std::abs(row - 256) < 60; });
    DemMosaic mosaic = over(TestRaster::globe(0.5, vague), grid);
    for (int along = 200; along < 310; ++along) {
        const auto step = [&](int column) {
            return std::abs(mosaic.height(grid.position(column, along)) -
                            mosaic.height(grid.position(column - 1, along)));
        };
        EXPECT_LE(step(256), 2.0 * std::max(step(255), step(257)) + 2.0) << along;
    }
}

TEST_F(Voids, LongOnesAreAsWideAsTheyAreNarrow) {
    const Grid grid(hills, 400, 0.01, [](int column, int row) { return column == 200 || row == column / 2 + 20; });
    DemMosaic mosaic = over(TestRaster::globe(0.5, flat(-2000.0)), grid);
    EXPECT_GT(expectFilled(grid, mosaic), 100);
}

TEST_F(Voids, DataOfOneRasterWinsOverFillsOfTheOther) {
    // What one has the other lacks; both of one grid, and of two whose posts lie between each other's.
    const auto isWest = [](int column, int row) { return column + row / 3 < 260; };
    const Grid west(hills, 400, 0.01, [&](int column, int row) { return !isWest(column, row); });
    const std::string coarse = savedGlobe(0.5, flat(-2000.0));
    const std::string western = saved(west.raster());
    for (const double shift : {0.0, 0.004}) {
        const std::string eastern = saved(Grid(hills, 400, 0.01, isWest, 10.0 + shift).raster());
        for (const Words& rasters : {Words{western, eastern}, {coarse, western, eastern}}) {
            DemMosaic mosaic = mosaicOf(joined(rasters, {"--blend", "0"}));
            for (int row = 5; row < 395; ++row) {
                for (int away = -20; away <= 20; away += 4) {
                    const PositionDeg position = west.position(260 - row / 3 + away, row);
                    EXPECT_NEAR(mosaic.height(position), hills(position.latitudeDeg, position.longitudeDeg), 12.0);
                }
            }
        }
    }
}

}  // namespace
