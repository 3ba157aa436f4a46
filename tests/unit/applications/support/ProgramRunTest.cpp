// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "Interruption.h"
#include "ProgramRun.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include <new>
#include <string>

namespace osgAnalyticBin::support {
namespace {

template <class Error>
ExitCode codeOf(const Error& error) {
    testing::internal::CaptureStderr();
    const ExitCode code = runProgram("tool", [&]() -> ExitCode { throw error; });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), std::string("tool: ") + error.what() + '\n');
    return code;
}

TEST(ProgramRun, EveryKindOfErrorHasItsCode) {
    EXPECT_EQ(codeOf(Failure("broken")), 1);
    EXPECT_EQ(codeOf(std::bad_alloc()), 1);
    EXPECT_EQ(codeOf(UsageError("--nonsense")), 2);
    EXPECT_EQ(codeOf(Interrupted()), 130);
    EXPECT_EQ(runProgram("tool", [] { return kFailed; }), 1);
    EXPECT_EQ(runProgram("tool", [] { return kSucceeded; }), 0);
}

bool isParsed(const char* word) {
    CLI::App app("Does nothing.", "tool");
    app.set_version_flag("--version", "1");
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

}  // namespace
}  // namespace osgAnalyticBin::support
