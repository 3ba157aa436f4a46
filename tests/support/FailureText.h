// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <support/StockPrograms.h>

namespace osgAnalyticBin::test {

/// What the failure says that `call` ends with: one line. "no failure" where it ends with none.
template <typename Call>
std::string failureOf(const Call& call) {
    try {
        call();
    } catch (const std::runtime_error& failure) {
        EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos) << failure.what();
        return failure.what();
    }
    return "no failure";
}

/// The program has ended with this code and has said one line: its name, and `what` somewhere in it.
inline void expectOneLine(const Outcome& outcome, const std::string& program, const std::string& what, int code = 1) {
    EXPECT_EQ(outcome.code, code) << outcome.text;
    EXPECT_EQ(outcome.text.rfind(program + ": ", 0), 0U) << outcome.text;
    EXPECT_NE(outcome.text.find(what), std::string::npos) << what << " is not in " << outcome.text;
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << outcome.text;
}

}  // namespace osgAnalyticBin::test
