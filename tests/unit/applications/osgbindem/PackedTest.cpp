// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Databases of packed tiles against those of meshes: all that is loaded has to be equal, number by number. The bytes of
// a grid by themselves: tests/unit/applications/packed/TerrainGridTest.cpp.

#include "DatabaseCheck.h"
#include "Program.h"

#include <gtest/gtest.h>
#include <osg/Texture2D>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

namespace {

namespace fs = std::filesystem;

std::size_t bytesBelow(const std::string& folder) {
    std::size_t sum = 0;
    for (const auto& [name, bytes] : filesBelow(folder)) sum += bytes.size();
    return sum;
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

/// Builds the database twice.
void buildBoth(const TempFolder& folder, std::vector<std::string> arguments) {
    for (const char* name : {"mesh", "packed"}) {
        fs::create_directory(folder.file(name));
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"-o", folder.file(std::string(name) + "/earth.osgb")});
        if (std::string(name) == "packed") all.emplace_back("--packed");
        build(all);
    }
}

void expectEqualDatabases(const TempFolder& folder) {
    std::map<std::tuple<int, int, int>, LoadedTile> meshes;
    loadDatabase(folder.file("mesh/earth.osgb")).forEach([&](const LoadedTile& tile) {
        meshes[{tile.level, tile.x, tile.y}] = tile;
    });
    std::size_t count = 0;
    loadDatabase(folder.file("packed/earth.osgb")).forEach([&](const LoadedTile& tile) {
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

}  // namespace

TEST(Packed, LoadsAsTheSameMeshesFromAFifthOfTheBytes) {
    const TempFolder folder;
    const TestRaster raster = TestRaster::globe(1.0, hills);
    raster.write(folder.file("globe.tif"));
    buildBoth(folder, {folder.file("globe.tif"), "--cells", "24", "--levels", "1"});
    expectEqualDatabases(folder);
    EXPECT_LT(5 * bytesBelow(folder.file("packed")), bytesBelow(folder.file("mesh")));
    checkDatabase(loadDatabase(folder.file("packed/earth.osgb")),
                  [&raster](const Rect& rect) { return raster.range(rect); });
}

TEST(Packed, IsCompressedAndDrapedLikeMeshes) {
    const TempFolder folder;
    TestRaster::globe(1.0, hills).write(folder.file("globe.tif"));
    buildBoth(folder, {folder.file("globe.tif"), "--cells", "12", "--levels", "1", "--compress", "--image",
                       folder.file("globe.tif")});
    expectEqualDatabases(folder);
}

TEST(Packed, TilesOfAFileShareWhatIsTheSame) {
    const TempFolder folder;
    TestRaster::globe(1.0, hills).write(folder.file("globe.tif"));
    buildBoth(folder, {folder.file("globe.tif"), "--cells", "12", "--levels", "0"});
    std::set<const osg::PrimitiveSet*> shared;
    const LoadedDatabase database = loadDatabase(folder.file("packed/earth.osgb"));
    for (const LoadedTile& tile : database.tiles) shared.insert(tile.geometry->getPrimitiveSet(0));
    EXPECT_EQ(shared.size(), 1U);
}
