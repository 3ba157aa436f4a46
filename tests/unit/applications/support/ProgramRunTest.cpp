// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "Failure.h"
#include "Interruption.h"
#include "ProgramRun.h"

#include <gtest/gtest.h>

#include <new>
#include <string>
#include <vector>

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
    CommandLine line("tool", "Does nothing.", "");
    const char* const words[] = {"tool", word};
    testing::internal::CaptureStdout();
    try {
        const bool isThereMore = line.parse(word ? 2 : 1, words);
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

TEST(CommandLine, TakesValuesInTheirRanges) {
    bool isGiven = false;
    std::string text = "unchanged", word;
    int whole = 3;
    double number = 0.5;
    std::vector<std::string> list, all;
    const auto parse = [&](std::vector<const char*> words) {
        CommandLine line("tool", "Does nothing.", "");
        line.add("--flag", isGiven, "");
        line.add("--text", text, "");
        line.add("WORD", word, "");
        line.add("--whole", whole, 1, 9, "");
        line.add("--number", number, 0.0, 1.0, "");
        line.addList("--list", list, "");
        line.addAll("--all", all, "");
        words.insert(words.begin(), "tool");
        return line.parse(static_cast<int>(words.size()), words.data());
    };
    EXPECT_TRUE(parse({"--list", "a,b", "here", "--all", "x", "--all", "y", "--whole", "9", "--flag"}));
    EXPECT_EQ(list, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(all, (std::vector<std::string>{"x", "y"}));
    EXPECT_EQ(word, "here");
    EXPECT_EQ(text, "unchanged");
    EXPECT_TRUE(isGiven && whole == 9 && number == 0.5);
    for (const char* const bad : {"--whole=0", "--whole=10", "--whole=x", "--number=nan", "--number=1.1", "--other"})
        EXPECT_THROW((void)parse({bad}), UsageError) << bad;
}

}  // namespace
}  // namespace osgAnalyticBin::support
