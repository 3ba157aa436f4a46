// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which heights a database has: several rasters, missing data, units, overviews, little memory.

#include "RasterTest.h"

#include <gdal_utils.h>

namespace {

using osgbindem::DemMosaic;

class Source : public RasterTest {
protected:
    /// A plain at 1500 m in degrees or in a map projection, with a square of another number in the middle.
    std::string plainWith(double number, bool isMap) const {
        const double scale = isMap ? 100.0 : 0.01;
        const double x = isMap ? 600050.0 : 10.005;
        const double y = isMap ? 5599950.0 : 49.995;
        TestRaster raster(x, y, scale, 100, [=](double north, double east) {
            const double away = std::max(std::abs(north - y + 50.0 * scale), std::abs(east - x - 50.0 * scale));
            return away < 5.5 * scale ? number : 1500.0;
        });
        return raster.in(isMap ? "EPSG:25832" : "EPSG:4326").write(file("plain.tif"));
    }
};

constexpr osgbindem::PositionDeg kMiddles[] = {{49.495, 10.505}, {50.4902, 10.4803}};

/// Expects the plain without anything in it.
void expectPlain(const std::string& path, bool isMap) {
    DemMosaic mosaic = mosaicOf({path});
    const auto [latitudeDeg, longitudeDeg] = kMiddles[isMap ? 1 : 0];
    for (int i = -8; i <= 8; ++i) {
        const double step = i * (isMap ? 0.001 : 0.01);
        EXPECT_NEAR(mosaic.height({latitudeDeg + step, longitudeDeg}), 1500.0, 1e-3) << path << ' ' << i;
        EXPECT_NEAR(mosaic.height({latitudeDeg, longitudeDeg + step}), 1500.0, 1e-3) << path << ' ' << i;
    }
}

TEST_F(Source, AGlobeFromZeroTo360HasNoSeam) {
    // As ETOPO5: posts on the poles, from longitude 0 on, and a pixel size that is slightly off.
    const TestRaster raster(0.0, 90.0, 1.0, 1.0, 360, 181, hills);
    const TestRaster printed(0.0, 90.0, 1.0000093, 1.0, 360, 181,
                             [](double p, double l) { return hills(p, std::round(l)); });
    const LoadedDatabase database = databaseOf({saved(printed), "--cells", "24", "--levels", "1"});
    checkDatabase(database, raster);
    for (const double longitude : {-22.5, -0.9375, 0.0, 22.5, 179.0625, -180.0}) {
        const double west = std::floor(longitude), share = longitude - west;
        const double height = (1.0 - share) * hills(30.0, west) + share * hills(30.0, west + 1.0);
        EXPECT_NEAR(database.altitudeAt(30.0, longitude), height, 0.3) << longitude;
    }
}

TEST_F(Source, GlobesThatRepeatTheirFirstColumnAndGlobesOfCellsKeepTheirPlace) {
    const TestRaster repeating(-180.0, 90.0, 1.0, 1.0, 361, 181, hills);
    const TestRaster cells(-179.5, 89.5, 1.0, 1.0, 360, 180, [](double latitude, double) { return 10.0 * latitude; });
    for (const TestRaster* raster : {&repeating, &cells}) {
        const LoadedDatabase database = databaseOf({saved(*raster), "--cells", "10", "--levels", "0"});
        checkDatabase(database, *raster);
        EXPECT_NEAR(database.altitudeAt(0.0, 135.0), raster == &repeating ? hills(0.0, 135.0) : 0.0, 0.3);
        if (raster == &repeating) continue;
        EXPECT_NEAR(database.altitudeAt(90.0, 11.25), 895.0, 0.3);
        EXPECT_NEAR(database.altitudeAt(-90.0, 11.25), -895.0, 0.3);
    }
}

TEST_F(Source, TheFinestRasterCountsAndOnlyItsAreaGoesDeep) {
    const TestRaster inset(10.0, 52.0, 0.02, 101, flat(700.0));
    const LoadedDatabase database = databaseOf({savedGlobe(1.0, flat(100.0)), saved(inset), "--blend", "0"});
    EXPECT_NEAR(database.altitudeAt(51.0, 11.0), 700.0, 0.01);
    EXPECT_NEAR(database.altitudeAt(47.0, 11.0), 100.0, 0.3);
    // One level for the globe, as 24 cells are the fewest; the inset's spacing needs six.
    EXPECT_EQ(database.leafAt(51.0, 11.0).level, 6);
    EXPECT_EQ(database.leafAt(-51.0, 11.0).level, 0);
    checkDatabase(database, [&](const Rect& rect) {
        // Inside the inset the globe is not used.
        Range range = inset.range(rect);
        const bool isInside = rect.west >= 10.0 && rect.east <= 12.0 && rect.south >= 50.0 && rect.north <= 52.0;
        if (!isInside) range.include(100.0);
        return range;
    });
}

TEST_F(Source, EdgesOfAnInsetAreClosedBySkirts) {
    // A deep tile beside one without children: its skirt reaches the coarse tile's edge, whatever the difference.
    const LoadedDatabase database =
        databaseOf({savedGlobe(1.0, hills), saved(TestRaster(0.1, 44.9, 0.02, 100, hills))});
    const auto ellipsoid = database.ellipsoid();
    const LoadedTile& coarse = database.leafAt(44.0, -11.0);
    ASSERT_EQ(coarse.level, 0);
    int tested = 0;
    database.forEach([&](const LoadedTile& tile) {
        const Rect rect = tile.rect();
        if (rect.west != 0.0 || rect.south < 22.5 || rect.north > 45.0 || tile.level == 0) return;
        if (!tile.children.empty() && tile.level != 1) return;
        for (int row = 0; row <= tile.cells; ++row) {
            const double place =
                (rect.south + (rect.north - rect.south) * row / tile.cells - 22.5) / 22.5 * coarse.cells;
            const int below = std::min(static_cast<int>(place), coarse.cells - 1);
            const glm::dvec3& south = coarse.post(coarse.cells, below);
            const glm::dvec3 chord = south + (place - below) * (coarse.post(coarse.cells, below + 1) - south);
            EXPECT_LE(ellipsoid.toGeodetic(tile.westHem(row)).altitude, ellipsoid.toGeodetic(chord).altitude + 0.01);
            ++tested;
        }
    });
    EXPECT_GT(tested, 100);
}

TEST_F(Source, MissingHeightsFallThroughToTheNextRasterAndToZero) {
    const double kMissing = std::nan("");
    TestRaster fine(0.0, 20.0, 0.5, 41, [&](double, double l) { return l < 10.0 ? 900.0 : kMissing; });
    const TestRaster coarse(0.0, 20.0, 1.0, 21, [&](double p, double) { return p < 10.0 ? 400.0 : kMissing; });
    // NaN as it is in the coarse one
    const LoadedDatabase database = databaseOf({saved(coarse), saved(fine.withNodata(-9999.0))});
    EXPECT_NEAR(database.altitudeAt(5.0, 5.0), 900.0, 0.3);
    EXPECT_NEAR(database.altitudeAt(5.0, 15.0), 400.0, 0.3);
    EXPECT_NEAR(database.altitudeAt(15.0, 15.0), 0.0, 0.3);
    EXPECT_NEAR(database.altitudeAt(-50.0, 100.0), 0.0, 0.3);
    checkSharedPosts(database);
    database.forEach([](const LoadedTile& tile) {
        EXPECT_LT(tile.altitude().upper, 901.0);
        EXPECT_GT(tile.altitude().lower, -2000.0);
    });
}

TEST_F(Source, NumbersOfAnyTypeAreHeights) {
    const OpenRaster doubles(savedGlobe(5.0, [](double, double east) { return east < 0.0 ? 100.0 : 127.0; }));
    const auto expectHeights = [](const std::string& path, double west, double east) {
        DemMosaic mosaic = mosaicOf({path});
        EXPECT_EQ(mosaic.height({22.5, -90.0}), west) << path;
        EXPECT_EQ(mosaic.height({22.5, 90.0}), east) << path;
    };
    for (int i = 1; i < GDT_TypeCount; ++i) {
        const auto type = static_cast<GDALDataType>(i);
        if (GDALDataTypeIsComplex(type)) continue;  // no format of heights has them
        const std::string name = GDALGetDataTypeName(type);
        std::string words[] = {"-ot", name, "-a_nodata", "127"};
        char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
        GDALTranslateOptions* options = GDALTranslateOptionsNew(arguments, nullptr);
        GDALClose(GDALTranslate(file(name).c_str(), GDALDataset::ToHandle(doubles.operator->()), options, nullptr));
        GDALTranslateOptionsFree(options);
        expectHeights(file(name), 100.0, 0.0);
    }
}

TEST_F(Source, NodataCanBeNamed) {
    DemMosaic mosaic =
        mosaicOf({savedGlobe(2.0, [](double p, double) { return p > 0.0 ? 50.0 : -5555.0; }), "--nodata", "-5555"});
    EXPECT_EQ(mosaic.height({45.0, 0.0}), 50.0);
    EXPECT_EQ(mosaic.height({-45.0, 0.0}), 0.0);
}

TEST_F(Source, UnitsAreForAllOrForEach) {
    const Words rasters{savedGlobe(2.0, flat(1000.0)), saved(TestRaster(0.0, 20.0, 0.5, 41, flat(3000.0)))};
    const auto expectHeights = [&](const Words& units, double ofGlobe, double ofInset) {
        DemMosaic mosaic = mosaicOf(joined(joined(rasters, {"--height-unit"}), units));
        EXPECT_NEAR(mosaic.height({-45.0, -45.0}), ofGlobe, 1e-6);
        EXPECT_NEAR(mosaic.height({11.25, 11.25}), ofInset, 1e-6);
    };
    expectHeights({"ft"}, 304.8, 914.4);
    expectHeights({"m", "ft"}, 1000.0, 914.4);
    expectHeights({"0.5,2"}, 500.0, 6000.0);
    expectHeights({"0.5", "2"}, 500.0, 6000.0);
}

TEST_F(Source, VoidsByMasksAndByNumbersThatNoTerrainHas) {
    for (const bool isMap : {false, true}) {
        for (const double number : {1e6, -999999.0, -99999.0, -32768.0}) expectPlain(plainWith(number, isMap), isMap);
        const std::string path = plainWith(0.0, isMap);
        {
            const OpenRaster raster(path, GDAL_OF_UPDATE);
            std::vector<double> mask = OpenRaster::read(raster.band());
            for (double& number : mask) number = number > 0.0 ? 255.0 : 0.0;
            raster->CreateMaskBand(GMF_PER_DATASET);
            OpenRaster::write(*raster.band().GetMaskBand(), mask);
        }
        expectPlain(path, isMap);
        std::filesystem::remove(path + ".msk");
    }
    // The lowest number of a type is a mark in any unit.
    const std::string path = plainWith(-32768.0, false);
    {
        const OpenRaster raster(path, GDAL_OF_UPDATE);
        raster.band().SetScale(0.1);
        raster.band().SetOffset(1350.0);
    }
    expectPlain(path, false);
}

TEST_F(Source, UnitsThatBandsDeclare) {
    for (const bool isMap : {false, true}) {
        const std::string path = plainWith(1500.0, isMap);
        OpenRaster(path, GDAL_OF_UPDATE).band().SetUnitType("ft");
        EXPECT_NEAR(mosaicOf({path}).height(kMiddles[isMap ? 1 : 0]), 457.2, 1e-3);
        OpenRaster(path, GDAL_OF_UPDATE).band().SetUnitType("counts");
        EXPECT_THROW((void)mosaicOf({path}), osgAnalyticBin::support::Failure);
    }
}

TEST_F(Source, MasksAlphaAndNodataCountTogether) {
    const std::string path = file("plain.tif");
    {
        const OpenRaster raster(path, {100, 100, 2}, GDT_Float32, 10.0, 50.0, 0.01, 0.01, "EPSG:4326", "ALPHA=YES");
        raster.band().SetNoDataValue(-1.0);
        raster->CreateMaskBand(GMF_PER_DATASET);
        GDALRasterBand* const bands[] = {&raster.band(1), &raster.band(2), raster.band().GetMaskBand()};
        // Each has a square of its own where it says that there is no height.
        for (const int own : {0, 1, 2}) {
            std::vector<double> numbers(10000, own == 0 ? 1500.0 : 255.0);
            for (int square = 0; square < 3; ++square) {
                for (int place = 0; place < 90; ++place) {
                    double& number =
                        numbers[static_cast<std::size_t>(100 * (46 + place / 10) + 25 + 10 * square + place % 10)];
                    if (own == 0) number = square == 0 ? -1.0 : 5000.0;
                    if (own > 0 && own == square) number = 0.0;
                }
            }
            OpenRaster::write(*bands[own], numbers);
        }
    }
    DemMosaic mosaic = mosaicOf({path});
    for (int i = 0; i < 100; ++i) EXPECT_NEAR(mosaic.height({49.5, 10.0 + 0.01 * i}), 1500.0, 1e-3) << i;
}

TEST_F(Source, ARasterBesideThePoleReachesItsNearestPlace) {
    TestRaster strip(-1.6225e6, -3500.0, 5000.0, 5000.0, 640, 10, flat(500.0));
    DemMosaic mosaic = mosaicOf({saved(strip.in("EPSG:3413"))});
    for (const double latitude : {89.9, 89.93, 89.95}) EXPECT_NEAR(mosaic.height({latitude, -45.0}), 500.0, 1e-3);
}

TEST_F(Source, OtherBodiesHaveTheRadiiThatTheirRastersDeclare) {
    TestRaster moon = TestRaster::globe(5.0, flat(1000.0)).in("+proj=longlat +R=1737400 +no_defs");
    TestRaster map(-5457450.0, 2728650.0, 151600.0, 151600.0, 72, 36, flat(1000.0));
    for (const std::string& path : {saved(moon), saved(map.in("+proj=eqc +R=1737400 +no_defs"))}) {
        const LoadedDatabase database = databaseOf({path, "--levels", "0"});
        EXPECT_EQ(database.ellipsoid().equatorialRadius(), 1737400.0);
        EXPECT_EQ(database.ellipsoid().polarRadius(), 1737400.0);
        EXPECT_NEAR(database.altitudeAt(22.5, 22.5), 1000.0, 0.3) << path;
    }
}

TEST_F(Source, TheBandThatIsNamedCounts) {
    {
        const OpenRaster raster(file("two.tif"), {72, 36, 2}, GDT_Float32, -180.0, 90.0, 5.0, 5.0);
        raster.band(1).Fill(100.0);
        raster.band(2).Fill(700.0);
    }
    EXPECT_EQ(mosaicOf({file("two.tif"), "-b", "2"}).height({22.5, 22.5}), 700.0);
    DemMosaic first = mosaicOf({file("two.tif")});
    EXPECT_EQ(first.height({22.5, 22.5}), 100.0);
    const Words notes = first.inspect();
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes.front().find("band 1 of 2"), std::string::npos) << notes.front();
}

TEST_F(Source, RastersOfCentimetresAreDeepAndSmall) {
    const LoadedDatabase database = databaseOf({saved(TestRaster(1.0, 2.0, 4.5e-7, 20, flat(500.0)))});
    EXPECT_EQ(database.deepestLevel(), 20);
    EXPECT_NEAR(database.altitudeAt(2.0 - 4e-6, 1.0 + 4e-6), 500.0, 0.1);
    checkSharedPosts(database);
}

class LargeSource : public RasterTest {};

/// An overview of half the resolution with one height everywhere, to be told from the raster's own.
void addOverview(const std::string& path, double height) {
    const OpenRaster raster(path, GDAL_OF_UPDATE);
    int factor = 2;
    ASSERT_EQ(raster->BuildOverviews("NONE", 1, &factor, 0, nullptr, nullptr, nullptr), CE_None);
    ASSERT_EQ(raster.band().GetOverview(0)->Fill(height), CE_None);
}

TEST_F(LargeSource, MemoryChangesNothingThatIsBuilt) {
    // A start tile has more posts than eight threads together may hold in memory.
    const Words words{saved(TestRaster(0.0, 50.0, 0.01, 1000, hills)),
                      "--levels",
                      "3",
                      "--cells",
                      "12",
                      "-te",
                      "0",
                      "40",
                      "10",
                      "50"};
    build(joined(words, {"-o", _folder.makeFolder("usual") + "/earth.osgb"}));
    build(joined(words, {"--memory", "16", "--threads", "8", "-o", _folder.makeFolder("little") + "/earth.osgb"}));
    EXPECT_TRUE(filesBelow(file("little")) == filesBelow(file("usual")));
}

TEST_F(LargeSource, AnOverviewIsReadWhereItIsFineEnough) {
    const std::string globe = savedGlobe(0.5, flat(100.0));
    addOverview(globe, 700.0);
    const auto altitude = [&](const Words& options) {
        const LoadedDatabase database = databaseOf(joined({globe, "-te", "40", "40", "50", "50"}, options));
        checkSharedPosts(database);
        checkNodes(database);
        return database.altitudeAt(45.0, 45.0);
    };
    // Posts of start tiles: 1.125 degrees apart with 20 cells, 0.9375 with 24.
    EXPECT_NEAR(altitude({"--levels", "0", "--cells", "20"}), 700.0, 0.3);
    EXPECT_NEAR(altitude({"--levels", "0", "--cells", "24"}), 100.0, 0.3);
    EXPECT_NEAR(altitude({"--levels", "1", "--cells", "20"}), 100.0, 0.3);
    EXPECT_NEAR(altitude({"--levels", "0", "--cells", "20", "--full-resolution"}), 100.0, 0.3);
}

TEST_F(LargeSource, TheOverviewOfAWarpedRasterIsRead) {
    const std::string utm = saved(TestRaster(400000.0, 5600000.0, 500.0, 400, flat(200.0)).in("EPSG:32632"));
    addOverview(utm, 900.0);
    const Words words{utm, "-te", "7", "48", "11", "51"};
    EXPECT_NEAR(databaseOf(joined(words, {"--levels", "4"})).altitudeAt(49.6, 9.0), 900.0, 0.5);
    EXPECT_NEAR(databaseOf(words).altitudeAt(49.6, 9.0), 200.0, 0.5);
}

}  // namespace
