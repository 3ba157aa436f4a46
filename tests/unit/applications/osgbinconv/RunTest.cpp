// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbinconv writes the same bytes with any number of threads, and after it was killed and started again.

#include "BinconvRuns.h"
#include "SmallDatabase.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <support/Random.h>
#include <support/StockPrograms.h>
#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

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
    expectFailure(runIndex(_database), "cannot write");
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

TEST_F(Run, FilesThatHaveChangedSinceAreReadAgain) {
    const std::string whole = indexed();
    fs::create_directories(indexFile() + ".tmp/in the way");
    (void)runIndex(_database);
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

TEST_F(Run, ProgressOfEveryPassEndsAtTheWhole) {
    // The share of a file is that of the files below it: the sum is whole only when each was counted once.
    const Outcome indexing = runBinconv("--index " + test::quoted(_database));
    expectOneLine(indexing, "osgbinconv: read 161 files, 672 tiles, ");
    EXPECT_EQ(indexing.linesWith(" tiles/s, 100 %, done in "), 1) << indexing.text;
    const Outcome copying =
        runBinconv(test::quoted(_database) + ' ' + test::quoted(_folder.makeFolder("copy") + "/globe.osgb"));
    EXPECT_EQ(copying.linesWith("osgbinconv: copied 161 files, 672 tiles, "), 1) << copying.text;
    EXPECT_EQ(copying.linesWith(" tiles/s, 100 %, done in "), 2) << copying.text;
}

constexpr int kMostAttempts = 20;

TEST_F(Run, InterruptedRunsSayHowToGoOnAndDo) {
    const std::string whole = indexed();
    fs::remove(indexFile());
    Outcome outcome = indexEndedBy("INT");
    // it may have been too fast to interrupt
    for (int i = 0; i < kMostAttempts && outcome.code == 0; ++i) {
        fs::remove(indexFile());
        outcome = indexEndedBy("INT");
    }
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
    Outcome outcome = endedBy("INT", arguments, folder + "/tiles_1_3_3.osgb");
    for (int i = 0; i < kMostAttempts && outcome.code == 0; ++i) {
        fs::remove_all(folder);
        fs::create_directories(folder);
        outcome = endedBy("INT", arguments, folder + "/tiles_1_3_3.osgb");
    }
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
    expectFailure(runBinconv("--quiet --check " + test::quoted(_database)), "has no index; make one with");
}

TEST_F(Run, PrintTellsWhatIsInAnIndex) {
    (void)indexed();
    const Outcome printed = runBinconv("--print " + test::quoted(indexFile()));
    EXPECT_EQ(printed.code, 0);
    for (const char* part : {"globe.osgb", "672 in 161 files", "without bounds 0", "m in the finest tiles", "degrees",
                             "some 3 levels", "per tile"}) {
        EXPECT_NE(printed.text.find(part), std::string::npos) << printed.text;
    }
    EXPECT_EQ(runBinconv("--print " + test::quoted(_database)).text, printed.text);
    fs::remove(indexFile());
    expectFailure(runBinconv("--print " + test::quoted(_database)), "has no index; make one with");
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
    expectFailure(runIndex(_database), "move it away");
    EXPECT_EQ(bytesOf(indexFile()), "my own notes");
}

}  // namespace
}  // namespace osgAnalyticBin::test
