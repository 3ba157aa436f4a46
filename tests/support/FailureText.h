// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

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

}  // namespace osgAnalyticBin::test
