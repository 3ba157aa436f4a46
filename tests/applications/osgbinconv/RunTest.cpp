// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Runs of osgbinconv: the same bytes whatever the threads and however often it was killed, and one clear line for
// everything that it cannot do.

#include "SmallDatabase.h"

#include <osgAnalyticBin/BinIndex.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <support/Random.h>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

Outcome runBinconv(const std::string& arguments, const std::string& before = {}) {
    return runStock(before + test::quoted(OSGBINCONV_PROGRAM) + ' ' + arguments, Modules::Present);
}

std::string bytesOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void writeBytes(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

void expectOneLine(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.text.rfind("osgbinconv: ", 0), 0u) << outcome.text;
    EXPECT_NE(outcome.text.find(what), std::string::npos) << outcome.text;
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << outcome.text;
}

void expectFailure(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.code, 1);
    expectOneLine(outcome, what);
}

class Run : public ::testing::Test {
protected:
    void SetUp() override {
        _database = writeSyntheticDatabase(_folder.path());
        ASSERT_FALSE(_database.empty());
    }
    [[nodiscard]] std::string indexFile() const { return _database + ".bins"; }
    [[nodiscard]] std::string partFile() const { return _database + ".bins.part"; }

    std::string indexed(const std::string& options = {}) {
        const Outcome outcome = runBinconv("--quiet --index " + options + ' ' + test::quoted(_database));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        EXPECT_EQ(outcome.text, "");
        EXPECT_FALSE(fs::exists(partFile()));
        return bytesOf(indexFile());
    }

    /// A run of one thread that gets a signal as soon as a file is there and not empty. In the background a shell
    /// without job control has SIGINT ignored; our programs take it all the same.
    Outcome endedBy(const std::string& signal, const std::string& arguments, const std::string& file) {
        const std::string start = test::quoted(OSGBINCONV_PROGRAM) + " --quiet --threads 1 " + arguments + " &\n";
        const std::string wait = "while [ ! -s " + test::quoted(file) + " ] && kill -0 $! 2>/dev/null; do :; done\n";
        const std::string end = "kill -" + signal + " $! 2>/dev/null\nwait $!\n";
        const std::string script = _folder.write("run.sh", start + wait + end);
        return runStock("sh " + test::quoted(script), Modules::Present);
    }
    Outcome indexEndedBy(const std::string& signal) {
        return endedBy(signal, "--index " + test::quoted(_database), partFile());
    }

    TemporaryFolder _folder;
    std::string _database;
};

TEST_F(Run, ThreadsDoNotChangeAByte) {
    const std::string one = indexed("--threads 1");
    ASSERT_FALSE(one.empty());
    EXPECT_EQ(indexed("--threads 2"), one);
    EXPECT_EQ(indexed("--threads 5"), one);
}

TEST_F(Run, GoesOnFromWhatIsWholeOfAKilledRun) {
    const std::string whole = indexed();
    fs::remove(indexFile());
    // A folder in the way of the last step leaves all records, as a kill just before it does.
    fs::create_directories(indexFile() + ".tmp/in the way");
    expectFailure(runBinconv("--quiet --index " + test::quoted(_database)), "cannot write");
    const std::string part = bytesOf(partFile());
    ASSERT_GT(part.size(), 10000u);
    fs::remove_all(indexFile() + ".tmp");
    Random random(31);
    for (int i = 0; i < 8; ++i) {
        std::string damaged =
            part.substr(0, static_cast<std::size_t>(random.integer(0, static_cast<int>(part.size()))));
        if (i % 2 == 1 && !damaged.empty()) damaged.back() = static_cast<char>(damaged.back() ^ 4);
        writeBytes(partFile(), damaged);
        EXPECT_EQ(indexed(), whole) << damaged.size();
    }
    // all of it: nothing is read again
    writeBytes(partFile(), part);
    const Outcome rerun = runBinconv("--index " + test::quoted(_database));
    EXPECT_NE(rerun.text.find("(161 files from an earlier run)"), std::string::npos) << rerun.text;
    EXPECT_EQ(bytesOf(indexFile()), whole);
}

TEST_F(Run, ARunThatIsKilledGoesOnToTheSameBytes) {
    const std::string whole = indexed();
    fs::remove(indexFile());
    int killed = 0;
    for (int i = 0; i < 4; ++i) killed += indexEndedBy("KILL").code == 0 ? 0 : 1;
    EXPECT_GT(killed, 0);
    EXPECT_EQ(indexed(), whole);
}

TEST_F(Run, FilesThatHaveChangedSinceAreReadAgain) {
    const std::string whole = indexed();
    fs::create_directories(indexFile() + ".tmp/in the way");
    (void)runBinconv("--quiet --index " + test::quoted(_database));
    fs::remove_all(indexFile() + ".tmp");
    ASSERT_TRUE(fs::exists(partFile()));
    const std::string tile = _folder / "tiles_1_3_3.osgb";
    const std::string was = bytesOf(tile);
    writeSmallFile(tile, *makeSmallTile(""));
    const std::string part = bytesOf(partFile());
    const std::string changed = indexed();
    EXPECT_NE(changed, whole);
    fs::remove(indexFile());
    EXPECT_EQ(indexed(), changed);
}

TEST_F(Run, KeptRecordsSpareReadingWhatHasNotChanged) {
    const std::string command = "--index --keep-records " + test::quoted(_database);
    ASSERT_EQ(runBinconv(command).code, 0);
    const std::string part = bytesOf(partFile());
    writeSmallFile(_folder / "tiles_1_3_3.osgb", *makeSmallTile(""));
    fs::last_write_time(_database, fs::last_write_time(_database) + std::chrono::seconds(7));
    const Outcome rerun = runBinconv(command);
    EXPECT_NE(rerun.text.find("(159 files from an earlier run)"), std::string::npos) << rerun.text;
    const std::string changed = bytesOf(indexFile());
    EXPECT_LT(bytesOf(partFile()).size(), part.size() + 1000) << "what is replaced is kept";
    fs::remove(partFile());
    EXPECT_EQ(indexed(), changed);
}

TEST_F(Run, InterruptedRunsSayHowToGoOnAndDo) {
    const std::string whole = indexed();
    fs::remove(indexFile());
    const Outcome outcome = indexEndedBy("INT");
    if (outcome.code == 0) GTEST_SKIP() << "too fast to interrupt";
    EXPECT_EQ(outcome.code, 130);
    expectOneLine(outcome, "goes on where it ended");
    EXPECT_TRUE(fs::exists(partFile()));
    EXPECT_FALSE(fs::exists(indexFile()));
    EXPECT_EQ(indexed(), whole);
}

TEST_F(Run, InterruptedCopiesLeaveNothingAndTheSameCommandMakesThem) {
    const std::string folder = _folder / "copy";
    fs::create_directories(folder);
    const std::string arguments = test::quoted(_database) + ' ' + test::quoted(folder + "/globe.osgb");
    const Outcome outcome = endedBy("INT", arguments, folder + "/tiles_1_3_3.osgb");
    if (outcome.code == 0) GTEST_SKIP() << "too fast to interrupt";
    EXPECT_EQ(outcome.code, 130);
    expectOneLine(outcome, "interrupted");
    EXPECT_TRUE(fs::is_empty(folder));
    const Outcome rerun = runBinconv("--quiet " + arguments);
    EXPECT_EQ(rerun.code, 0) << rerun.text;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 161);
}

TEST_F(Run, CheckFindsWhatHasChanged) {
    (void)indexed();
    const Outcome same = runBinconv("--quiet --check " + test::quoted(_database));
    EXPECT_EQ(same.code, 0) << same.text;
    EXPECT_NE(same.text.find("672 tiles in 161 files"), std::string::npos) << same.text;
    writeSmallFile(_folder / "tiles_1_3_3.osgb", *makeSmallTile(""));
    expectFailure(runBinconv("--quiet --check " + test::quoted(_database)), "does not agree");
    fs::remove(indexFile());
    expectFailure(runBinconv("--quiet --check " + test::quoted(_database)), ".bins");
}

TEST_F(Run, PrintTellsWhatIsInAnIndex) {
    (void)indexed();
    const Outcome printed = runBinconv("--print " + test::quoted(indexFile()));
    EXPECT_EQ(printed.code, 0);
    for (const char* part :
         {"globe.osgb", "672 in 161 files", "never culled 0", "degrees", "some 3 levels", "per tile"}) {
        EXPECT_NE(printed.text.find(part), std::string::npos) << printed.text;
    }
    expectFailure(runBinconv("--print " + test::quoted(_database)), "no such thing");
    expectFailure(runBinconv("--print " + test::quoted(_folder / "absent.bins")), "absent.bins");
}

TEST_F(Run, AFullDiskIsNoticedAndTheRerunGoesOn) {
    const std::string whole = indexed();
    fs::remove(indexFile());
    // A limit on the size of files, in units of 512 or 1024 bytes, stands in for the full disk.
    const Outcome outcome = runStock("sh -c \"ulimit -f 40; exec " + test::quoted(OSGBINCONV_PROGRAM) +
                                         " --quiet --index " + test::quoted(_database) + '"',
                                     Modules::Present);
    expectFailure(outcome, "make room");
    EXPECT_FALSE(fs::exists(indexFile()));
    EXPECT_GT(fs::file_size(partFile()), 10000u);
    EXPECT_EQ(indexed(), whole);
}

TEST_F(Run, WhatIsNotOursIsNotReplaced) {
    writeBytes(indexFile(), "my own notes");
    expectFailure(runBinconv("--quiet --index " + test::quoted(_database)), "move it away");
    EXPECT_EQ(bytesOf(indexFile()), "my own notes");
}

TEST(SmallRun, NamesThatLeaveTheFolderAreRefused) {
    for (const char* name :
         {"../outside.osgb", "a/../../outside.osgb", "..\\outside.osgb", "..", "/etc/outside.osgb",
          "//etc/outside.osgb", "http://host/outside.osgb", "file:///etc/outside.osgb", "C:/outside.osgb"}) {
        const TemporaryFolder folder;
        writeSmallFile(folder / "db/earth.osgb", *makeSmallTile(name), true);
        writeSmallFile(folder / "outside.osgb", *makeSmallTile(""));
        expectFailure(runBinconv("--quiet --index " + test::quoted(folder / "db/earth.osgb")),
                      "outside of the database's folder");
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
    const Outcome outcome = runBinconv("--quiet --index " + test::quoted(folder / "earth.osgb"));
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
    constexpr int kWide = 200000, kDeep = 10000, kStacked = 20000;
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
    const Outcome outcome = runBinconv("--quiet --index " + test::quoted(folder / "earth.osgb"), "timeout 120 ");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    std::string error;
    const osg::ref_ptr<BinIndex> index = readBinIndex(folder / "earth.osgb", nullptr, error);
    ASSERT_TRUE(index) << error;
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
    EXPECT_EQ(runBinconv("--quiet --index " + test::quoted(folder / "earth.osgb")).text, "");
    std::string error;
    const osg::ref_ptr<BinIndex> index = readBinIndex(folder / "earth.osgb", nullptr, error);
    ASSERT_TRUE(index) << error;
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
        EXPECT_EQ(runBinconv("--quiet --index " + test::quoted(root)).text, "") << extension;
        std::string error;
        const osg::ref_ptr<BinIndex> index = readBinIndex(root, nullptr, error);
        ASSERT_TRUE(index) << error;
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
    EXPECT_EQ(runBinconv("--quiet --index " + test::quoted(folder / "db/earth.osgb")).text, "");  // nothing is there
    writeSmallFile(folder / "elsewhere/a.osgb", *makeSmallTile(""));
    expectFailure(runBinconv("--quiet --index " + test::quoted(folder / "db/earth.osgb")), "elsewhere");
}

TEST(SmallRun, CyclesAreRefused) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a/a.osgb"), true);
    writeSmallFile(folder / "a/a.osgb", *makeSmallTile("b.osgb"));
    writeSmallFile(folder / "a/b.osgb", *makeSmallTile("../a/a.osgb"));
    expectFailure(runBinconv("--quiet --index " + test::quoted(folder / "earth.osgb")), "paged below itself");
    writeSmallFile(folder / "a/b.osgb", *makeSmallTile("../earth.osgb"));
    expectFailure(runBinconv("--quiet --index " + test::quoted(folder / "earth.osgb")), "paged below itself");
    EXPECT_FALSE(fs::exists(folder / "earth.osgb.bins"));
}

TEST(SmallRun, AMissingFileLeavesItsParentWithAllThatTerrainMayBe) {
    const TemporaryFolder folder;
    writeSmallFile(folder / "earth.osgb", *makeSmallTile("a.osgb"), true);
    for (const bool isBroken : {false, true}) {
        if (isBroken) writeBytes(folder / "a.osgb", "no scene at all");
        const Outcome outcome = runBinconv("--quiet --index " + test::quoted(folder / "earth.osgb"));
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.linesWith("warning"), 1) << outcome.text;
        EXPECT_NE(outcome.text.find("a.osgb"), std::string::npos) << outcome.text;
        std::string error;
        const osg::ref_ptr<BinIndex> index = readBinIndex(folder / "earth.osgb", nullptr, error);
        ASSERT_TRUE(index) << error;
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
    const Outcome outcome = runBinconv("--quiet --index " + test::quoted(folder / "earth.osgb"));
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.linesWith("warning"), 1) << outcome.text;
    std::string error;
    const osg::ref_ptr<BinIndex> index = readBinIndex(folder / "earth.osgb", nullptr, error);
    ASSERT_TRUE(index) << error;
    EXPECT_FALSE(index->find("", 0)->bin.valid());
    EXPECT_FALSE(index->find("a.osgb", 0)->bin.valid());
}

TEST(SmallRun, BadCommandLinesAreOneLine) {
    const TemporaryFolder folder;
    expectFailure(runBinconv(""), "FILE");
    expectFailure(runBinconv("--index " + test::quoted(folder / "absent.osgb")), "absent.osgb");
    expectFailure(runBinconv("--index " + test::quoted(folder.path())), "is no file");
    expectFailure(runBinconv("--index http://host/earth.osgb"), "on a server");
    expectFailure(runBinconv("--index --print x"), "--");
    expectFailure(runBinconv("--index --threads 0 x"), "--threads 0");
    expectFailure(runBinconv("--index a b"), "\"b\"");
    expectFailure(runBinconv("a b c"), "\"c\"");
    expectFailure(runBinconv("--frobnicate x"), "--frobnicate");
    writeBytes(folder / "text.osgb", "no scene");
    expectFailure(runBinconv("--quiet --index " + test::quoted(folder / "text.osgb")), "text.osgb");
    writeSmallFile(folder / "cow.osgb", *makeSmallTile(""));
    expectFailure(runBinconv("--quiet --index " + test::quoted(folder / "cow.osgb")), "no tile of a globe");
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
    expectFailure(copyTo("copy.ive"), ".osgb, .osgt or .osgx");
    expectFailure(copyTo("absent/copy.osgb"), "create it first");
    expectFailure(copyTo("there.osgb"), "--overwrite");
    expectFailure(copyTo("text.osgb"), "a file of the database itself");
    fs::create_directory(folder / "folder.osgb");
    expectFailure(copyTo("folder.osgb"), "is a folder");
    expectFailure(copyTo("copy.osgb"), "text.osgb");
    EXPECT_EQ(bytesOf(folder / "there.osgb"), "somebody's");
}

TEST(SmallRun, HelpNamesUnitsAndExamples) {
    const Outcome outcome = runBinconv("--help");
    EXPECT_EQ(outcome.code, 0);
    for (const char* word : {"--index", "--check", "--print", "metres", "degrees", "Example"}) {
        EXPECT_NE(outcome.text.find(word), std::string::npos) << word;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
