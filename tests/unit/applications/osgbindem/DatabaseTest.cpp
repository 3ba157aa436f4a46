// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What a database is made of and what its bins promise; the oracles are brute-force loops over the raster and points
// sampled from the loaded triangles. Regions (-te), real elevation data, where they are installed, and packed tiles,
// which have to load as meshes do. Choosing among rasters: SourceTest.cpp.

#include "RasterTest.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <cstring>
#include <set>
#include <tuple>

namespace {

namespace fs = std::filesystem;

class Database : public RasterTest {};

/// Independent of the program's measure: every post of a child on its parent's edge, against the parent's chords.
void checkWesternSkirts(const LoadedDatabase& database) {
    const auto ellipsoid = database.ellipsoid();
    const auto altitude = [&ellipsoid](const glm::dvec3& p) { return ellipsoid.toGeodetic(p).altitude; };
    database.forEach([&](const LoadedTile& tile) {
        if (tile.children.empty()) return;
        for (int i = 0; i < tile.cells; ++i) {
            const LoadedTile& child = tile.children[2 * i < tile.cells ? 0 : 2];
            const int row = (2 * i + 1) % child.cells;
            const double chord = altitude(0.5 * (tile.post(0, i) + tile.post(0, i + 1)));
            const double hem = altitude(0.5 * (tile.westHem(i) + tile.westHem(i + 1)));
            EXPECT_LE(hem, altitude(child.post(0, row)));
            EXPECT_GE(chord, hem);
            EXPECT_LE(altitude(child.westHem(row)), chord);
        }
    });
}

void checkNormalsAlongEdges(const std::vector<LoadedTile>& startTiles) {
    for (std::size_t i = 0; i < startTiles.size(); ++i) {
        const std::size_t next = i % 16 == 15 ? i - 15 : i + 1;
        const auto& west = dynamic_cast<const osg::Vec3Array&>(*startTiles[i].geometry->getNormalArray());
        const auto& east = dynamic_cast<const osg::Vec3Array&>(*startTiles[next].geometry->getNormalArray());
        const auto cells = static_cast<std::size_t>(startTiles[i].cells);
        for (std::size_t row = 0; row <= cells; ++row)
            EXPECT_LT((west[row * (cells + 1) + cells] - east[row * (cells + 1)]).length(), 1e-5F);
    }
}

TEST_F(Database, HoldsForAWholeGlobe) {
    const TestRaster raster = TestRaster::globe(1.0, hills);
    const LoadedDatabase database = databaseOf({saved(raster), "--cells", "6"});
    EXPECT_EQ(database.deepestLevel(), 2);
    checkDatabase(database, raster);
    checkWesternSkirts(database);
    checkNormalsAlongEdges(database.tiles);
}

TEST_F(Database, SkirtsOfFlatTerrainAreAsDeepAsTheSagOfItsChords) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    databaseOf({savedGlobe(1.0, flat(0.0)), "--cells", "12"}).forEach([](const LoadedTile& tile) {
        // Against the parent's chords, four times the own; the own and the bound's slack on skirts on top.
        const double step = std::ldexp(22.5 * kDegree / 12.0, -tile.level);
        const double sag = 6400000.0 * step * step / 8.0;
        EXPECT_GT(tile.altitude().lower, -(6.2 * sag + 2.0)) << tile.level;
        EXPECT_LT(tile.altitude().upper, 0.1);
    });
}

TEST_F(Database, DeepTreesAreSpreadOverFolders) {
    build(
        {saved(TestRaster(10.0, 50.0, 0.0005, 20, hills)), "--cells", "4", "--levels", "12", "-o", file("earth.osgb")});
    const LoadedDatabase database = loadDatabase(file("earth.osgb"));
    EXPECT_EQ(database.deepestLevel(), 12);
    checkSharedPosts(database);
    checkNodes(database);
    const auto inStartFolder = std::count_if(fs::directory_iterator(file("earth_tiles/X08_Y6")), {},
                                             [](const auto& entry) { return entry.is_regular_file(); });
    EXPECT_LT(inStartFolder, 342);
}

TEST_F(Database, OptionsChangeWhatTheySay) {
    const TestRaster raster = TestRaster::globe(1.0, hills);
    const std::string globe = saved(raster);
    const auto builtWith = [&](const std::string& name, const Words& options) {
        build(joined({globe, "-o", file(name)}, options));
        return loadDatabase(file(name));
    };
    const LoadedDatabase plain = builtWith("plain.osgb", {"--levels", "1", "--cells", "16"});
    const LoadedDatabase far =
        builtWith("far.osgb", {"--levels", "1", "--cells", "16", "--lod-factor", "8", "--compress"});
    EXPECT_EQ(plain.tiles[40].cells, 16);
    EXPECT_FLOAT_EQ(far.tiles[40].lod()->getMinRange(0), 2.0F * plain.tiles[40].lod()->getMinRange(0));
    EXPECT_LT(fs::file_size(file("far.osgb")), fs::file_size(file("plain.osgb")));
    EXPECT_EQ(plain.root->getFormat(), "WKT");
    EXPECT_NE(plain.root->getCoordinateSystem().find("WGS"), std::string::npos);

    const LoadedDatabase moon = builtWith("moon.osgb", {"--levels", "0", "--radii", "1738100", "1736000"});
    EXPECT_EQ(moon.ellipsoid().equatorialRadius(), 1738100.0);
    EXPECT_EQ(moon.ellipsoid().polarRadius(), 1736000.0);
    EXPECT_EQ(moon.root->getCoordinateSystem(), "");
    checkDatabase(moon, raster);
}

TEST_F(Database, ARerunReplacesTheOldDatabaseWhenItIsToldTo) {
    const Words output{"--cells", "4", "-o", file("out/earth.osgb")};
    fs::create_directory(file("out"));
    build(joined({savedGlobe(2.0, hills), "--levels", "2"}, output));
    const Words rerun = joined({savedGlobe(2.0, flat(5.0)), "--levels", "1"}, output);
    const Files before = filesBelow(file("out"));
    expectFailure(rerun, "is there already; give --overwrite");
    EXPECT_TRUE(filesBelow(file("out")) == before);
    build(joined(rerun, {"--overwrite"}));
    Words names;
    for (const auto& entry : fs::directory_iterator(file("out"))) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (Words{"earth.osgb", "earth_tiles"}));
    const LoadedDatabase database = loadDatabase(file("out/earth.osgb"));
    EXPECT_EQ(database.deepestLevel(), 1);
    EXPECT_NEAR(database.altitudeAt(11.25, 11.25), 5.0, 0.2);
    EXPECT_FALSE(fs::exists(file("out/earth_tiles/X08_Y4/L02_X32_Y16.osgb")));
}

class Region : public RasterTest {
protected:
    const std::string globe = savedGlobe(1.0, hills);
    const std::string inset = saved(TestRaster(10.0, 52.0, 0.04, 76, hills));
};

TEST_F(Region, HasTilesOnlyWhereTheyAreNeeded) {
    const LoadedDatabase whole = databaseOf({globe, inset, "--cells", "24"});
    const LoadedDatabase part = databaseOf({globe, inset, "--cells", "24", "-te", "11", "50", "12", "51"});
    EXPECT_LE(part.tiles.size(), 16U);
    int wanted = 0;
    int others = 0;
    part.forEach([&](const LoadedTile& tile) {
        const Rect rect = tile.rect();
        const bool isWanted = rect.west < 12.0 && rect.east > 11.0 && rect.south < 51.0 && rect.north > 50.0;
        EXPECT_TRUE(isWanted || tile.children.empty());
        ++(isWanted ? wanted : others);
        for (const LoadedTile& child : tile.children) EXPECT_TRUE(tile.bin.contains(child.bin));
    });
    EXPECT_LT(others, wanted);
    // Within the region it is as deep as the globe, and has the same heights.
    EXPECT_EQ(part.leafAt(50.5, 11.5).level, whole.leafAt(50.5, 11.5).level);
    for (double latitude = 50.1; latitude < 51.0; latitude += 0.2)
        for (double longitude = 11.1; longitude < 12.0; longitude += 0.2)
            EXPECT_NEAR(part.altitudeAt(latitude, longitude), whole.altitudeAt(latitude, longitude), 0.01);
    checkSharedPosts(part);
    checkNodes(part);
    // Given horizons are for whole globes: beside a region there is no ground that hides anything.
    using osgAnalyticBin::HorizonUse;
    const auto horizonOf = [](const LoadedDatabase& database) {
        const osg::Callback& request = *database.root->getUpdateCallback();
        return dynamic_cast<const osgAnalyticBin::InstallBinsCallback&>(request).getCullOptions().horizonUse;
    };
    EXPECT_EQ(horizonOf(whole), HorizonUse::Given);
    EXPECT_NE(horizonOf(part), HorizonUse::Given);
}

TEST_F(Region, PassesTheDateLine) {
    const LoadedDatabase part = databaseOf({globe, inset, "--cells", "24", "-te", "170", "-20", "190", "-10"});
    std::set<int> columns;
    for (const LoadedTile& tile : part.tiles) columns.insert(tile.x);
    EXPECT_EQ(columns.count(0), 1U);
    EXPECT_EQ(columns.count((16 << part.tiles.front().level) - 1), 1U);
    EXPECT_NEAR(part.altitudeAt(-15.0, 180.0), hills(-15.0, 180.0), 30.0);
    checkSharedPosts(part);
}

TEST_F(Region, NoneOfTheEarthIsRefused) {
    for (const Words& region : {Words{"12", "50", "11", "51"},
                                {"11", "51", "12", "50"},
                                {"11", "50", "12", "91"},
                                {"11", "50", "nan", "51"},
                                {"11", "50", "12"}})
        expectFailure(joined({globe, "-o", file("refused.osgb"), "-te"}, region), "-te", 2);
    expectFailure({inset, "-o", file("refused.osgb"), "-te", "-100", "0", "-99", "1"},
                  "no raster has a part within -te");
}

#define OSGBINDEM_NEEDS(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there"

TEST(RealData, Etopo5) {
    const std::string path = "/usr/share/ferret-vis/data/etopo5.cdf";  // Debian's ferret-datasets
    OSGBINDEM_NEEDS(path);
    const LoadedDatabase database = databaseOf({path, "--levels", "1", "--cells", "18"});
    checkDatabase(database, TestRaster(path));
    EXPECT_NEAR(database.altitudeAt(-90.0, 0.0), 2810.0, 0.3);
    // The Challenger Deep, in the tile at 135 .. 157.5 E, 0 .. 22.5 N, and all above it.
    EXPECT_LE(database.leafAt(11.3, 142.2).altitude().lower, -10376.0);
    EXPECT_LE(database.tiles[4 * 16 + 14].altitude().lower, -10376.0);
}

bool areEqual(const osg::Array* a, const osg::Array* b) {
    if (a == nullptr || b == nullptr) return a == b;
    return a->getType() == b->getType() && a->getBinding() == b->getBinding() &&
           a->getNormalize() == b->getNormalize() && a->getTotalDataSize() == b->getTotalDataSize() &&
           std::memcmp(a->getDataPointer(), b->getDataPointer(), a->getTotalDataSize()) == 0;
}

void expectEqual(const osg::Geometry& a, const osg::Geometry& b) {
    EXPECT_STREQ(b.className(), "Geometry");
    EXPECT_STREQ(b.libraryName(), "osg");
    EXPECT_TRUE(areEqual(a.getVertexArray(), b.getVertexArray()));
    EXPECT_TRUE(areEqual(a.getNormalArray(), b.getNormalArray()));
    EXPECT_TRUE(areEqual(a.getColorArray(), b.getColorArray()));
    EXPECT_TRUE(areEqual(a.getTexCoordArray(0), b.getTexCoordArray(0)));
    ASSERT_EQ(b.getNumPrimitiveSets(), 1U);
    const auto& p = dynamic_cast<const osg::DrawElementsUShort&>(*a.getPrimitiveSet(0));
    const auto& q = dynamic_cast<const osg::DrawElementsUShort&>(*b.getPrimitiveSet(0));
    EXPECT_TRUE(std::equal(p.begin(), p.end(), q.begin(), q.end()));
    EXPECT_EQ(a.getStateSet() != nullptr, b.getStateSet() != nullptr);
}

class Packed : public RasterTest {
protected:
    /// Builds a database of meshes and one of packed tiles, and compares what is loaded.
    void expectEqualDatabases(const Words& arguments) const {
        build(joined(arguments, {"-o", _folder.makeFolder("mesh") + "/earth.osgb"}));
        build(joined(arguments, {"--packed", "-o", _folder.makeFolder("packed") + "/earth.osgb"}));
        std::map<std::tuple<int, int, int>, LoadedTile> meshes;
        loadDatabase(file("mesh/earth.osgb")).forEach([&](const LoadedTile& tile) {
            meshes[{tile.level, tile.x, tile.y}] = tile;
        });
        std::size_t count = 0;
        loadDatabase(file("packed/earth.osgb")).forEach([&](const LoadedTile& tile) {
            const LoadedTile& mesh = meshes.at({tile.level, tile.x, tile.y});
            expectEqual(*mesh.geometry, *tile.geometry);
            EXPECT_TRUE(mesh.bin.bin() == tile.bin.bin());
            EXPECT_GT(tile.bin.margin(), mesh.bin.margin());
            EXPECT_LT(tile.bin.margin(), mesh.bin.margin() + 0.26);
            EXPECT_TRUE(mesh.vertices == tile.vertices);
            ++count;
        });
        EXPECT_EQ(count, meshes.size());
    }

    /// Of the files that are shown.
    [[nodiscard]] std::size_t bytesIn(const std::string& folder) const {
        std::size_t sum = 0;
        for (const auto& [name, bytes] : filesBelow(file(folder)))
            if (fs::path(name).extension() == ".osgb") sum += bytes.size();
        return sum;
    }
};

TEST_F(Packed, LoadsAsTheSameMeshesFromAFifthOfTheBytes) {
    const TestRaster raster = TestRaster::globe(1.0, hills);
    expectEqualDatabases({saved(raster), "--cells", "24", "--levels", "1"});
    EXPECT_LT(5 * bytesIn("packed"), bytesIn("mesh"));
    const LoadedDatabase database = loadDatabase(file("packed/earth.osgb"));
    checkDatabase(database, raster);
    // Tiles of a file share what is the same.
    std::set<const osg::PrimitiveSet*> shared;
    for (const LoadedTile& tile : database.tiles) shared.insert(tile.geometry->getPrimitiveSet(0));
    EXPECT_EQ(shared.size(), 1U);
}

TEST_F(Packed, IsCompressedAndDrapedLikeMeshes) {
    const std::string globe = savedGlobe(1.0, hills);
    expectEqualDatabases({globe, "--cells", "12", "--levels", "1", "--compress", "--image", globe});
}

}  // namespace
