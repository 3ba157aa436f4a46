// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// osgbinconv writes the same bytes with any number of threads, and after it was killed and started again.

#include "Binconv.h"

#include <chrono>
#include <support/Random.h>

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;

class Run : public ::testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(makeDatabase("synthetic", folder), database); }

    // Indexes the database. Returns: the index.
    [[nodiscard]] std::string indexed(const std::string& option = "--quiet") const {
        expectSuccess(runBinconv({"--quiet", "--index", option, database}));
        EXPECT_FALSE(fs::exists(part));
        return textOfFile(index);
    }
    [[nodiscard]] std::string indexedAnew() const {
        fs::remove(index);
        return indexed();
    }
    // A folder in the way of the last step leaves all records, as a kill just before it does. Returns: these.
    [[nodiscard]] std::string recordsOfAKilledRun() const {
        fs::create_directories(index + ".tmp/in the way");
        expectFailure(runIndex(database), "cannot write");
        fs::remove_all(index + ".tmp");
        return textOfFile(part);
    }
    void changeATile() const { writeFile(folder / "tiles_1_3_3.osgb", *makeSmallTile("")); }

    // Ctrl-C as soon as there are records; a run may be too fast for it, and is tried again.
    [[nodiscard]] Outcome interruptedIndex() const {
        const std::vector<std::string> command{OSGBINCONV_PROGRAM, "--quiet", "--threads", "1", "--index", database};
        Outcome outcome;
        for (int i = 0; i < 20 && outcome.code != 130; ++i) {
            fs::remove(index);
            outcome = runStock(interrupted(quoted(command), "test -s " + quoted(part)), Modules::Present);
        }
        return outcome;
    }

    const TemporaryFolder folder;
    const std::string database = folder / "globe.osgb";
    const std::string index = database + ".bins";
    const std::string part = database + ".bins.part";
};

TEST_F(Run, ThreadsDoNotChangeAByte) {
    const std::string one = indexed("--threads=1");
    ASSERT_FALSE(one.empty());
    EXPECT_EQ(indexed("--threads=2"), one);
    EXPECT_EQ(indexed("--threads=5"), one);
}

TEST_F(Run, GoesOnFromWhatIsWholeOfAKilledRun) {
    const std::string whole = indexed();
    fs::remove(index);
    const std::string records = recordsOfAKilledRun();
    ASSERT_GT(records.size(), 10000u);
    Random random(31);
    for (int i = 0; i < 8; ++i) {
        std::string damaged =
            records.substr(0, static_cast<std::size_t>(random.integer(0, static_cast<int>(records.size()))));
        if (i % 2 == 1 && !damaged.empty()) damaged.back() = static_cast<char>(damaged.back() ^ 4);
        (void)folder.write("globe.osgb.bins.part", damaged);
        EXPECT_EQ(indexed(), whole) << damaged.size();
    }
    // all of it: nothing is read again
    (void)folder.write("globe.osgb.bins.part", records);
    EXPECT_EQ(runBinconv({"--index", database}).linesWith("(161 files from an earlier run)"), 1);
    EXPECT_EQ(textOfFile(index), whole);
    // files that have changed since are
    ASSERT_FALSE(recordsOfAKilledRun().empty());
    changeATile();
    const std::string changed = indexed();
    EXPECT_NE(changed, whole);
    EXPECT_EQ(indexedAnew(), changed);
}

TEST_F(Run, KeptRecordsSpareReadingWhatHasNotChanged) {
    const std::vector<std::string> command{"--index", "--keep-records", database};
    ASSERT_EQ(runBinconv(command).code, 0);
    const std::size_t size = textOfFile(part).size();
    changeATile();
    fs::last_write_time(database, fs::last_write_time(database) + std::chrono::seconds(7));
    EXPECT_EQ(runBinconv(command).linesWith("(159 files from an earlier run)"), 1);
    const std::string changed = textOfFile(index);
    EXPECT_LT(textOfFile(part).size(), size + 1000) << "what is replaced is kept";
    fs::remove(part);
    EXPECT_EQ(indexed(), changed);
}

TEST_F(Run, ProgressEndsAtTheWhole) {
    // The share of a file is that of the files below it: the sum is whole only when each was counted once.
    const Outcome indexing = runBinconv({"--index", database});
    expectOneLine(indexing, "osgbinconv", "osgbinconv: read 161 files, 672 tiles, ", 0);
    EXPECT_EQ(indexing.linesWith(" tiles/s, 100 %, done in "), 1) << indexing.text;
}

TEST_F(Run, InterruptedRunsSayHowToGoOnAndDo) {
    const std::string whole = indexed();
    expectFailure(interruptedIndex(), "goes on where it ended", 130);
    EXPECT_TRUE(fs::exists(part));
    EXPECT_FALSE(fs::exists(index));
    EXPECT_EQ(indexed(), whole);
}

TEST_F(Run, CheckAndPrintTellWhatIsInAnIndex) {
    (void)indexed();
    const auto check = [&] { return runBinconv({"--quiet", "--check", database}); };
    const Outcome same = check();
    EXPECT_EQ(same.code, 0) << same.text;
    EXPECT_EQ(same.linesWith("672 tiles in 161 files"), 1) << same.text;
    const Outcome printed = runBinconv({"--print", index});
    EXPECT_EQ(printed.code, 0);
    for (const char* word : {"globe.osgb", "672 in 161 files", "without bounds 0", "m in the finest tiles", "per tile"})
        EXPECT_NE(printed.text.find(word), std::string::npos) << printed.text;
    EXPECT_EQ(runBinconv({"--print", database}).text, printed.text);
    changeATile();
    expectFailure(check(), "does not agree");
    fs::remove(index);
    expectFailure(check(), "has no index; make one with");
    expectFailure(runBinconv({"--print", database}), "has no index; make one with");
    expectFailure(runBinconv({"--print", folder / "absent.bins"}), "absent.bins");
}

TEST_F(Run, AFullDiskIsNoticedAndTheRerunGoesOn) {
    const std::string whole = indexed();
    fs::remove(index);
    const std::vector<std::string> command{OSGBINCONV_PROGRAM, "--quiet", "--index", database};
    expectFailure(runStock(onFullDisk(quoted(command), 40), Modules::Present), "make room");
    EXPECT_FALSE(fs::exists(index));
    EXPECT_GT(fs::file_size(part), 10000u);
    EXPECT_EQ(indexed(), whole);
}

TEST_F(Run, WhatIsNotOursIsNotReplaced) {
    (void)folder.write("globe.osgb.bins", "my own notes");
    expectFailure(runIndex(database), "move it away");
    EXPECT_EQ(textOfFile(index), "my own notes");
}

}  // namespace
}  // namespace osgAnalyticBin::test
