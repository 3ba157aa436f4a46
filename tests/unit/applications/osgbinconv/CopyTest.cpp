// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Copies of databases with bins inside: the same meshes, the bins of the index, and nothing of the original touched.

#include "Binconv.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <gtest/gtest.h>
#include <osg/ClusterCullingCallback>
#include <osg/PagedLOD>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgTerrain/TerrainTile>

#include <TileFixture.h>
#include <filesystem>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

CullOptions requestOf(const std::string& rootFile) {
    const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(rootFile);
    return dynamic_cast<const InstallBinsCallback&>(*root->getUpdateCallback()).getCullOptions();
}

// VirtualPlanetBuilder's tiles are as untouched as in the original: without technique and mesh, and with their image.
void expectUntouched(const std::string& copyOfTerrain) {
    const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(copyOfTerrain);
    const auto& paged = dynamic_cast<osg::PagedLOD&>(*root->asGroup()->getChild(0));
    const auto& tile = dynamic_cast<const osgTerrain::TerrainTile&>(*paged.getChild(0));
    EXPECT_EQ(tile.getTerrainTechnique(), nullptr);
    EXPECT_EQ(tile.getNumChildren(), 0u);
    ASSERT_TRUE(tile.getColorLayer(0) && tile.getColorLayer(0)->getImage());
    EXPECT_GT(tile.getColorLayer(0)->getImage()->s(), 8);
}

class Copy : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Copy, DrawsTheSameAndCarriesTheBinsOfTheIndex) {
    const auto [kind, extension] = GetParam();
    if (!isAtHand(kind)) GTEST_SKIP() << kind << " is not there";
    const TemporaryFolder folder;
    const std::string database = makeDatabase(kind, folder);
    const std::string copy = folder.makeFolder("copy") + "/new." + extension;
    expectSuccess(runIndex(database));
    expectSuccess(runCopy(database, copy));
    const osg::ref_ptr<BinIndex> index = indexOf(database);
    const std::vector<DrawnTile> tiles = readAllTiles(database);
    const std::vector<DrawnTile> others = readAllTiles(copy);
    ASSERT_EQ(tiles.size(), others.size());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        // OSG's reader of text is off by units in the last place
        EXPECT_TRUE(tiles[i].fingerprint == others[i].fingerprint || std::string(extension) == "osgt");
        const std::string name =
            tiles[i].file.empty() ? "" : osgDB::getNameLessExtension(tiles[i].file) + "." + extension;
        EXPECT_EQ(others[i].file, name);
        const BinIndex::Entry* entry = index->find(tiles[i].file, tiles[i].ordinal);
        ASSERT_TRUE(entry);
        EXPECT_EQ(others[i].storedBin.toText(), entry->bin.toText());
        EXPECT_LE(metresOutside(entry->bin, others[i].samples, ellipsoidOfTests()), entry->bin.margin());
        EXPECT_EQ(others[i].samples.size(), tiles[i].samples.size());
    }
    // what covers the globe is proven when it is shown
    EXPECT_EQ(requestOf(copy).horizonUse, HorizonUse::Declared);
    EXPECT_EQ(requestOf(copy).cluster, ClusterUse::Replace);
    if (std::string(kind) == "terrain") expectUntouched(copy);
    if (std::string(kind) != "synthetic") return;
    // Stock OSG opens it, with one warning where our modules are absent.
    const std::string conversion = quoted(std::vector<std::string>{copy, folder / "out.osgt"});
    const Outcome without = runOsgconv(conversion, Modules::Absent);
    EXPECT_EQ(without.code, 0);
    EXPECT_EQ(without.linesWith("osgAnalyticBin"), 1) << without.text;
    const Outcome with = runOsgconv(conversion, Modules::Present);
    EXPECT_EQ(with.linesWith("osgAnalyticBin") + with.linesWith("rror"), 0) << with.text;
}

INSTANTIATE_TEST_SUITE_P(Makes, Copy,
                         ::testing::Values(std::pair("synthetic", "osgt"), std::pair("terrain", "osgb"),
                                           std::pair("polygonal", "osgb")),
                         [](const auto& suite) { return std::string(suite.param.first); });

class SmallCopy : public ::testing::Test {
protected:
    void SetUp() override {
        writeRoot(original, *makeSmallTile("a.osgb"));
        writeFile(folder / "a.osgb", *makeSmallTile(""));
        (void)folder.makeFolder("copy");
    }

    const TemporaryFolder folder;
    const std::string original = folder / "earth.osgb";
    const std::string copy = folder / "copy/earth.osgb";
};

TEST_F(SmallCopy, ClusterCallbacksAreRemovedUnlessTheyAreToStay) {
    const osg::ref_ptr<osg::Node> tile = makeSmallTile("a.osgb");
    const auto geodeOf = [](osg::Node& paged) { return paged.asGroup()->getChild(0)->asGroup()->getChild(0); };
    for (osg::Node* node : {tile.get(), geodeOf(*tile)})
        node->setCullCallback(new osg::ClusterCullingCallback(osg::Vec3(), osg::Vec3(0, 0, 1), -1.0f));
    writeRoot(original, *tile);
    for (const bool isKept : {false, true}) {
        expectSuccess(runCopy(original, copy, isKept ? "--cluster=keep" : "--quiet"));
        const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(copy);
        osg::Node& paged = *root->asGroup()->getChild(0);
        EXPECT_EQ(paged.getCullCallback() != nullptr, isKept);
        EXPECT_EQ(geodeOf(paged)->getCullCallback() != nullptr, isKept);
        EXPECT_EQ(requestOf(copy).cluster, isKept ? ClusterUse::Keep : ClusterUse::Replace);
        fs::remove_all(folder / "copy");
        fs::create_directory(folder / "copy");
    }
}

TEST_F(SmallCopy, NothingIsReplacedUnasked) {
    expectFailure(runCopy(original, original), "is a file of the database itself");
    expectFailure(runCopy(original, folder / "b.osgb", "--overwrite"), "is a file of the database itself");
    const std::string mine = folder.write("copy/a.osgb", "mine");
    expectFailure(runCopy(original, copy), "--overwrite");
    EXPECT_EQ(textOfFile(mine), "mine");
    EXPECT_FALSE(fs::exists(copy));
    expectSuccess(runCopy(original, copy, "--overwrite"));
    EXPECT_EQ(readAllTiles(copy).size(), 2u);
    // beside the original under another extension
    expectSuccess(runCopy(original, folder / "earth.osgt"));
    EXPECT_EQ(readAllTiles(folder / "earth.osgt").size(), 2u);
}

TEST_F(SmallCopy, AFolderInTheWayOfTheLastFileLeavesNothing) {
    (void)folder.makeFolder("copy/a.osgb.tmp");
    expectFailure(runCopy(original, copy), "cannot write");
    EXPECT_FALSE(fs::exists(copy));
    EXPECT_FALSE(fs::exists(folder / "copy/a.osgb"));
}

}  // namespace
}  // namespace osgAnalyticBin::test
