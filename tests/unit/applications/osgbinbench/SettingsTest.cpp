// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the command line comes to; what it refuses is in ErrorTest.cpp.

#include "Settings.h"

#include <gtest/gtest.h>

#include <vector>

namespace osgAnalyticBin::bench {
namespace {

Settings settingsFrom(std::vector<std::string> words) {
    words.insert(words.begin(), {"osgbinbench", "earth.osgb", "--path", "p.csv"});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    Settings settings;
    EXPECT_TRUE(settingsFromCommandLine(static_cast<int>(arguments.size()), arguments.data(), settings));
    return settings;
}

TEST(Settings, MethodsWithoutBinsKeepTilesAsLongAsBinsUnlessToldOtherwise) {
    EXPECT_EQ(settingsFrom({}).expiry, CullOptions::kDefaultExpiry);
    EXPECT_EQ(settingsFrom({"--options", "expiry=7"}).expiry, 7.0);
    EXPECT_EQ(settingsFrom({"--expiry", "osg"}).expiry, 0.0);
    EXPECT_EQ(settingsFrom({"--expiry", "5", "--options", "expiry=7"}).expiry, 5.0);
}

TEST(Settings, FlushesMoreThanTheCachesHoldUnlessToldOtherwise) {
    EXPECT_EQ(settingsFrom({}).flush, CacheFlusher::defaultMebibytes());
    EXPECT_EQ(settingsFrom({"--flush", "0"}).flush, 0);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
