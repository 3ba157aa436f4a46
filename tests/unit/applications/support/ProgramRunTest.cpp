// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "Failure.h"
#include "ProgramRun.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace osgAnalyticBin::support
