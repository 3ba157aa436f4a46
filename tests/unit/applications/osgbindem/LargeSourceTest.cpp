// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Rasters that are too large to be one file in memory: mosaics of files, overviews, little memory.

#include "DatabaseCheck.h"
#include "Program.h"

#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace {

/// The files of a database built with these arguments.
Files built(const std::vector<std::string>& arguments) {
    const TempFolder folder;
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"-o", folder.file("earth.osgb")});
    build(all);
    std::filesystem::create_directory(folder.file("all"));
    std::filesystem::rename(folder.file("earth.osgb"), folder.file("all/earth.osgb"));
    if (std::filesystem::exists(folder.file("earth_tiles"))) {
        std::filesystem::rename(folder.file("earth_tiles"), folder.file("all/earth_tiles"));
    }
    return filesBelow(folder.file("all"));
}

GDALDataset& opened(const std::string& path, unsigned int access) {
    GDALDataset* dataset = GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | access);
    if (dataset == nullptr) throw std::runtime_error("cannot open " + path);
    return *dataset;
}

/// An overview of half the resolution with one height everywhere, to be told from the raster's own.
void addOverview(const std::string& path, double height) {
    GDALDataset& dataset = opened(path, GDAL_OF_UPDATE);
    int factor = 2;
    ASSERT_EQ(dataset.BuildOverviews("NONE", 1, &factor, 0, nullptr, nullptr, nullptr), CE_None);
    GDALRasterBand& band = *dataset.GetRasterBand(1)->GetOverview(0);
    ASSERT_EQ(band.Fill(height), CE_None);
    GDALClose(GDALDataset::ToHandle(&dataset));
}

/// A virtual raster of files, each with some degrees of the first.
void writeMosaic(const TestRaster& whole, int files, const TempFolder& folder, const std::string& name) {
    whole.write(folder.file("whole.tif"));
    GDALDataset& dataset = opened(folder.file("whole.tif"), GDAL_OF_READONLY);
    const int width = dataset.GetRasterXSize() / files;
    std::vector<std::string> paths;
    for (int i = 0; i < files; ++i) {
        const int columns = i + 1 < files ? width : dataset.GetRasterXSize() - i * width;
        std::vector<std::string> words{"-srcwin", std::to_string(i * width), "0", std::to_string(columns),
                                       std::to_string(dataset.GetRasterYSize())};
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        GDALTranslateOptions* options = GDALTranslateOptionsNew(arguments.data(), nullptr);
        paths.push_back(folder.file("part" + std::to_string(i) + ".tif"));
        GDALDatasetH part = GDALTranslate(paths.back().c_str(), GDALDataset::ToHandle(&dataset), options, nullptr);
        GDALTranslateOptionsFree(options);
        ASSERT_NE(part, nullptr);
        GDALClose(part);
    }
    GDALClose(GDALDataset::ToHandle(&dataset));
    std::vector<const char*> names;
    for (const std::string& path : paths) names.push_back(path.c_str());
    GDALDatasetH mosaic = GDALBuildVRT(folder.file(name).c_str(), static_cast<int>(names.size()), nullptr, names.data(),
                                       nullptr, nullptr);
    ASSERT_NE(mosaic, nullptr);
    GDALClose(mosaic);
}

}  // namespace

TEST(LargeSource, AMosaicOfFilesIsAsTheWhole) {
    GDALAllRegister();
    const TempFolder folder;
    writeMosaic(TestRaster::globe(2.0, hills), 12, folder, "globe.vrt");
    const Files ofWhole = built({folder.file("whole.tif"), "--levels", "1", "--cells", "6"});
    EXPECT_EQ(built({folder.file("globe.vrt"), "--levels", "1", "--cells", "6"}), ofWhole);
    EXPECT_EQ(ofWhole.size(), 129U);
}

TEST(LargeSource, MemoryChangesNothingThatIsBuilt) {
    GDALAllRegister();
    const TempFolder folder;
    // A start tile has more posts than eight threads together may hold in memory.
    TestRaster(0.0, 50.0, 0.01, 0.01, 1000, 1000, hills).write(folder.file("fine.tif"));
    std::vector<std::string> words{folder.file("fine.tif"), "--levels", "3", "--cells", "12"};
    words.insert(words.end(), {"-te", "0", "40", "10", "50"});
    const Files usual = built(words);
    words.insert(words.end(), {"--memory", "16", "--threads", "8"});
    EXPECT_EQ(built(words), usual);
}

TEST(LargeSource, AnOverviewIsReadWhereItIsFineEnough) {
    GDALAllRegister();
    const TempFolder folder;
    const std::string globe = folder.file("globe.tif");
    TestRaster::globe(0.5, [](double, double) { return 100.0; }).write(globe);
    addOverview(globe, 700.0);
    const auto altitude = [&](std::vector<std::string> arguments) {
        const TempFolder output;
        arguments.insert(arguments.end(), {globe, "-te", "40", "40", "50", "50", "-o", output.file("earth.osgb")});
        build(arguments);
        const LoadedDatabase database = loadDatabase(output.file("earth.osgb"));
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

TEST(LargeSource, TheOverviewOfAWarpedRasterIsRead) {
    GDALAllRegister();
    const TempFolder folder;
    const std::string path = folder.file("utm.tif");
    TestRaster utm(400000.0, 5600000.0, 500.0, 500.0, 400, 400, [](double, double) { return 200.0; });
    utm.setReference("EPSG:32632");
    utm.write(path);
    addOverview(path, 900.0);
    const auto highest = [&](std::vector<std::string> arguments) {
        const TempFolder output;
        arguments.insert(arguments.end(), {path, "-te", "7", "48", "11", "51", "-o", output.file("earth.osgb")});
        build(arguments);
        double upper = 0.0;
        for (const LoadedTile& tile : loadDatabase(output.file("earth.osgb")).tiles) {
            upper = std::max(upper, tile.bin.bin().altitude().upper);
        }
        return upper;
    };
    EXPECT_NEAR(highest({"--levels", "4"}), 900.0, 0.5);
    EXPECT_NEAR(highest({}), 200.0, 0.5);
}
