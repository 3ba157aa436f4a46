// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbinconv reads unusual databases, and answers what it cannot do with one clear line.

#include "Binconv.h"

namespace osgAnalyticBin::test {
namespace {

class HardInput : public ::testing::Test {
protected:
    // A run that succeeds, and warns once.
    [[nodiscard]] Outcome indexWithWarning(const std::string& what) const {
        Outcome outcome = runIndex(root);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.linesWith("warning"), 1) << outcome.text;
        EXPECT_EQ(outcome.linesWith(what), 1) << outcome.text;
        return outcome;
    }

    const TemporaryFolder folder;
    const std::string root = folder / "db/earth.osgb";
};

TEST_F(HardInput, NamesThatLeaveTheFolderAreRefused) {
    writeFile(folder / "outside.osgb", *makeSmallTile(""));
    for (const char* name :
         {"../outside.osgb", "a/../../outside.osgb", "..\\outside.osgb", "..", "/etc/outside.osgb",
          "//etc/outside.osgb", "http://host/outside.osgb", "file:///etc/outside.osgb", "C:/outside.osgb"}) {
        writeRoot(root, *makeSmallTile(name));
        expectFailure(runIndex(root), "outside of the database's folder");
        expectNoIndex(root);
    }
}

// Pseudo-loaders would open other files, or change what is read.
TEST_F(HardInput, NamesWithPseudoLoadersAreNoFiles) {
    writeRoot(root, *makeSmallTile("a.osgb.90,0,0.rot"));
    writeFile(folder / "db/a.osgb", *makeSmallTile(""));
    (void)indexWithWarning("missing or broken");
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

#ifdef __SANITIZE_ADDRESS__
constexpr int kWide = 20000, kDeep = 500, kStacked = 500, kPagedDeep = 500;
#else
constexpr int kWide = 50000, kDeep = 10000, kStacked = 5000, kPagedDeep = 2000;
#endif

// As wide and as deep as no database is, and many tiles in one place.
TEST_F(HardInput, HugeFilesEnd) {
    const osg::ref_ptr<osg::Group> wide = new osg::Group;
    for (int i = 0; i < kWide; ++i) wide->addChild(new osg::Group);
    wide->addChild(makeSmallTile(""));
    writeRoot(folder / "wide.osgb", *wide);
    (void)folder.write("deep.osgt", nestedGroups(kDeep));
    const osg::ref_ptr<osg::Group> stacked = new osg::Group;
    const osg::ref_ptr<osg::Node> tile = makeSmallTile("a.osgb");
    for (int i = 0; i < kStacked; ++i) stacked->addChild(tile);
    writeRoot(folder / "stacked.osgb", *stacked);
    writeFile(folder / "a.osgb", *makeSmallTile(""));
    for (const char* name : {"wide.osgb", "deep.osgt", "stacked.osgb"}) {
        const Outcome outcome = runIndex(folder / name);
        EXPECT_LT(outcome.code, 2) << name << ' ' << outcome.text;
    }
}

// Each file pages the next one; the last is the widest, and so are all bins above it.
TEST_F(HardInput, FilesMayBePagedDeep) {
    const auto name = [](int i) { return std::to_string(100000 + i) + ".osgb"; };  // all of one length
    writeRoot(root, *makeSmallTile(name(1)));
    writeFile(folder / "db" + ("/" + name(1)), *makeSmallTile(name(2)));
    const std::string tile = textOfFile(folder / ("db/" + name(1)));
    const std::size_t at = tile.find(name(2));
    ASSERT_NE(at, std::string::npos);
    for (int i = 2; i < kPagedDeep; ++i)
        (void)folder.write("db/" + name(i), std::string(tile).replace(at, name(i).size(), name(i + 1)));
    writeFile(folder / ("db/" + name(kPagedDeep)), *makeSmallTile("", 10.0));
    expectSuccess(runIndex(root));
    const osg::ref_ptr<BinIndex> index = indexOf(root);
    EXPECT_EQ(index->tileCount(), static_cast<std::size_t>(kPagedDeep) + 1);
    for (const std::string& file : {std::string(), name(1), name(kPagedDeep / 2)}) {
        ASSERT_TRUE(index->find(file, 0)) << file;
        EXPECT_GT(index->find(file, 0)->bin.bin().longitude().upper, osg::DegreesToRadians(10.9)) << file;
    }
}

TEST_F(HardInput, FoldersBesideEachOtherAreFollowed) {
    writeRoot(root, *makeSmallTile("earth_root_L0_X0_Y0/a.osgb"));
    writeFile(folder / "db/earth_root_L0_X0_Y0/a.osgb", *makeSmallTile("../earth_subtile_L2_X0_Y0/b.osgb"));
    writeFile(folder / "db/earth_subtile_L2_X0_Y0/b.osgb", *makeSmallTile(""));
    expectSuccess(runIndex(root));
    const osg::ref_ptr<BinIndex> index = indexOf(root);
    for (const char* file : {"", "earth_root_L0_X0_Y0/a.osgb", "earth_subtile_L2_X0_Y0/b.osgb"}) {
        ASSERT_TRUE(index->find(file, 0)) << file;
        EXPECT_TRUE(index->find(file, 0)->bin.valid());
    }
}

TEST_F(HardInput, EveryFormatIsRead) {
    for (const std::string extension : {"ive", "osgb", "osgt", "osgx"}) {
        const std::string earth = folder / ("earth." + extension);
        writeRoot(earth, *makeSmallTile("tiles/a." + extension));
        writeFile(folder / ("tiles/a." + extension), *makeSmallTile(""));
        expectSuccess(runIndex(earth));
        const osg::ref_ptr<BinIndex> index = indexOf(earth);
        EXPECT_TRUE(index->find("tiles/a." + extension, 0)) << extension;
        EXPECT_LT(index->find("", 0)->bin.bin().altitude().width(), 200.0) << extension;
    }
}

TEST_F(HardInput, APathToAnotherFolderInAFileIsRefused) {
    const osg::ref_ptr<osg::Node> tile = makeSmallTile("a.osgb");
    dynamic_cast<osg::PagedLOD&>(*tile).setDatabasePath(folder / "elsewhere/");
    writeRoot(root, *tile);
    writeFile(folder / "db/a.osgb", *makeSmallTile(""));
    expectSuccess(runIndex(root));  // nothing is there
    writeFile(folder / "elsewhere/a.osgb", *makeSmallTile(""));
    expectFailure(runIndex(root), "elsewhere");
}

TEST_F(HardInput, CyclesAreRefused) {
    writeRoot(root, *makeSmallTile("a/a.osgb"));
    writeFile(folder / "db/a/a.osgb", *makeSmallTile("b.osgb"));
    for (const char* above : {"../a/a.osgb", "../earth.osgb"}) {
        writeFile(folder / "db/a/b.osgb", *makeSmallTile(above));
        expectFailure(runIndex(root), "paged below itself");
        expectNoIndex(root);
    }
}

TEST_F(HardInput, AMissingFileLeavesItsParentWithAllThatTerrainMayBe) {
    writeRoot(root, *makeSmallTile("a.osgb"));
    for (const bool isBroken : {false, true}) {
        if (isBroken) (void)folder.write("db/a.osgb", "no scene at all");
        (void)indexWithWarning("a.osgb");
        const osg::ref_ptr<BinIndex> index = indexOf(root);
        EXPECT_TRUE(index->find("", 0)->bin.bin().altitude().contains({-11500.0, 9000.0}));
        EXPECT_FALSE(index->find("a.osgb", 0));
    }
}

TEST_F(HardInput, AnUnknownSurfaceLeavesAllTilesAboveItVisible) {
    const osg::ref_ptr<osg::Node> odd = makeSmallTile("");
    odd->setDataVariance(osg::Object::DYNAMIC);
    writeRoot(root, *makeSmallTile("a.osgb"));
    writeFile(folder / "db/a.osgb", *makeSmallTile("b.osgb"));
    writeFile(folder / "db/b.osgb", *odd);
    (void)indexWithWarning("");
    const osg::ref_ptr<BinIndex> index = indexOf(root);
    EXPECT_FALSE(index->find("", 0)->bin.valid());
    EXPECT_FALSE(index->find("a.osgb", 0)->bin.valid());
}

TEST_F(HardInput, BadCommandLinesAreOneLine) {
    const std::string text = folder.write("text.osgb", "no scene");
    const std::string cow = folder / "cow.osgb";
    writeFile(cow, *makeSmallTile(""));
    const struct {
        std::vector<std::string> words;
        std::string what;
        int code = 2;
    } cases[] = {{{}, "FILE"},
                 {{"--index", "--print", "x"}, "Give one of"},
                 {{"--print", "--keep-records", "x"}, "--keep-records requires --index"},
                 {{"--index", "--threads", "0", "x"}, "--threads: Value 0"},
                 {{"x"}, "Give one of"},
                 {{"--index", "a", "b"}, "not expected: b"},
                 {{"--frobnicate", "x"}, "--frobnicate"},
                 {{"--index", folder / "absent.osgb"}, "absent.osgb", 1},
                 {{"--index", folder.path()}, "is no file", 1},
                 {{"--index", "http://host/earth.osgb"}, "on a server", 1},
                 {{"--quiet", "--index", text}, "text.osgb", 1},
                 {{"--quiet", "--index", cow}, "no tile of a globe or a map", 1}};
    for (const auto& wrong : cases) expectFailure(runBinconv(wrong.words), wrong.what, wrong.code);
    expectNoIndex(cow);
}

}  // namespace
}  // namespace osgAnalyticBin::test
