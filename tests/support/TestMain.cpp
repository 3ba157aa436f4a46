// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The main function of all GoogleTest programs.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <support/Random.h>
#include <support/TemporaryFolder.h>

namespace {

class Listener final : public ::testing::EmptyTestEventListener {
    void OnTestEnd(const ::testing::TestInfo& info) override {
        const ::testing::TestResult& result = *info.result();
#ifdef OSGANALYTICBIN_REQUIRE_ALL
        if (result.Skipped()) ADD_FAILURE() << "a test was left out, and OSGANALYTICBIN_REQUIRE_ALL is ON";
#endif
        if (result.Passed() || result.Skipped()) return;
        std::printf("to repeat: %s=%llu\n", osgAnalyticBin::test::kSeedVariable,
                    static_cast<unsigned long long>(osgAnalyticBin::test::seed()));
    }
};

}  // namespace

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    // where indexes are kept that programs and the kit make by themselves
    const osgAnalyticBin::test::TemporaryFolder cache;
    ::setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
    ::testing::UnitTest::GetInstance()->listeners().Append(new Listener);  // which takes ownership
    return RUN_ALL_TESTS();
}
