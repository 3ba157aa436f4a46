// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// What a database is made of and what its bins promise, on synthetic rasters; the oracles are brute-force loops over
// the raster and points sampled from the loaded triangles. Choosing among rasters: SourceTest.cpp.

#include "DatabaseCheck.h"
#include "Program.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace {

namespace fs = std::filesystem;

double bottom(const LoadedTile& tile) {
    return tile.bin.bin().altitude().lower;
}
double top(const LoadedTile& tile) {
    return tile.bin.bin().altitude().upper;
}

}  // namespace

TEST(Database, HoldsForAWholeGlobe) {
    const TestRaster raster = TestRaster::globe(1.0, hills);
    const LoadedDatabase database = databaseOf(raster, {"--cells", "6"});
    EXPECT_EQ(database.deepestLevel(), 2);
    checkDatabase(database, raster);
}

TEST(Database, HoldsWhenTheRasterIsMuchFinerThanTheTiles) {
    const TestRaster raster = TestRaster::globe(0.5, hills);
    const LoadedDatabase database = databaseOf(raster, {"--cells", "6", "--levels", "0"});
    EXPECT_EQ(database.deepestLevel(), 0);
    checkDatabase(database, raster);
}

TEST(Database, SkirtsOfFlatTerrainAreAsDeepAsTheSagOfItsChords) {
    const TestRaster flat = TestRaster::globe(1.0, [](double, double) { return 0.0; });
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    databaseOf(flat, {"--cells", "12"}).forEach([](const LoadedTile& tile) {
        // Against the parent's chords, four times the own; the own and the bound's slack on skirts on top.
        const double step = std::ldexp(22.5 * kDegree / 12.0, -tile.level);
        const double sag = 6400000.0 * step * step / 8.0;
        EXPECT_GT(bottom(tile), -(6.2 * sag + 2.0)) << tile.level;
        EXPECT_LT(top(tile), 0.1);
    });
}

TEST(Database, TheSkirtReachesTheEdgesOfTheLevelsAboveAndBelow) {
    // Independent of the program's measure: every post of a child on its parent's edge, against the parent's chords.
    const LoadedDatabase database = databaseOf(TestRaster::globe(1.0, hills), {"--cells", "6"});
    const auto ellipsoid = database.ellipsoid();
    const auto altitude = [&ellipsoid](const glm::dvec3& p) { return ellipsoid.toGeodetic(p).altitude; };
    database.forEach([&](const LoadedTile& tile) {
        if (tile.children.empty()) return;
        for (int i = 0; i < tile.cells; ++i) {
            // The west edge: the third skirt.
            const std::size_t lower =
                tile.surfaceCount() + 2U * static_cast<std::size_t>(tile.cells + 1) + static_cast<std::size_t>(i);
            const LoadedTile& child = tile.children[2 * i < tile.cells ? 0 : 2];
            const int row = (2 * i + 1) % child.cells;
            const glm::dvec3& fine = child.post(0, row);
            const double chord = altitude(0.5 * (tile.post(0, i) + tile.post(0, i + 1)));
            const double hem = altitude(0.5 * (tile.vertices[lower] + tile.vertices[lower + 1]));
            EXPECT_LE(hem, altitude(fine));
            EXPECT_GE(chord, hem);
            const std::size_t childLower =
                child.surfaceCount() + 2U * static_cast<std::size_t>(child.cells + 1) + static_cast<std::size_t>(row);
            EXPECT_LE(altitude(child.vertices[childLower]), chord);
        }
    });
}

TEST(Database, NormalsAreTheSameOnBothSidesOfAnEdge) {
    const LoadedDatabase database = databaseOf(TestRaster::globe(1.0, hills), {"--cells", "12", "--levels", "0"});
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 16; ++x) {
            const LoadedTile& west = database.tiles[static_cast<std::size_t>(y * 16 + x)];
            const LoadedTile& east = database.tiles[static_cast<std::size_t>(y * 16 + (x + 1) % 16)];
            const auto& a = dynamic_cast<const osg::Vec3Array&>(*west.geometry->getNormalArray());
            const auto& b = dynamic_cast<const osg::Vec3Array&>(*east.geometry->getNormalArray());
            for (std::size_t row = 0; row <= 12; ++row) EXPECT_LT((a[row * 13 + 12] - b[row * 13]).length(), 1e-5F);
        }
    }
}

TEST(Database, LoadsFromAnyWorkingDirectory) {
    const TempFolder folder;
    TestRaster::globe(1.0, hills).write(folder.file("globe.tif"));
    fs::create_directory(folder.file("deep"));
    build({folder.file("globe.tif"), "--cells", "4", "--levels", "1", "-o", folder.file("deep/earth.osgb")});
    const fs::path before = fs::current_path();
    fs::current_path(folder.file("deep"));
    EXPECT_EQ(loadDatabase("earth.osgb").deepestLevel(), 1);
    fs::current_path(folder.file("."));
    EXPECT_EQ(loadDatabase("deep/earth.osgb").deepestLevel(), 1);
    fs::current_path(before);
    fs::rename(folder.file("deep"), folder.file("moved"));
    EXPECT_EQ(loadDatabase(folder.file("moved/earth.osgb")).deepestLevel(), 1);
}

TEST(Database, DeepTreesAreSpreadOverFolders) {
    const TempFolder folder;
    TestRaster(10.0, 50.0, 0.0005, 0.0005, 20, 20, hills).write(folder.file("small.tif"));
    build({folder.file("small.tif"), "--cells", "4", "--levels", "12", "-o", folder.file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    EXPECT_EQ(database.deepestLevel(), 12);
    checkSharedPosts(database);
    checkNodes(database);
    std::size_t inStartFolder = 0;
    for (const auto& entry : fs::directory_iterator(folder.file("earth_tiles/X08_Y6"))) {
        if (entry.is_regular_file()) ++inStartFolder;
    }
    EXPECT_LT(inStartFolder, 342U);
}

TEST(Database, OptionsChangeWhatTheySay) {
    const TempFolder folder;
    const TestRaster raster = TestRaster::globe(1.0, hills);
    raster.write(folder.file("globe.tif"));
    const auto builtWith = [&folder](const std::string& name, const std::vector<std::string>& options) {
        std::vector<std::string> arguments{folder.file("globe.tif"), "-o", folder.file(name + ".osgb")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        build(arguments);
        return loadDatabase(folder.file(name + ".osgb"));
    };
    const LoadedDatabase plain = builtWith("plain", {"--levels", "1", "--cells", "16"});
    const LoadedDatabase far = builtWith("far", {"--levels", "1", "--cells", "16", "--lod-factor", "8", "--compress"});
    EXPECT_EQ(plain.tiles[40].cells, 16);
    EXPECT_FLOAT_EQ(far.tiles[40].lod()->getMinRange(0), 2.0F * plain.tiles[40].lod()->getMinRange(0));
    EXPECT_LT(fs::file_size(folder.file("far.osgb")), fs::file_size(folder.file("plain.osgb")));
    EXPECT_EQ(plain.root->getFormat(), "WKT");
    EXPECT_NE(plain.root->getCoordinateSystem().find("WGS"), std::string::npos);

    const LoadedDatabase moon = builtWith("moon", {"--levels", "0", "--radii", "1738100", "1736000"});
    EXPECT_EQ(moon.root->getEllipsoidModel()->getRadiusEquator(), 1738100.0);
    EXPECT_EQ(moon.root->getEllipsoidModel()->getRadiusPolar(), 1736000.0);
    EXPECT_EQ(moon.root->getCoordinateSystem(), "");
    checkDatabase(moon, raster);
}

TEST(Database, TheDefaultDepthFitsTheRaster) {
    // 0.5 degrees: 45 cells in a start tile, made even.
    const LoadedDatabase database = databaseOf(TestRaster::globe(0.5, [](double, double) { return 0.0; }));
    EXPECT_EQ(database.deepestLevel(), 0);
    EXPECT_EQ(database.tiles[0].cells, 46);
}

TEST(Database, ARerunReplacesTheOldDatabaseWhenItIsToldTo) {
    const TempFolder folder;
    TestRaster::globe(2.0, hills).write(folder.file("globe.tif"));
    TestRaster::globe(2.0, [](double, double) { return 5.0; }).write(folder.file("flat.tif"));
    build({folder.file("globe.tif"), "--cells", "4", "--levels", "2", "-o", folder.file("earth.osgb")});
    const std::vector<std::string> rerun{folder.file("flat.tif"),  "--cells", "4", "--levels", "1", "-o",
                                         folder.file("earth.osgb")};
    const auto before = filesBelow(folder.file("earth_tiles"));
    const Outcome refused = run(rerun);
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_NE(refused.errors.find("is there already; give --overwrite"), std::string::npos) << refused.errors;
    EXPECT_TRUE(filesBelow(folder.file("earth_tiles")) == before);
    std::vector<std::string> overwriting = rerun;
    overwriting.emplace_back("--overwrite");
    build(overwriting);
    const std::vector<std::string> expected{"earth.osgb", "earth.osgb.sources", "earth_tiles", "flat.tif", "globe.tif"};
    EXPECT_EQ(folder.names(), expected);
    const LoadedDatabase database = loadDatabase(folder.file("earth.osgb"));
    EXPECT_EQ(database.deepestLevel(), 1);
    EXPECT_NEAR(database.altitudeAt(11.25, 11.25), 5.0, 0.2);
    EXPECT_FALSE(fs::exists(folder.file("earth_tiles/X08_Y4/L02_X32_Y16.osgb")));
}
