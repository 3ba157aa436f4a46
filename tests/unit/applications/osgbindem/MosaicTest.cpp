// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// All rasters as one: how borders of rasters inside coarser ones are blended, what heights are above, and how narrow
// voids are filled. Whether bins hold what is made of it, and what updates know, is tested on whole databases.

#include "RasterTest.h"

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
        EXPECT_NEAR(range.lower, 100.0 - 106.9, 2.0);
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

using osgbindem::PositionDeg;

/// Hills from 10 E, 50 N on with voids, at 400 by 400 posts of 0.01 degrees.
class Voids : public RasterTest {
protected:
    /// Columns and rows of posts without data.
    using Cut = std::function<bool(int column, int row)>;

    static constexpr double kSpacing = 0.01;

    [[nodiscard]] static PositionDeg position(int column, int row) {
        return {50.0 - row * kSpacing, 10.0 + column * kSpacing};
    }
    /// `eastDeg`: by how much the raster is moved.
    std::string savedWith(const Cut& isCut, double eastDeg = 0.0) {
        TestRaster raster(10.0 + eastDeg, 50.0, kSpacing, 400, [&](double latitude, double longitude) {
            const auto column = std::lround((longitude - eastDeg - 10.0) / kSpacing);
            const auto row = std::lround((50.0 - latitude) / kSpacing);
            return isCut(static_cast<int>(column), static_cast<int>(row)) ? std::nan("") : hills(latitude, longitude);
        });
        return saved(raster.withNodata(-32768.0));
    }
    /// Expects what stood in the voids, as far as posts around tell.
    static void expectHills(DemMosaic& mosaic, const Cut& isCut) {
        for (int row = 0; row < 400; row += 3) {
            for (int column = 0; column < 400; ++column) {
                if (!isCut(column, row)) continue;
                const PositionDeg place = position(column, row);
                const auto found = mosaic.find(place);
                ASSERT_TRUE(found) << column << ' ' << row;
                EXPECT_TRUE(found->isFilled);
                EXPECT_NEAR(found->metres, hills(place.latitudeDeg, place.longitudeDeg), 60.0) << column << ' ' << row;
            }
        }
    }
};

/// Squares from one post to 15 posts wide, also where blocks meet, and lines across the raster.
bool isNarrow(int column, int row) {
    const int size = 1 + (column / 32 * 7 + row / 32 * 13) % 15;
    const bool isInSquare = (column + 8) % 32 < size && (row + 8) % 32 < size;
    const bool isBesideBorder = std::min(column, row) < 20 || std::max(column, row) > 379;
    return !isBesideBorder && (isInSquare || column == 200 || row == column / 2 + 20);
}

TEST_F(Voids, NarrowOnesAreInterpolatedWhateverLiesBelow) {
    DemMosaic alone = mosaicOf({savedWith(isNarrow)});
    expectHills(alone, isNarrow);
    DemMosaic over = mosaicOf({savedGlobe(0.5, flat(-2000.0)), savedWith(isNarrow), "--blend", "0"});
    expectHills(over, isNarrow);
}

TEST_F(Voids, WideOnesShowTheCoarserRaster) {
    // One in the middle, across the places where blocks meet, and one along the border: a sea. Corners are narrow.
    const Cut isCut = [](int column, int row) {
        return (column > 240 && column < 280 && row > 100 && row < 300) || row > 380;
    };
    const std::string fine = savedWith(isCut);
    DemMosaic over = mosaicOf({savedGlobe(1.0, flat(-2000.0)), fine, "--blend", "0"});
    DemMosaic alone = mosaicOf({fine});
    for (int along = 110; along < 290; ++along) {
        for (const PositionDeg& place :
             {position(242, along), position(260, along), position(along, 382), position(along, 398)}) {
            EXPECT_EQ(over.height(place), -2000.0) << along;
            EXPECT_FALSE(alone.find(place)) << along;
        }
        // The last post with data reaches up to the first without.
        const PositionDeg edge = position(240, along);
        EXPECT_NEAR(over.height(edge), hills(edge.latitudeDeg, edge.longitudeDeg), 1e-6);
        EXPECT_NEAR(over.height({edge.latitudeDeg, edge.longitudeDeg + 0.5 * kSpacing}), over.height(edge), 1e-3);
    }
}

TEST_F(Voids, RoundTheGlobeHaveNoBorder) {
    TestRaster globe = TestRaster::globe(1.0, [](double latitude, double longitude) {
        return std::abs(latitude) < 30.0 && std::abs(longitude) > 176.0 ? std::nan("") : 100.0;
    });
    DemMosaic mosaic = mosaicOf({saved(globe.withNodata(-32768.0))});
    for (const double longitude : {176.5, 178.0, 180.0, -178.0})
        EXPECT_NEAR(mosaic.height({0.0, longitude}), 100.0, 1e-3);
}

TEST_F(Voids, DataOfOneRasterStandsInTheWideVoidsOfAnother) {
    // What one has the other lacks; both of one grid, and of two whose posts lie between each other's.
    const auto isWest = [](int column, int row) { return column + row / 3 < 260; };
    const std::string coarse = savedGlobe(0.5, flat(-2000.0));
    const std::string western = savedWith([&](int column, int row) { return !isWest(column, row); });
    for (const double shift : {0.0, 0.004}) {
        const std::string eastern = savedWith(isWest, shift);
        for (const Words& rasters : {Words{western, eastern}, {coarse, western, eastern}}) {
            DemMosaic mosaic = mosaicOf(joined(rasters, {"--blend", "0"}));
            for (int row = 5; row < 395; ++row) {
                for (int away = -20; away <= 20; away += 4) {
                    const PositionDeg place = position(260 - row / 3 + away, row);
                    EXPECT_NEAR(mosaic.height(place), hills(place.latitudeDeg, place.longitudeDeg), 12.0);
                }
            }
        }
    }
}

}  // namespace
