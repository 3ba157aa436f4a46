// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Copies of databases with bins inside: the same meshes, the bins of the index, and nothing of the original touched.

#include "BinconvRuns.h"
#include "DrawnDatabase.h"
#include "SmallDatabase.h"
#include "TestDatabases.h"

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <gtest/gtest.h>
#include <osg/ClusterCullingCallback>
#include <osg/PagedLOD>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgTerrain/TerrainTile>

#include <TileFixture.h>
#include <filesystem>
#include <fstream>
#include <support/StockPrograms.h>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

Outcome binconv(const std::string& arguments) {
    return runStock(test::quoted(OSGBINCONV_PROGRAM) + " --quiet " + arguments, Modules::Present);
}

std::string copied(const std::string& from, const std::string& to, const std::string& options = {}) {
    return binconv(options + ' ' + test::quoted(from) + ' ' + test::quoted(to)).text;
}

CullOptions requestOf(const std::string& rootFile) {
    const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(rootFile);
    const auto* request = root ? dynamic_cast<const InstallBinsCallback*>(root->getUpdateCallback()) : nullptr;
    EXPECT_TRUE(request);
    return request ? request->getCullOptions() : CullOptions();
}

class Copy : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Copy, DrawsTheSameAndCarriesTheBinsOfTheIndex) {
    const auto [kind, extension] = GetParam();
    if (!isAtHand(kind)) GTEST_SKIP() << kind << " is not there";
    const TemporaryFolder folder;
    const std::string database = makeDatabase(kind, folder);
    ASSERT_FALSE(database.empty());
    const std::string copy = folder.makeFolder("copy") + "/new." + extension;
    ASSERT_EQ(binconv("--index " + test::quoted(database)).text, "");
    ASSERT_EQ(copied(database, copy), "");
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
    const CullOptions request = requestOf(copy);
    // what covers the globe is proven when it is shown
    EXPECT_EQ(request.horizonUse, HorizonUse::Declared);
    EXPECT_EQ(request.cluster, ClusterUse::Replace);
}

INSTANTIATE_TEST_SUITE_P(Makes, Copy,
                         ::testing::Values(std::pair("synthetic", "osgt"), std::pair("terrain", "osgb"),
                                           std::pair("polygonal", "osgb")),
                         [](const auto& suite) { return std::string(suite.param.first); });

TEST(CopyOfTerrain, HasTilesAsUntouchedAsTheOriginal) {
    if (!isAtHand("terrain")) GTEST_SKIP() << "no sample database";
    const TemporaryFolder folder;
    const std::string database = makeDatabase("terrain", folder);
    const std::string copy = folder.makeFolder("copy") + "/earth.osgb";
    ASSERT_EQ(copied(database, copy), "");
    const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(copy);
    const auto& paged = dynamic_cast<osg::PagedLOD&>(*root->asGroup()->getChild(0));
    const auto* tile = dynamic_cast<const osgTerrain::TerrainTile*>(paged.getChild(0));
    ASSERT_TRUE(tile);
    EXPECT_EQ(tile->getTerrainTechnique(), nullptr);
    EXPECT_EQ(tile->getNumChildren(), 0u);
    EXPECT_TRUE(tile->getColorLayer(0));
    ASSERT_TRUE(tile->getColorLayer(0)->getImage());
    EXPECT_GT(tile->getColorLayer(0)->getImage()->s(), 8);
}

TEST(SmallCopy, OpensInStockOsgWithOneWarning) {
    const TemporaryFolder folder;
    const std::string database = makeDatabase("synthetic", folder);
    const std::string copy = folder.makeFolder("copy") + "/globe.osgb";
    ASSERT_EQ(copied(database, copy), "");
    const Outcome without = runOsgconv(test::quoted(copy) + ' ' + test::quoted(folder / "out.osgt"), Modules::Absent);
    EXPECT_EQ(without.code, 0);
    EXPECT_EQ(without.linesWith("osgAnalyticBin"), 1) << without.text;
    const Outcome with = runOsgconv(test::quoted(copy) + ' ' + test::quoted(folder / "out.osgt"), Modules::Present);
    EXPECT_EQ(with.linesWith("osgAnalyticBin"), 0) << with.text;
    EXPECT_EQ(with.linesWith("rror"), 0) << with.text;
}

TEST(SmallCopy, ClusterCallbacksAreRemovedUnlessTheyAreToStay) {
    const TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> tile = makeSmallTile("a.osgb");
    const auto addCluster = [](osg::Node& node) {
        node.setCullCallback(new osg::ClusterCullingCallback(osg::Vec3(), osg::Vec3(0, 0, 1), -1.0f));
    };
    addCluster(*tile);
    addCluster(*tile->asGroup()->getChild(0)->asGroup()->getChild(0));
    writeSmallFile(folder / "earth.osgb", *tile, true);
    writeSmallFile(folder / "a.osgb", *makeSmallTile(""));
    ASSERT_EQ(copied(folder / "earth.osgb", folder.makeFolder("removed") + "/earth.osgb"), "");
    ASSERT_EQ(copied(folder / "earth.osgb", folder.makeFolder("kept") + "/earth.osgb", "--cluster keep"), "");
    for (const bool isKept : {false, true}) {
        const std::string root = folder / (isKept ? "kept/earth.osgb" : "removed/earth.osgb");
        const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(root);
        osg::Node* paged = node->asGroup()->getChild(0);
        osg::Node* geode = paged->asGroup()->getChild(0)->asGroup()->getChild(0);
        EXPECT_EQ(paged->getCullCallback() != nullptr, isKept);
        EXPECT_EQ(geode->getCullCallback() != nullptr, isKept);
        EXPECT_EQ(requestOf(root).cluster, isKept ? ClusterUse::Keep : ClusterUse::Replace);
    }
}

TEST(SmallCopy, NothingIsReplacedUnasked) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a.osgb"), true);
    writeSmallFile(folder / "a.osgb", *makeSmallTile(""));
    const std::string from = test::quoted(folder / "earth.osgb");
    expectFailure(binconv(from + ' ' + from), "is a file of the database itself");
    expectFailure(binconv("--overwrite " + from + ' ' + test::quoted(folder / "b.osgb")),
                  "is a file of the database itself");
    const std::string to = folder.makeFolder("copy") + "/earth.osgb";
    std::ofstream(folder / "copy/a.osgb") << "mine";
    expectFailure(binconv(from + ' ' + test::quoted(to)), "--overwrite");
    EXPECT_EQ(textOfFile(folder / "copy/a.osgb"), "mine");
    EXPECT_FALSE(fs::exists(to));
    EXPECT_EQ(copied(folder / "earth.osgb", to, "--overwrite"), "");
    EXPECT_EQ(readAllTiles(to).size(), 2u);
    // beside the original under another extension
    EXPECT_EQ(copied(folder / "earth.osgb", folder / "earth.osgt"), "");
    EXPECT_EQ(readAllTiles(folder / "earth.osgt").size(), 2u);
}

TEST(SmallCopy, AFolderInTheWayOfTheLastFileLeavesNothing) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a.osgb"), true);
    writeSmallFile(folder / "a.osgb", *makeSmallTile(""));
    ASSERT_FALSE(folder.makeFolder("copy/a.osgb.tmp").empty());
    expectFailure(binconv(test::quoted(folder / "earth.osgb") + ' ' + test::quoted(folder / "copy/earth.osgb")),
                  "cannot write");
    EXPECT_FALSE(fs::exists(folder / "copy/earth.osgb"));
    EXPECT_FALSE(fs::exists(folder / "copy/a.osgb"));
}

}  // namespace
}  // namespace osgAnalyticBin::test
