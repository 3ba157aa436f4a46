// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <cstdio>
#include <support/Random.h>

namespace {

class SeedOnFailure final : public ::testing::EmptyTestEventListener {
    void OnTestEnd(const ::testing::TestInfo& info) override {
        if (info.result()->Passed() || info.result()->Skipped()) return;
        std::printf("to repeat: %s=%llu\n", osgAnalyticBin::test::kSeedVariable,
                    static_cast<unsigned long long>(osgAnalyticBin::test::seed()));
    }
};

// GoogleTest takes ownership.
[[maybe_unused]] const bool kRegistered =
    (::testing::UnitTest::GetInstance()->listeners().Append(new SeedOnFailure), true);

}  // namespace
