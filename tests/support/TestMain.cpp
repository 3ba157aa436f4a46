// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The main function of all GoogleTest programs.

#include <gtest/gtest.h>

#include <cstdio>
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

// Where indexes are kept that programs and the kit make by themselves.
void setCacheFolder(const std::string& folder) {
#if defined(_WIN32)
    ::_putenv_s("LOCALAPPDATA", folder.c_str());
#else
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    ::testing::InitGoogleTest(&argc, argv);
    const osgAnalyticBin::test::TemporaryFolder cache;
    setCacheFolder(cache.path());
    ::testing::UnitTest::GetInstance()->listeners().Append(new Listener);  // which takes ownership
    return RUN_ALL_TESTS();
}
