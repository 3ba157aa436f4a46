// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

CullOptions parsed(const std::string& text) {
    std::string error;
    const auto options = cullOptionsFromText(text, error);
    EXPECT_TRUE(options) << error;
    return options.value_or(CullOptions());
}

TEST(CullOptions, EmptyTextIsTheDefault) {
    for (const char* text : {"", "method=quadratic expiry=3,occlusion=auto;horizon=declared,edges=on",
                             "skirts=cracks,cluster=replace,index=auto"}) {
        EXPECT_TRUE(parsed(text) == CullOptions()) << text;
    }
    EXPECT_EQ(CullOptions().method, Method::Quadratic);
    EXPECT_EQ(CullOptions().expiry, 3.0);
    EXPECT_EQ(CullOptions().occlusion, OcclusionUse::Auto);
}

TEST(CullOptions, OfAllItemsReadBackAndDifferFromTheDefault) {
    for (const char* item : {"method=exact",
                             "method=sphere",
                             "method=none",
                             "horizon=off",
                             "horizon=-500.25",
                             "inheritviewpoint=on",
                             "edges=off",
                             "expiry=0",
                             "expiry=0.1",
                             "expiry=86400",
                             "skirts=all",
                             "cluster=keep",
                             "heights=-500.5..9000",
                             "heights=-11500..8000",
                             "techniquemargin=0",
                             "techniqueMargin=50",
                             "index=off",
                             "index=on",
                             "occlusion=off",
                             "occlusion=on",
                             "globe=wgs84",
                             "globe=1738100/1736000",
                             "ground=BTGTerrainGroup"}) {
        const CullOptions options = parsed(item);
        EXPECT_FALSE(options == CullOptions()) << item;
        EXPECT_TRUE(parsed(toText(options)) == options) << item;
    }
}

TEST(CullOptions, MeanWhatTheySay) {
    const CullOptions options = parsed("method=none expiry=1.5,method=exact,horizon=-500,heights=-500.5..9000");
    EXPECT_EQ(options.method, Method::Exact) << "later items win";
    EXPECT_EQ(options.expiry, 1.5);
    EXPECT_EQ(options.horizonUse, HorizonUse::Given);
    EXPECT_EQ(options.horizon, -500.0);
    EXPECT_EQ(options.heights, (core::Interval{-500.5, 9000.0}));
    ASSERT_TRUE(parsed("globe=1738100/1736000").globe);
    EXPECT_EQ(parsed("globe=1738100/1736000").globe->equatorialRadius(), 1738100.0);
    EXPECT_EQ(parsed("globe=1738100/1736000").globe->polarRadius(), 1736000.0);
    EXPECT_NE(toText(parsed("globe=WGS84")).find("globe=wgs84"), std::string::npos);
    CullOptions unreadable;
    unreadable.ground = "two words";
    EXPECT_EQ(toText(unreadable), toText(CullOptions()));
}

TEST(CullOptions, WhatIsWrongIsNamedInOneLine) {
    const std::pair<const char*, const char*> cases[] = {{"method=cube", "cube"},
                                                         {"method", "bad method"},
                                                         {"expiry=big", "expiry"},
                                                         {"expiry=-1", "expiry"},
                                                         {"expiry=nan", "expiry"},
                                                         {"expiry=86401", "expiry"},
                                                         {"expiry", "expiry"},
                                                         {"colour=red", "colour"},
                                                         {"expiry=1.1x", "1.1x"},
                                                         {"Meth=exact", "meth"},
                                                         {"horizon=low", "low"},
                                                         {"horizon=1e9", "1e9"},
                                                         {"edges=maybe", "maybe"},
                                                         {"skirts=none", "none"},
                                                         {"cluster=off", "off"},
                                                         {"heights=9", "9"},
                                                         {"heights=3..1", "3..1"},
                                                         {"heights=a..b", "a..b"},
                                                         {"index=x", "x"},
                                                         {"techniquemargin=-1", "-1"},
                                                         {"techniquemargin=inf", "inf"},
                                                         {"globe=mars", "mars"},
                                                         {"globe=0/1", "0/1"},
                                                         {"globe=6e6", "6e6"},
                                                         {"ground=", "ground"},
                                                         {"occlusion=maybe", "use occlusion=on|off|auto"},
                                                         {"occlusion", "use occlusion=on|off|auto"}};
    for (const auto& [text, named] : cases) {
        std::string error;
        EXPECT_FALSE(cullOptionsFromText(text, error)) << text;
        EXPECT_NE(error.find(named), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

// The altitudes that stand for terrain of which nothing is known have to hold the earth's own. Source of the heights:
// those that are published, above mean sea level.
constexpr double kEverest = 8848.86;            // survey of Nepal and China, 2020
constexpr double kChallengerDeep = -11034.0;    // the deepest sounding that was ever claimed, Vityaz 1957
constexpr double kHighestMeanSeaLevel = 86.0;   // above the ellipsoid, EGM2008, near New Guinea
constexpr double kLowestMeanSeaLevel = -107.0;  // the same, south of India

TEST(HeightsOnEarth, HoldTheHighestMountainAndTheDeepestSea) {
    constexpr core::Interval kHeld = CullOptions::kTerrainOnEarth;
    EXPECT_GE(kHeld.upper, kEverest + kHighestMeanSeaLevel);
    EXPECT_LE(kHeld.lower, kChallengerDeep + kLowestMeanSeaLevel);
    // and not so much more that bins and horizons lose by it
    EXPECT_LE(kHeld.upper, kEverest + 500.0);
    EXPECT_GE(kHeld.lower, kChallengerDeep - 1000.0);
    EXPECT_EQ(CullOptions().heights, kHeld);
}

}  // namespace
}  // namespace osgAnalyticBin::test
