// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the command line comes to; what it refuses is in ErrorTest.cpp.

#include "Settings.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::bench {
namespace {

Settings settingsOf(std::vector<std::string> words) {
    words.insert(words.begin(), {"osgbinbench", "earth.osgb"});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    Settings settings;
    EXPECT_TRUE(settingsFromCommandLine(static_cast<int>(arguments.size()), arguments.data(), settings));
    return settings;
}

Settings settingsFrom(std::vector<std::string> words) {
    words.insert(words.begin(), {"--path", "p.csv"});
    return settingsOf(std::move(words));
}

TEST(Settings, ComparesTheDefaultOptionsWithStockOsg) {
    EXPECT_EQ(settingsFrom({}).methods, (std::vector<std::string>{"sphere", "cluster", "bins"}));
}

TEST(Settings, APageIsWrittenOnRequestAndForThePathAroundTheDatabase) {
    EXPECT_EQ(settingsFrom({}).report, "");
    EXPECT_EQ(settingsFrom({"--report", "page.html"}).report, "page.html");
    EXPECT_EQ(settingsOf({}).report, "report.html");
    EXPECT_EQ(settingsOf({"--report", "page.html"}).report, "page.html");
    EXPECT_EQ(settingsOf({"--frames", "10"}).report, "") << "no poses to show";
}

TEST(Settings, MethodsWithoutBinsKeepTilesAsLongAsBinsUnlessToldOtherwise) {
    EXPECT_EQ(settingsFrom({}).expiry, CullOptions::kDefaultExpiry);
    EXPECT_EQ(settingsFrom({"--options", "expiry=7"}).expiry, 7.0);
    EXPECT_EQ(settingsFrom({"--expiry", "osg"}).expiry, 0.0);
    EXPECT_EQ(settingsFrom({"--expiry", "5", "--options", "expiry=7"}).expiry, 5.0);
}

TEST(Settings, FlushesMoreThanTheCachesHoldUnlessToldOtherwise) {
    EXPECT_EQ(settingsFrom({}).flush, defaultFlush());
    EXPECT_EQ(settingsFrom({"--flush", "0"}).flush, 0);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
