// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbinconv reads unusual databases, and answers what it cannot do with one clear line.

#include "BinconvRuns.h"
#include "SmallDatabase.h"

#include <osgAnalyticBin/BinIndex.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>

#include <filesystem>
#include <support/StockPrograms.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

TEST(SmallRun, NamesThatLeaveTheFolderAreRefused) {
    for (const char* name :
         {"../outside.osgb", "a/../../outside.osgb", "..\\outside.osgb", "..", "/etc/outside.osgb",
          "//etc/outside.osgb", "http://host/outside.osgb", "file:///etc/outside.osgb", "C:/outside.osgb"}) {
        const TemporaryFolder folder;
        writeSmallFile(folder / "db/earth.osgb", *makeSmallTile(name), true);
        writeSmallFile(folder / "outside.osgb", *makeSmallTile(""));
        expectFailure(runIndex(folder / "db/earth.osgb"), "outside of the database's folder");
        EXPECT_FALSE(fs::exists(folder / "db/earth.osgb.bins"));
        EXPECT_FALSE(fs::exists(folder / "db/earth.osgb.bins.part"));
        fs::create_directories(folder / "copy");
        expectFailure(runBinconv("--quiet " + test::quoted(folder / "db/earth.osgb") + ' ' +
                                 test::quoted(folder / "copy/e.osgb")),
                      "outside of the database's folder");
        EXPECT_TRUE(fs::is_empty(folder / "copy"));
    }
}

// Pseudo-loaders would open other files, or change what is read.
TEST(SmallRun, NamesWithPseudoLoadersAreNoFiles) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a.osgb.90,0,0.rot"), true);
    writeSmallFile(folder / "a.osgb", *makeSmallTile(""));
    const Outcome outcome = runIndex(folder / "earth.osgb");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.linesWith("missing or broken"), 1) << outcome.text;
}

/// A globe of groups in groups, deeper than OSG could write them with its own stack.
std::string nestedGroups(int depth) {
    std::string text = "#Ascii Scene \n#Version 161 \n#Generator OpenSceneGraph 3.6.5 \n\n";
    for (int i = 1; i <= depth; ++i) {
        text += i == 1 ? "osg::CoordinateSystemNode {\n" : "osg::Group {\n";
        text += "UniqueID " + std::to_string(i) + " \nChildren 1 {\n";
    }
    text += "osg::Group {\nUniqueID " + std::to_string(depth + 1) + " \n}\n";
    for (int i = 0; i < depth; ++i) text += "}\n}\n";
    return text;
}

// As wide and as deep as no database is, and many tiles in one place; `timeout` ends what does not end by itself.
TEST(SmallRun, HugeFilesEnd) {
#ifdef __SANITIZE_ADDRESS__
    constexpr int kWide = 20000, kDeep = 500, kStacked = 500;
#else
    constexpr int kWide = 50000, kDeep = 10000, kStacked = 5000;
#endif
    const TemporaryFolder folder;
    const osg::ref_ptr<osg::Group> wide = new osg::Group;
    for (int i = 0; i < kWide; ++i) wide->addChild(new osg::Group);
    wide->addChild(makeSmallTile(""));
    writeSmallFile(folder / "wide.osgb", *wide, true);
    writeBytes(folder / "deep.osgt", nestedGroups(kDeep));
    const osg::ref_ptr<osg::Group> stacked = new osg::Group;
    const osg::ref_ptr<osg::Node> tile = makeSmallTile("a.osgb");
    for (int i = 0; i < kStacked; ++i) stacked->addChild(tile);
    writeSmallFile(folder / "stacked.osgb", *stacked, true);
    writeSmallFile(folder / "a.osgb", *makeSmallTile(""));
    for (const char* name : {"wide.osgb", "deep.osgt", "stacked.osgb"}) {
        for (const std::string& output : {std::string(), ' ' + test::quoted(folder / "copy.osgb") + " --overwrite"}) {
            const std::string mode = output.empty() ? "--quiet --index " : "--quiet ";
            const Outcome outcome = runBinconv(mode + test::quoted(folder / name) + output, "timeout 120 ");
            EXPECT_NE(outcome.code, 124) << name << " takes too long";
            EXPECT_LT(outcome.code, 2) << name << ' ' << outcome.text;
        }
    }
}

// Each file pages the next one; the last is the widest, and so are all bins above it.
TEST(SmallRun, FilesMayBePagedDeep) {
#ifdef __SANITIZE_ADDRESS__
    constexpr int kDeep = 500;
#else
    constexpr int kDeep = 2000;
#endif
    const TemporaryFolder folder;
    const auto name = [](int i) { return std::to_string(100000 + i) + ".osgb"; };  // all of one length
    writeSmallFile(folder / "earth.osgb", *makeSmallTile(name(1)), true);
    writeSmallFile(folder / name(1), *makeSmallTile(name(2)));
    const std::string tile = bytesOf(folder / name(1));
    const std::size_t at = tile.find(name(2));
    ASSERT_NE(at, std::string::npos);
    for (int i = 2; i < kDeep; ++i) {
        writeBytes(folder / name(i), std::string(tile).replace(at, name(i).size(), name(i + 1)));
    }
    writeSmallFile(folder / name(kDeep), *makeSmallTile("", 10.0));
    const Outcome outcome = runIndex(folder / "earth.osgb", "timeout 120 ");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    const osg::ref_ptr<BinIndex> index = indexOf(folder / "earth.osgb");
    EXPECT_EQ(index->tileCount(), static_cast<std::size_t>(kDeep) + 1);
    for (const std::string& file : {std::string(), name(1), name(kDeep / 2)}) {
        ASSERT_TRUE(index->find(file, 0)) << file;
        EXPECT_GT(index->find(file, 0)->bin.bin().longitude().upper, osg::DegreesToRadians(10.9)) << file;
    }
    fs::create_directories(folder / "copy");
    const Outcome copy =
        runBinconv("--quiet " + test::quoted(folder / "earth.osgb") + ' ' + test::quoted(folder / "copy/earth.osgb"),
                   "timeout 120 ");
    EXPECT_EQ(copy.code, 0) << copy.text;
    EXPECT_TRUE(fs::exists(folder / ("copy/" + name(kDeep))));
}

TEST(SmallRun, FoldersBesideEachOtherAreFollowed) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("earth_root_L0_X0_Y0/a.osgb"), true);
    writeSmallFile(folder / "earth_root_L0_X0_Y0/a.osgb", *makeSmallTile("../earth_subtile_L2_X0_Y0/b.osgb"));
    writeSmallFile(folder / "earth_subtile_L2_X0_Y0/b.osgb", *makeSmallTile(""));
    EXPECT_EQ(runIndex(folder / "earth.osgb").text, "");
    const osg::ref_ptr<BinIndex> index = indexOf(folder / "earth.osgb");
    for (const char* file : {"", "earth_root_L0_X0_Y0/a.osgb", "earth_subtile_L2_X0_Y0/b.osgb"}) {
        ASSERT_TRUE(index->find(file, 0)) << file;
        EXPECT_TRUE(index->find(file, 0)->bin.valid());
    }
}

TEST(SmallRun, EveryFormatIsRead) {
    for (const std::string extension : {"ive", "osgb", "osgt", "osgx"}) {
        const TemporaryFolder folder;
        const std::string root = folder / ("earth." + extension);
        writeSmallFile(root, *makeSmallTile("tiles/a." + extension), true);
        writeSmallFile(folder / ("tiles/a." + extension), *makeSmallTile(""));
        EXPECT_EQ(runIndex(root).text, "") << extension;
        const osg::ref_ptr<BinIndex> index = indexOf(root);
        EXPECT_TRUE(index->find("tiles/a." + extension, 0)) << extension;
        EXPECT_LT(index->find("", 0)->bin.bin().altitude().width(), 200.0) << extension;
    }
}

TEST(SmallRun, APathToAnotherFolderInAFileIsRefused) {
    const TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> tile = makeSmallTile("a.osgb");
    dynamic_cast<osg::PagedLOD&>(*tile).setDatabasePath(folder / "elsewhere/");
    writeSmallFile(folder / "db/earth.osgb", *tile, true);
    writeSmallFile(folder / "db/a.osgb", *makeSmallTile(""));
    EXPECT_EQ(runIndex(folder / "db/earth.osgb").text, "");  // nothing is there
    writeSmallFile(folder / "elsewhere/a.osgb", *makeSmallTile(""));
    expectFailure(runIndex(folder / "db/earth.osgb"), "elsewhere");
}

TEST(SmallRun, CyclesAreRefused) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a/a.osgb"), true);
    writeSmallFile(folder / "a/a.osgb", *makeSmallTile("b.osgb"));
    writeSmallFile(folder / "a/b.osgb", *makeSmallTile("../a/a.osgb"));
    expectFailure(runIndex(folder / "earth.osgb"), "paged below itself");
    writeSmallFile(folder / "a/b.osgb", *makeSmallTile("../earth.osgb"));
    expectFailure(runIndex(folder / "earth.osgb"), "paged below itself");
    EXPECT_FALSE(fs::exists(folder / "earth.osgb.bins"));
}

TEST(SmallRun, AMissingFileLeavesItsParentWithAllThatTerrainMayBe) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a.osgb"), true);
    for (const bool isBroken : {false, true}) {
        if (isBroken) writeBytes(folder / "a.osgb", "no scene at all");
        const Outcome outcome = runIndex(folder / "earth.osgb");
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.linesWith("warning"), 1) << outcome.text;
        EXPECT_NE(outcome.text.find("a.osgb"), std::string::npos) << outcome.text;
        const osg::ref_ptr<BinIndex> index = indexOf(folder / "earth.osgb");
        EXPECT_TRUE(index->find("", 0)->bin.bin().altitude().contains({-11500.0, 9000.0}));
        EXPECT_FALSE(index->find("a.osgb", 0));
    }
}

TEST(SmallRun, AnUnknownSurfaceLeavesAllTilesAboveItVisible) {
    const TemporaryFolder folder;
    const osg::ref_ptr<osg::Node> odd = makeSmallTile("");
    odd->setDataVariance(osg::Object::DYNAMIC);
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a.osgb"), true);
    writeSmallFile(folder / "a.osgb", *makeSmallTile("b.osgb"));
    writeSmallFile(folder / "b.osgb", *odd);
    const Outcome outcome = runIndex(folder / "earth.osgb");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.linesWith("warning"), 1) << outcome.text;
    const osg::ref_ptr<BinIndex> index = indexOf(folder / "earth.osgb");
    EXPECT_FALSE(index->find("", 0)->bin.valid());
    EXPECT_FALSE(index->find("a.osgb", 0)->bin.valid());
}

TEST(SmallRun, BadCommandLinesAreOneLine) {
    const TemporaryFolder folder;
    expectUsageError(runBinconv(""), "FILE");
    expectFailure(runBinconv("--index " + test::quoted(folder / "absent.osgb")), "absent.osgb");
    expectFailure(runBinconv("--index " + test::quoted(folder.path())), "is no file");
    expectFailure(runBinconv("--index http://host/earth.osgb"), "on a server");
    expectUsageError(runBinconv("--index --print x"), "--");
    expectUsageError(runBinconv("--index --threads 0 x"), "--threads: Value 0");
    expectUsageError(runBinconv("--cluster maybe x x.osgb"), "--cluster: maybe");
    expectUsageError(runBinconv("x"), "nothing to do");
    expectUsageError(runBinconv("--index a b"), "\"b\"");
    expectUsageError(runBinconv("a b c"), "\"c\"");
    expectUsageError(runBinconv("--frobnicate x"), "--frobnicate");
    writeBytes(folder / "text.osgb", "no scene");
    expectFailure(runIndex(folder / "text.osgb"), "text.osgb");
    writeSmallFile(folder / "cow.osgb", *makeSmallTile(""));
    expectFailure(runIndex(folder / "cow.osgb"), "no tile of a globe or a map");
    EXPECT_FALSE(fs::exists(folder / "cow.osgb.bins"));
    EXPECT_FALSE(fs::exists(folder / "cow.osgb.bins.part"));
}

TEST(SmallRun, ABadOutputNameIsRefusedBeforeTheDatabaseIsRead) {
    const TemporaryFolder folder;
    // reading it comes to another failure
    writeBytes(folder / "text.osgb", "no scene");
    writeBytes(folder / "there.osgb", "somebody's");
    const auto copyTo = [&](const std::string& output) {
        return runBinconv("--quiet " + test::quoted(folder / "text.osgb") + ' ' + test::quoted(folder / output));
    };
    expectUsageError(copyTo("copy.ive"), ".osgb, .osgt or .osgx");
    expectFailure(copyTo("absent/copy.osgb"), "create it first");
    expectFailure(copyTo("there.osgb"), "--overwrite");
    expectFailure(copyTo("text.osgb"), "a file of the database itself");
    fs::create_directory(folder / "folder.osgb");
    expectFailure(copyTo("folder.osgb"), "is a folder");
    expectFailure(copyTo("copy.osgb"), "text.osgb");
    EXPECT_EQ(bytesOf(folder / "there.osgb"), "somebody's");
}

}  // namespace
}  // namespace osgAnalyticBin::test
