// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Which heights a database has: several rasters, missing data, units.

#include "DatabaseCheck.h"
#include "DemMosaic.h"
#include "Failure.h"
#include "Program.h"
#include "RasterFile.h"

#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace {

double north(double latitudeDeg, double) {
    return latitudeDeg * 10.0;
}

void writeAs(GDALDataType type, const std::string& from, const std::string& to) {
    std::vector<std::string> words{"-ot", GDALGetDataTypeName(type), "-a_nodata", "127"};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    GDALTranslateOptions* options = GDALTranslateOptionsNew(arguments.data(), nullptr);
    GDALDatasetH source = GDALOpen(from.c_str(), GA_ReadOnly);
    GDALDatasetH target = GDALTranslate(to.c_str(), source, options, nullptr);
    GDALTranslateOptionsFree(options);
    GDALClose(target);
    GDALClose(source);
    ASSERT_TRUE(target) << GDALGetDataTypeName(type);
}

/// The heights of rasters that a command line names, without a database.
osgbindem::DemMosaic mosaicOf(const std::vector<std::string>& words) {
    GDALAllRegister();
    std::vector<const char*> arguments{"osgbindem", "-o", "earth.osgb"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    const auto settings = osgbindem::settingsFrom(static_cast<int>(arguments.size()), arguments.data());
    return osgbindem::DemMosaic(osgbindem::withDeclaredRadii(settings.value()));
}

}  // namespace

TEST(Source, AGlobeFromZeroTo360HasNoSeam) {
    // As ETOPO5: posts on the poles, from longitude 0 on, and a pixel size that is slightly off.
    const TestRaster raster(0.0, 90.0, 1.0, 1.0, 360, 181, hills);
    const TestRaster printed(0.0, 90.0, 1.0000093, 1.0, 360, 181,
                             [](double p, double l) { return hills(p, std::round(l)); });
    const LoadedDatabase database = databaseOf(printed, {"--cells", "24", "--levels", "1"});
    checkDatabase(database, raster);
    for (const double longitudeDeg : {-22.5, 0.0, 22.5, 179.0625, -180.0}) {
        EXPECT_NEAR(database.altitudeAt(22.5, longitudeDeg), raster.height(22.5, longitudeDeg), 0.3) << longitudeDeg;
    }
}

TEST(Source, AGlobeThatRepeatsItsFirstColumnKeepsItsPlace) {
    const TestRaster raster(-180.0, 90.0, 1.0, 1.0, 361, 181, hills);
    const LoadedDatabase database = databaseOf(raster, {"--cells", "10", "--levels", "0"});
    checkDatabase(database, raster);
    EXPECT_NEAR(database.altitudeAt(0.0, 135.0), hills(0.0, 135.0), 0.3);
}

TEST(Source, CellRegisteredGlobesReachThePoles) {
    const TestRaster raster(-179.5, 89.5, 1.0, 1.0, 360, 180, north);
    const LoadedDatabase database = databaseOf(raster, {"--cells", "10", "--levels", "0"});
    checkDatabase(database, raster);
    EXPECT_NEAR(database.altitudeAt(90.0, 11.25), 895.0, 0.3);
    EXPECT_NEAR(database.altitudeAt(-90.0, 11.25), -895.0, 0.3);
}

TEST(Source, TheFinestRasterCountsAndOnlyItsAreaGoesDeep) {
    const TempFolder folder;
    const TestRaster globe = TestRaster::globe(1.0, [](double, double) { return 100.0; });
    const TestRaster inset(10.0, 52.0, 0.02, 0.02, 101, 101, [](double, double) { return 700.0; });
    globe.write(folder.file("globe.tif"));
    inset.write(folder.file("inset.tif"));
    const LoadedDatabase database = databaseOf({folder.file("globe.tif"), folder.file("inset.tif"), "--blend", "0"});
    EXPECT_NEAR(database.altitudeAt(51.0, 11.0), 700.0, 0.01);
    EXPECT_NEAR(database.altitudeAt(47.0, 11.0), 100.0, 0.3);
    // One level for the globe, as 24 cells are the fewest; the inset's spacing needs six.
    EXPECT_EQ(database.leafAt(51.0, 11.0).level, 6);
    EXPECT_EQ(database.leafAt(-51.0, 11.0).level, 0);
    checkSharedPosts(database);
    checkNodes(database);
    checkBins(database, [&](const Rect& rect) {
        // Inside the inset the globe is not used.
        Range range = inset.range(rect);
        const bool isInside = rect.west >= 10.0 && rect.east <= 12.0 && rect.south >= 50.0 && rect.north <= 52.0;
        if (!isInside) range.include(100.0);
        return range;
    });
}

TEST(Source, EdgesOfAnInsetAreClosedBySkirts) {
    // A deep tile beside one without children: its skirt reaches the coarse tile's edge, whatever the difference.
    const TempFolder folder;
    TestRaster::globe(1.0, hills).write(folder.file("globe.tif"));
    TestRaster(0.1, 44.9, 0.02, 0.02, 100, 100, hills).write(folder.file("inset.tif"));
    const LoadedDatabase database = databaseOf({folder.file("globe.tif"), folder.file("inset.tif")});
    const auto ellipsoid = database.ellipsoid();
    const LoadedTile& coarse = database.leafAt(44.0, -11.0);
    ASSERT_EQ(coarse.level, 0);
    int tested = 0;
    database.forEach([&](const LoadedTile& tile) {
        const Rect rect = tile.rect();
        if (rect.west != 0.0 || rect.south < 22.5 || rect.north > 45.0 || tile.level == 0) return;
        for (int row = 0; row <= tile.cells; ++row) {
            const double place =
                (rect.south + (rect.north - rect.south) * row / tile.cells - 22.5) / 22.5 * coarse.cells;
            const int below = std::min(static_cast<int>(place), coarse.cells - 1);
            const glm::dvec3 chord =
                coarse.post(coarse.cells, below) +
                (place - below) * (coarse.post(coarse.cells, below + 1) - coarse.post(coarse.cells, below));
            const auto hem = tile.vertices[tile.surfaceCount() + 2U * static_cast<std::size_t>(tile.cells + 1) +
                                           static_cast<std::size_t>(row)];
            if (tile.children.empty() || tile.level == 1) {
                EXPECT_LE(ellipsoid.toGeodetic(hem).altitude, ellipsoid.toGeodetic(chord).altitude + 0.01);
                ++tested;
            }
        }
    });
    EXPECT_GT(tested, 100);
}

TEST(Source, MissingHeightsFallThroughToTheNextRasterAndToZero) {
    const TempFolder folder;
    const double kMissing = std::nan("");
    TestRaster fine(0.0, 20.0, 0.5, 0.5, 41, 41, [&](double, double l) { return l < 10.0 ? 900.0 : kMissing; });
    TestRaster coarse(0.0, 20.0, 1.0, 1.0, 21, 21, [&](double p, double) { return p < 10.0 ? 400.0 : kMissing; });
    fine.setNodata(-9999.0);
    fine.write(folder.file("fine.tif"));
    coarse.write(folder.file("coarse.tif"));  // NaN as it is
    const LoadedDatabase database = databaseOf({folder.file("coarse.tif"), folder.file("fine.tif")});
    EXPECT_NEAR(database.altitudeAt(5.0, 5.0), 900.0, 0.3);
    // The void eases from its rim at 10 degrees to the coarser raster at the border at 20.
    EXPECT_NEAR(database.altitudeAt(5.0, 15.0), 650.0, 100.0);
    EXPECT_NEAR(database.altitudeAt(5.0, 19.9), 400.0, 30.0);
    EXPECT_NEAR(database.altitudeAt(15.0, 15.0), 0.0, 0.3);
    EXPECT_NEAR(database.altitudeAt(-50.0, 100.0), 0.0, 0.3);
    checkSharedPosts(database);
    database.forEach([](const LoadedTile& tile) {
        EXPECT_LT(tile.bin.bin().altitude().upper, 901.0);
        EXPECT_GT(tile.bin.bin().altitude().lower, -2000.0);
    });
}

TEST(Source, NumbersOfAnyTypeAreHeights) {
    const TempFolder folder;
    TestRaster::globe(5.0, [](double, double longitudeDeg) {
        return longitudeDeg < 0.0 ? 100.0 : 127.0;
    }).write(folder.file("globe.tif"));
    for (int i = 1; i < GDT_TypeCount; ++i) {
        const auto type = static_cast<GDALDataType>(i);
        if (GDALDataTypeIsComplex(type)) continue;  // no format of heights has them
        const std::string name = GDALGetDataTypeName(type);
        writeAs(type, folder.file("globe.tif"), folder.file(name + ".tif"));
        osgbindem::DemMosaic mosaic = mosaicOf({folder.file(name + ".tif")});
        EXPECT_EQ(mosaic.height({22.5, -90.0}), 100.0) << name;
        EXPECT_EQ(mosaic.height({22.5, 90.0}), 0.0) << name;
    }
}

TEST(Source, NodataCanBeNamed) {
    const TempFolder folder;
    TestRaster::globe(2.0, [](double p, double) { return p > 0.0 ? 50.0 : -5555.0; }).write(folder.file("globe.tif"));
    osgbindem::DemMosaic mosaic = mosaicOf({folder.file("globe.tif"), "--nodata", "-5555"});
    EXPECT_EQ(mosaic.height({45.0, 0.0}), 50.0);
    EXPECT_EQ(mosaic.height({-45.0, 0.0}), 0.0);
}

TEST(Source, UnitsAreForAllOrForEach) {
    const TempFolder folder;
    TestRaster::globe(2.0, [](double, double) { return 1000.0; }).write(folder.file("globe.tif"));
    TestRaster(0.0, 20.0, 0.5, 0.5, 41, 41, [](double, double) { return 3000.0; }).write(folder.file("inset.tif"));
    const auto heights = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "--height-unit");
        words.insert(words.end(), {folder.file("globe.tif"), folder.file("inset.tif")});
        osgbindem::DemMosaic mosaic = mosaicOf(words);
        return std::pair{mosaic.height({-45.0, -45.0}), mosaic.height({11.25, 11.25})};
    };
    EXPECT_NEAR(heights({"ft"}).first, 304.8, 1e-6);
    EXPECT_NEAR(heights({"m", "ft"}).first, 1000.0, 1e-6);
    EXPECT_NEAR(heights({"m", "ft"}).second, 914.4, 1e-6);
    EXPECT_NEAR(heights({"0.5,2"}).first, 500.0, 1e-6);
    EXPECT_NEAR(heights({"0.5", "2"}).second, 6000.0, 1e-6);
}

namespace {

/// A plain at 1500 m in degrees or in a map projection, with a square of another number in the middle.
TestRaster plainWith(double number, bool isMap) {
    const double scale = isMap ? 100.0 : 0.01;
    const double x = isMap ? 600050.0 : 10.005;
    const double y = isMap ? 5599950.0 : 49.995;
    TestRaster raster(x, y, scale, scale, 100, 100, [=](double north, double east) {
        const double away = std::max(std::abs(north - y + 50.0 * scale), std::abs(east - x - 50.0 * scale));
        return away < 5.5 * scale ? number : 1500.0;
    });
    raster.setReference(isMap ? "EPSG:25832" : "EPSG:4326");
    return raster;
}

constexpr osgbindem::PositionDeg kMiddles[] = {{49.495, 10.505}, {50.4902, 10.4803}};

/// Expects the plain without anything in it.
void expectPlain(const std::string& path, bool isMap) {
    osgbindem::DemMosaic mosaic = mosaicOf({path});
    const auto [latitudeDeg, longitudeDeg] = kMiddles[isMap ? 1 : 0];
    for (int i = -8; i <= 8; ++i) {
        const double step = isMap ? 0.001 : 0.01;
        EXPECT_NEAR(mosaic.height({latitudeDeg + i * step, longitudeDeg}), 1500.0, 1e-3) << path << ' ' << i;
        EXPECT_NEAR(mosaic.height({latitudeDeg, longitudeDeg + i * step}), 1500.0, 1e-3) << path << ' ' << i;
    }
}

}  // namespace

TEST(Source, VoidsByMasksAndByNumbersThatNoTerrainHas) {
    const TempFolder folder;
    GDALAllRegister();
    const std::string path = folder.file("plain.tif");
    for (const bool isMap : {false, true}) {
        for (const double number : {1e6, -999999.0, -99999.0, -32768.0}) {
            plainWith(number, isMap).write(path);
            expectPlain(path, isMap);
        }
        plainWith(0.0, isMap).write(path);
        GDALDataset* dataset = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE);
        std::vector<double> heights(10000);
        ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, 100, 100, heights.data(), 100, 100, GDT_Float64, 0,
                                                      0, nullptr),
                  CE_None);
        for (double& height : heights) height = height > 0.0 ? 255.0 : 0.0;
        dataset->CreateMaskBand(GMF_PER_DATASET);
        ASSERT_EQ(dataset->GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, 0, 100, 100, heights.data(), 100, 100,
                                                                     GDT_Float64, 0, 0, nullptr),
                  CE_None);
        GDALClose(GDALDataset::ToHandle(dataset));
        expectPlain(path, isMap);
        std::filesystem::remove(path + ".msk");
    }
}

TEST(Source, UnitsThatBandsDeclare) {
    const TempFolder folder;
    GDALAllRegister();
    const std::string path = folder.file("feet.tif");
    for (const bool isMap : {false, true}) {
        plainWith(1500.0, isMap).write(path);
        const auto declare = [&](const char* unit) {
            GDALDataset* dataset = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE);
            dataset->GetRasterBand(1)->SetUnitType(unit);
            GDALClose(GDALDataset::ToHandle(dataset));
        };
        declare("ft");
        EXPECT_NEAR(mosaicOf({path}).height(kMiddles[isMap ? 1 : 0]), 457.2, 1e-3);
        declare("counts");
        EXPECT_THROW((void)mosaicOf({path}), osgAnalyticBin::support::Failure);
    }
}

TEST(Source, ALowestNumberIsAMarkInAnyUnit) {
    const TempFolder folder;
    GDALAllRegister();
    plainWith(-32768.0, false).write(folder.file("plain.tif"));
    GDALDataset* dataset = GDALDataset::Open(folder.file("plain.tif").c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE);
    dataset->GetRasterBand(1)->SetScale(0.1);
    dataset->GetRasterBand(1)->SetOffset(1350.0);
    GDALClose(GDALDataset::ToHandle(dataset));
    expectPlain(folder.file("plain.tif"), false);
}

TEST(Source, SignedBytesAreSigned) {
    const TempFolder folder;
    GDALAllRegister();
    char* words[] = {const_cast<char*>("PIXELTYPE=SIGNEDBYTE"), nullptr};
    GDALDataset* dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(folder.file("small.tif").c_str(),
                                                                                    72, 36, 1, GDT_Byte, words);
    double transform[6] = {-180.0, 5.0, 0.0, 90.0, 0.0, -5.0};
    dataset->SetGeoTransform(transform);
    dataset->GetRasterBand(1)->Fill(256.0 - 7.0);
    GDALClose(GDALDataset::ToHandle(dataset));
    EXPECT_EQ(mosaicOf({folder.file("small.tif")}).height({22.5, 22.5}), -7.0);
}

TEST(Source, MasksAlphaAndNodataCountTogether) {
    const TempFolder folder;
    GDALAllRegister();
    const std::string path = folder.file("plain.tif");
    char* words[] = {const_cast<char*>("ALPHA=YES"), nullptr};
    GDALDataset* dataset =
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 100, 100, 2, GDT_Float32, words);
    double transform[6] = {10.0, 0.01, 0.0, 50.0, 0.0, -0.01};
    dataset->SetGeoTransform(transform);
    dataset->GetRasterBand(1)->SetNoDataValue(-1.0);
    dataset->CreateMaskBand(GMF_PER_DATASET);
    const std::array<GDALRasterBand*, 3> bands{dataset->GetRasterBand(1), dataset->GetRasterBand(2),
                                               dataset->GetRasterBand(1)->GetMaskBand()};
    // Each has a square of its own.
    for (const int missing : {0, 1, 2}) {
        std::vector<double> numbers(10000, missing == 0 ? 1500.0 : 255.0);
        for (int place = 0; place < 10000; ++place) {
            const bool isInRows = std::abs(place / 100 - 50) < 5;
            const int square = (place % 100 - 25) / 10;
            if (missing == 0 && isInRows && place % 100 > 24 && square < 3)
                numbers[static_cast<std::size_t>(place)] = square == 0 ? -1.0 : 5000.0;
            if (missing > 0 && isInRows && place % 100 > 24 && square == missing)
                numbers[static_cast<std::size_t>(place)] = 0.0;
        }
        ASSERT_EQ(bands[static_cast<std::size_t>(missing)]->RasterIO(GF_Write, 0, 0, 100, 100, numbers.data(), 100, 100,
                                                                     GDT_Float64, 0, 0, nullptr),
                  CE_None);
    }
    GDALClose(GDALDataset::ToHandle(dataset));
    osgbindem::DemMosaic mosaic = mosaicOf({path});
    for (int i = 0; i < 100; ++i) EXPECT_NEAR(mosaic.height({49.5, 10.0 + 0.01 * i}), 1500.0, 1e-3) << i;
}

TEST(Source, ARasterBesideThePoleReachesItsNearestPlace) {
    const TempFolder folder;
    TestRaster strip(-1.6225e6, -3500.0, 5000.0, 5000.0, 640, 10, [](double, double) { return 500.0; });
    strip.setReference("EPSG:3413");
    strip.write(folder.file("strip.tif"));
    osgbindem::DemMosaic mosaic = mosaicOf({folder.file("strip.tif")});
    for (const double latitude : {89.9, 89.93, 89.95}) EXPECT_NEAR(mosaic.height({latitude, -45.0}), 500.0, 1e-3);
}

TEST(Source, OtherBodiesHaveTheRadiiThatTheirRastersDeclare) {
    const TempFolder folder;
    TestRaster moon = TestRaster::globe(5.0, [](double, double) { return 1000.0; });
    moon.setReference("+proj=longlat +R=1737400 +no_defs");
    moon.write(folder.file("moon.tif"));
    TestRaster map(-5457450.0, 2728650.0, 151600.0, 151600.0, 72, 36, [](double, double) { return 1000.0; });
    map.setReference("+proj=eqc +R=1737400 +no_defs");
    map.write(folder.file("map.tif"));
    for (const char* name : {"moon.tif", "map.tif"}) {
        const LoadedDatabase database = databaseOf({folder.file(name), "--levels", "0"});
        EXPECT_EQ(database.ellipsoid().equatorialRadius(), 1737400.0);
        EXPECT_EQ(database.ellipsoid().polarRadius(), 1737400.0);
        EXPECT_NEAR(database.altitudeAt(22.5, 22.5), 1000.0, 0.3) << name;
    }
}

TEST(Source, TheBandThatIsNamedCounts) {
    const TempFolder folder;
    GDALAllRegister();
    GDALDataset* dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(folder.file("two.tif").c_str(), 72,
                                                                                    36, 2, GDT_Float32, nullptr);
    double transform[6] = {-180.0, 5.0, 0.0, 90.0, 0.0, -5.0};
    dataset->SetGeoTransform(transform);
    dataset->GetRasterBand(1)->Fill(100.0);
    dataset->GetRasterBand(2)->Fill(700.0);
    GDALClose(GDALDataset::ToHandle(dataset));
    EXPECT_EQ(mosaicOf({folder.file("two.tif"), "-b", "2"}).height({22.5, 22.5}), 700.0);
    osgbindem::DemMosaic first = mosaicOf({folder.file("two.tif")});
    EXPECT_EQ(first.height({22.5, 22.5}), 100.0);
    const std::vector<std::string> notes = first.inspect();
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes.front().find("band 1 of 2"), std::string::npos) << notes.front();
}

TEST(Source, RastersOfCentimetresAreDeepAndSmall) {
    const LoadedDatabase database =
        databaseOf(TestRaster(1.0, 2.0, 4.5e-7, 4.5e-7, 20, 20, [](double, double) { return 500.0; }));
    EXPECT_EQ(database.deepestLevel(), 20);
    EXPECT_NEAR(database.altitudeAt(2.0 - 4e-6, 1.0 + 4e-6), 500.0, 0.1);
    checkSharedPosts(database);
}
