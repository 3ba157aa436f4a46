// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "Failure.h"
#include "ProgressLine.h"

#include <gtest/gtest.h>

#include <memory>
#include <new>
#include <string>

namespace osgAnalyticBin::support {
namespace {

template <class Error>
ExitCode codeOf(const Error& error, const char* said = nullptr) {
    testing::internal::CaptureStderr();
    const ExitCode code = runProgram("tool", [&]() -> ExitCode { throw error; });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), std::string("tool: ") + (said ? said : error.what()) + '\n');
    return code;
}

TEST(ProgramRun, EveryKindOfErrorHasItsCode) {
    EXPECT_EQ(codeOf(Failure("broken")), 1);
    EXPECT_EQ(codeOf(std::bad_alloc(), "out of memory; use fewer --threads, or close other programs"), 1);
    EXPECT_EQ(codeOf(UsageError("--nonsense")), 2);
    EXPECT_EQ(codeOf(Interrupted()), 130);
    EXPECT_EQ(runProgram("tool", [] { return kFailed; }), 1);
    EXPECT_EQ(runProgram("tool", [] { return kSucceeded; }), 0);
}

bool isParsed(const char* word) {
    CLI::App app{"Does nothing.", "tool"};
    const char* const words[] = {"tool", word};
    testing::internal::CaptureStdout();
    try {
        const bool isThereMore = parseCommandLine(app, word ? 2 : 1, words);
        EXPECT_EQ(testing::internal::GetCapturedStdout().empty(), isThereMore);
        return isThereMore;
    } catch (...) {
        EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
        throw;
    }
}

TEST(ProgramRun, HelpAndVersionLeaveNothingToDo) {
    EXPECT_TRUE(isParsed(nullptr));
    EXPECT_FALSE(isParsed("--help"));
    EXPECT_FALSE(isParsed("--version"));
    EXPECT_THROW((void)isParsed("--nonsense"), UsageError);
}

TEST(CommandLine, TakesNumbersInTheirRanges) {
    double number = 0.5;
    const auto parse = [&](const char* word) {
        CLI::App app{"Does nothing.", "tool"};
        app.add_option("--number", number)->check(within(0.0, 1.0));
        const char* const words[] = {"tool", word};
        return parseCommandLine(app, 2, words);
    };
    EXPECT_TRUE(parse("--number=0.25"));
    EXPECT_EQ(number, 0.25);
    for (const char* const bad : {"--number=nan", "--number=1.1", "--number=x", "--other"})
        EXPECT_THROW((void)parse(bad), UsageError) << bad;
}

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using Stream = std::unique_ptr<std::FILE, Close>;

TEST(ProgressLine, SaysWhatIsLeft) {
    EXPECT_EQ(timeLeft(0.5, 1.0), "");  // nobody knows yet
    EXPECT_EQ(timeLeft(0.5, 40.0), "40 s left");
    EXPECT_EQ(timeLeft(0.25, 240.0), "12 min left");
    EXPECT_EQ(timeLeft(0.1, 1234.0), "3 h 06 min left");
    EXPECT_EQ(timeLeft(1.0, 50.0), "");
}

TEST(ProgressLine, WhatWasDoneBeforeTookNoTime) {
    EXPECT_EQ(timeLeft(0.5, 40.0, 0.25), "80 s left");
    EXPECT_EQ(timeLeft(0.5, 40.0, 0.5), "");
    EXPECT_EQ(timeLeft(1.0, 40.0, 1.0), "");
}

TEST(ProgressLine, IsALineOfItsOwnInAFile) {
    const Stream file(std::tmpfile());
    ASSERT_TRUE(file);
    ProgressLine line(file.get());
    EXPECT_FALSE(line.isTerminal());
    EXPECT_FALSE(line.isDue());
    line.show(0.25, "tool: 3 files, ");
    line.show(1.1, "");
    line.finish(1.0, "tool: 12 files, ");
    std::rewind(file.get());
    char text[256]{};
    (void)std::fread(text, 1, sizeof text - 1, file.get());
    EXPECT_STREQ(text, "tool: 3 files, 25 %\n99 %\ntool: 12 files, 100 %, done in 1 s\n");
}

}  // namespace
}  // namespace osgAnalyticBin::support
