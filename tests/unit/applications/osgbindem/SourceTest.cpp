// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Which heights a database has: several rasters, missing data, units, reference systems, the date line, images.

#include "DatabaseCheck.h"
#include "Program.h"

#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gtest/gtest.h>
#include <osg/Texture2D>

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

SourceRange rangeOf(const TestRaster& raster) {
    return [&raster](const Rect& rect) { return raster.range(rect); };
}

}  // namespace

TEST(Source, AGlobeFromZeroTo360HasNoSeam) {
    const TempFolder folder;
    // As ETOPO5: posts on the poles, from longitude 0 on, and a pixel size that is slightly off.
    const TestRaster raster(0.0, 90.0, 1.0, 1.0, 360, 181, hills);
    const TestRaster printed(0.0, 90.0, 1.0000093, 1.0, 360, 181,
                             [](double p, double l) { return hills(p, std::round(l)); });
    printed.write(folder.file("globe.tif"));
    build({folder.file("globe.tif"), "--cells", "24", "--levels", "1", "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    checkDatabase(database, rangeOf(raster));
    for (const double longitudeDeg : {-22.5, 0.0, 22.5, 179.0625, -180.0}) {
        EXPECT_NEAR(database.altitudeAt(22.5, longitudeDeg), raster.height(22.5, longitudeDeg), 0.3) << longitudeDeg;
    }
}

TEST(Source, AGlobeThatRepeatsItsFirstColumnKeepsItsPlace) {
    const TempFolder folder;
    const TestRaster raster(-180.0, 90.0, 1.0, 1.0, 361, 181, hills);
    raster.write(folder.file("globe.tif"));
    build({folder.file("globe.tif"), "--cells", "10", "--levels", "0", "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    checkDatabase(database, rangeOf(raster));
    EXPECT_NEAR(database.altitudeAt(0.0, 135.0), hills(0.0, 135.0), 0.3);
}

TEST(Source, CellRegisteredGlobesReachThePoles) {
    const TempFolder folder;
    const TestRaster raster(-179.5, 89.5, 1.0, 1.0, 360, 180, north);
    raster.write(folder.file("globe.tif"));
    build({folder.file("globe.tif"), "--cells", "10", "--levels", "0", "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    checkDatabase(database, rangeOf(raster));
    EXPECT_NEAR(database.altitudeAt(90.0, 11.25), 895.0, 0.3);
    EXPECT_NEAR(database.altitudeAt(-90.0, 11.25), -895.0, 0.3);
}

TEST(Source, TheFinestRasterCountsAndOnlyItsAreaGoesDeep) {
    const TempFolder folder;
    const TestRaster globe = TestRaster::globe(1.0, [](double, double) { return 100.0; });
    const TestRaster inset(10.0, 52.0, 0.02, 0.02, 101, 101, [](double, double) { return 700.0; });
    globe.write(folder.file("globe.tif"));
    inset.write(folder.file("inset.tif"));
    build({folder.file("globe.tif"), folder.file("inset.tif"), "--blend", "0", "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
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
    build({folder.file("globe.tif"), folder.file("inset.tif"), "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
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
    build({folder.file("coarse.tif"), folder.file("fine.tif"), "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
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
        build({folder.file(name + ".tif"), "--cells", "4", "--levels", "0", "-o", folder.file(name + ".osgb")});
        const LoadedDatabase database = loadDatabase(folder.file(name + ".osgb"));
        EXPECT_NEAR(database.altitudeAt(22.5, -90.0), 100.0, 0.1) << name;
        EXPECT_NEAR(database.altitudeAt(22.5, 90.0), 0.0, 0.1) << name;
    }
}

TEST(Source, NodataCanBeNamed) {
    const TempFolder folder;
    TestRaster::globe(2.0, [](double p, double) { return p > 0.0 ? 50.0 : -5555.0; }).write(folder.file("globe.tif"));
    build({folder.file("globe.tif"), "--nodata", "-5555", "--levels", "0", "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    EXPECT_NEAR(database.altitudeAt(45.0, 0.0), 50.0, 0.3);
    EXPECT_NEAR(database.altitudeAt(-45.0, 0.0), 0.0, 0.3);
}

TEST(Source, UnitsAreForAllOrForEach) {
    const TempFolder folder;
    TestRaster::globe(2.0, [](double, double) { return 1000.0; }).write(folder.file("globe.tif"));
    TestRaster(0.0, 20.0, 0.5, 0.5, 41, 41, [](double, double) { return 3000.0; }).write(folder.file("inset.tif"));
    const auto built = [&](const std::vector<std::string>& scales) {
        std::vector<std::string> arguments{"--levels",     "0", "-o", folder.file("earth.osgb"), "--overwrite",
                                           "--height-unit"};
        arguments.insert(arguments.end(), scales.begin(), scales.end());
        arguments.insert(arguments.end(), {folder.file("globe.tif"), folder.file("inset.tif")});
        build(arguments);
        const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
        return std::pair{database.altitudeAt(-45.0, -45.0), database.altitudeAt(11.25, 11.25)};
    };
    EXPECT_NEAR(built({"ft"}).first, 304.8, 0.3);
    EXPECT_NEAR(built({"m", "ft"}).first, 1000.0, 0.3);
    EXPECT_NEAR(built({"m", "ft"}).second, 914.4, 0.3);
    EXPECT_NEAR(built({"0.5,2"}).first, 500.0, 0.3);
    EXPECT_NEAR(built({"0.5", "2"}).second, 6000.0, 0.3);
}

TEST(Source, RastersThatPassTheDateLine) {
    const TempFolder folder;
    const TestRaster raster(165.0, 65.0, 0.25, 0.25, 201, 81, [](double p, double l) { return 2000.0 + hills(p, l); });
    raster.write(folder.file("aleutians.tif"));
    build({folder.file("aleutians.tif"), "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    checkSharedPosts(database);
    for (const double longitudeDeg : {168.75, 180.0, -168.75}) {
        const double expected = raster.height(56.25, longitudeDeg);
        EXPECT_NEAR(database.altitudeAt(56.25, longitudeDeg), expected, 0.3) << longitudeDeg;
    }
    EXPECT_NEAR(database.altitudeAt(56.25, 157.5), 0.0, 0.3);
}

TEST(Source, ProjectedRastersAreWarpedAndTheirPeaksKept) {
    const TempFolder folder;
    GDALAllRegister();
    // UTM zone 32, 500 m pixels, flat but for one pixel.
    TestRaster utm(400000.0, 5600000.0, 500.0, 500.0, 200, 200, [](double y, double x) {
        return std::abs(x - 450000.0) < 100.0 && std::abs(y - 5550000.0) < 100.0 ? 3000.0 : 200.0;
    });
    utm.setReference("EPSG:32632");
    utm.write(folder.file("utm.tif"));
    build({folder.file("utm.tif"), "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    EXPECT_NEAR(database.altitudeAt(50.3, 8.0), 200.0, 0.1);
    EXPECT_GE(database.leafAt(50.1, 8.3).level, 4);
    double highest = 0.0;
    for (const LoadedTile& tile : database.tiles) highest = std::max(highest, tile.bin.bin().altitude().upper);
    EXPECT_GE(highest, 3000.0);
    EXPECT_LT(highest, 3001.0);
    // 450 km east, 5550 km north in the zone: 50.097 N, 8.301 E.
    EXPECT_GE(database.leafAt(50.0973, 8.3011).bin.bin().altitude().upper, 3000.0);
    checkSharedPosts(database);
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

/// Expects the plain without anything in it.
void expectPlain(const TempFolder& folder, const std::string& path, bool isMap) {
    build({path, "--overwrite", "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    const double latitudeDeg = isMap ? 50.4902 : 49.495;
    const double longitudeDeg = isMap ? 10.4803 : 10.505;
    for (int i = -8; i <= 8; ++i) {
        const double step = isMap ? 0.001 : 0.01;
        EXPECT_NEAR(database.altitudeAt(latitudeDeg + i * step, longitudeDeg), 1500.0, 0.2) << path << ' ' << i;
        EXPECT_NEAR(database.altitudeAt(latitudeDeg, longitudeDeg + i * step), 1500.0, 0.2) << path << ' ' << i;
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
            expectPlain(folder, path, isMap);
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
        expectPlain(folder, path, isMap);
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
        build({path, "--overwrite", "-o", folder.file("earth.osgb")});
        EXPECT_NEAR(
            loadDatabase(folder.file("earth.osgb")).altitudeAt(isMap ? 50.4902 : 49.495, isMap ? 10.4803 : 10.505),
            457.2, 0.1);
        declare("counts");
        EXPECT_NE(run({path, "--overwrite", "-o", folder.file("earth.osgb")}).errors.find("give --height-unit"),
                  std::string::npos);
    }
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
        build({folder.file(name), "--levels", "0", "--overwrite", "-o", folder.file("moon.osgb")});
        const LoadedDatabase database = loadDatabase(folder.file("moon.osgb"));
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
    build({folder.file("two.tif"), "-b", "2", "--levels", "0", "-o", folder.file("earth.osgb")});
    EXPECT_NEAR(loadDatabase(folder.file("earth.osgb")).altitudeAt(22.5, 22.5), 700.0, 0.3);
    const Outcome outcome =
        run({folder.file("two.tif"), "--levels", "0", "--overwrite", "-o", folder.file("earth.osgb")});
    EXPECT_NE(outcome.output.find("band 1 of 2"), std::string::npos) << outcome.output;
    EXPECT_NEAR(loadDatabase(folder.file("earth.osgb")).altitudeAt(22.5, 22.5), 100.0, 0.3);
}

TEST(Source, RastersOfCentimetresAreDeepAndSmall) {
    const TempFolder folder;
    TestRaster(1.0, 2.0, 4.5e-7, 4.5e-7, 20, 20, [](double, double) { return 500.0; }).write(folder.file("fine.tif"));
    build({folder.file("fine.tif"), "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    EXPECT_EQ(database.deepestLevel(), 20);
    EXPECT_NEAR(database.altitudeAt(2.0 - 4e-6, 1.0 + 4e-6), 500.0, 0.1);
    checkSharedPosts(database);
}

TEST(Source, ImagesAreDrapedWithinTheTilesFile) {
    const TempFolder folder;
    GDALAllRegister();
    TestRaster::globe(2.0, hills).write(folder.file("globe.tif"));
    GDALDataset* image = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(folder.file("image.tif").c_str(), 360,
                                                                                  180, 3, GDT_Byte, nullptr);
    double transform[6] = {-180.0, 1.0, 0.0, 90.0, 0.0, -1.0};
    image->SetGeoTransform(transform);
    std::vector<std::uint8_t> red(360 * 180);
    for (std::size_t i = 0; i < red.size(); ++i) red[i] = i < red.size() / 2 ? 250 : 10;
    std::vector<std::uint8_t> flat(360 * 180, 77);
    for (int band = 1; band <= 3; ++band) {
        ASSERT_EQ(image->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, 360, 180, band == 1 ? red.data() : flat.data(),
                                                       360, 180, GDT_Byte, 0, 0, nullptr),
                  CE_None);
    }
    GDALClose(GDALDataset::ToHandle(image));
    build({folder.file("globe.tif"), "--image", folder.file("image.tif"), "--levels", "1", "-o",
           folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    checkSharedPosts(database);
    checkNodes(database);
    database.forEach([](const LoadedTile& tile) {
        const auto* texture = dynamic_cast<const osg::Texture2D*>(
            tile.geometry->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
        ASSERT_NE(texture, nullptr);
        const osg::Image& texels = *texture->getImage();
        ASSERT_EQ(texels.s(), tile.level == 0 ? 32 : 16);
        const bool isNorth = tile.rect().south >= 0.0;
        const std::uint8_t* middle = texels.data(8, 8);
        EXPECT_EQ(middle[0], isNorth ? 250 : 10);
        EXPECT_EQ(middle[1], 77);
        const auto* coordinates = dynamic_cast<const osg::Vec2Array*>(tile.geometry->getTexCoordArray(0));
        ASSERT_NE(coordinates, nullptr);
        EXPECT_EQ(coordinates->size(), tile.vertices.size());
    });
}
