// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/CullOptions.h>

#include <gtest/gtest.h>

namespace osgAnalyticBin {
namespace {

TEST(CullOptions, EmptyTextIsTheDefault) {
    std::string error;
    const auto options = cullOptionsFromText("", error);
    ASSERT_TRUE(options);
    EXPECT_EQ(options->method, Method::Quadratic);
    EXPECT_EQ(options->expiry, 3.0);
}

TEST(CullOptions, ExpiryReadsBack) {
    std::string error;
    for (const double seconds : {0.0, 0.1, 3.0, 86400.0}) {
        CullOptions options;
        options.expiry = seconds;
        const auto back = cullOptionsFromText(toText(options), error);
        ASSERT_TRUE(back) << error;
        EXPECT_EQ(back->expiry, seconds);
    }
    EXPECT_EQ(cullOptionsFromText("method=exact,expiry=7.5", error)->expiry, 7.5);
    for (const char* text : {"expiry=-1", "expiry=long", "expiry=nan", "expiry=86401", "expiry"}) {
        EXPECT_FALSE(cullOptionsFromText(text, error)) << text;
        EXPECT_NE(error.find("expiry"), std::string::npos) << error;
    }
}

TEST(CullOptions, EveryMethodReadsBack) {
    for (const Method method : {Method::Quadratic, Method::Exact, Method::Sphere, Method::None}) {
        CullOptions options;
        options.method = method;
        std::string error;
        const auto back = cullOptionsFromText(toText(options), error);
        ASSERT_TRUE(back) << error;
        EXPECT_EQ(back->method, method);
        EXPECT_EQ(back->horizonUse, HorizonUse::Declared);
        EXPECT_TRUE(back->edges);
    }
}

TEST(CullOptions, OcclusionReadsBack) {
    std::string error;
    EXPECT_EQ(CullOptions().occlusion, OcclusionUse::Auto);
    for (const OcclusionUse use : {OcclusionUse::Off, OcclusionUse::On, OcclusionUse::Auto}) {
        CullOptions options;
        options.occlusion = use;
        EXPECT_EQ(cullOptionsFromText(toText(options), error)->occlusion, use);
    }
    EXPECT_EQ(cullOptionsFromText("occlusion=auto", error)->occlusion, OcclusionUse::Auto);
    for (const char* text : {"occlusion=maybe", "occlusion"}) {
        EXPECT_FALSE(cullOptionsFromText(text, error)) << text;
        EXPECT_NE(error.find("use on, off or auto"), std::string::npos) << error;
    }
}

TEST(CullOptions, HorizonAndEdgesReadBack) {
    std::string error;
    for (const char* text : {"horizon=-500.25 edges=off", "horizon=off", "horizon=declared,edges=on"}) {
        const auto options = cullOptionsFromText(text, error);
        ASSERT_TRUE(options) << error;
        const auto back = cullOptionsFromText(toText(*options), error);
        ASSERT_TRUE(back) << error;
        EXPECT_EQ(back->horizonUse, options->horizonUse);
        EXPECT_EQ(back->horizon, options->horizon);
        EXPECT_EQ(back->edges, options->edges);
    }
    EXPECT_EQ(cullOptionsFromText("horizon=-500", error)->horizon, -500.0);
}

TEST(CullOptions, WhatConcernsForeignDatabasesReadsBack) {
    std::string error;
    const auto options =
        cullOptionsFromText("skirts=all,cluster=keep,heights=-500.5..9000,techniqueMargin=50,index=off", error);
    ASSERT_TRUE(options) << error;
    const auto back = cullOptionsFromText(toText(*options), error);
    ASSERT_TRUE(back) << error;
    EXPECT_EQ(back->skirts, SkirtUse::All);
    EXPECT_EQ(back->cluster, ClusterUse::Keep);
    EXPECT_EQ(back->heights, (core::Interval{-500.5, 9000.0}));
    EXPECT_EQ(back->techniqueMargin, 50.0);
    EXPECT_EQ(back->index, IndexUse::Off);
    EXPECT_EQ(toText(*cullOptionsFromText("skirts=cracks,cluster=replace,index=auto", error)), toText(CullOptions()));
}

TEST(CullOptions, WhatAnApplicationSaysOfItsTilesReadsBack) {
    std::string error;
    const auto options = cullOptionsFromText("globe=1738100/1736000,ground=BTGTerrainGroup", error);
    ASSERT_TRUE(options) << error;
    const auto back = cullOptionsFromText(toText(*options), error);
    ASSERT_TRUE(back) << error;
    ASSERT_TRUE(back->globe);
    EXPECT_EQ(back->globe->equatorialRadius(), 1738100.0);
    EXPECT_EQ(back->globe->polarRadius(), 1736000.0);
    EXPECT_EQ(back->ground, "BTGTerrainGroup");
    EXPECT_NE(toText(*cullOptionsFromText("globe=WGS84", error)).find("globe=wgs84"), std::string::npos);
    CullOptions unreadable;
    unreadable.ground = "two words";
    EXPECT_EQ(toText(unreadable), toText(CullOptions()));
}

TEST(CullOptions, AreEqualInAllItemsOrNot) {
    std::string error;
    for (const char* item : {"method=exact", "horizon=off", "horizon=-500", "inheritviewpoint=on", "edges=off",
                             "expiry=5", "skirts=all", "cluster=keep", "heights=-500..9000", "heights=-11500..8000",
                             "techniquemargin=0", "index=off", "globe=wgs84", "ground=Ground"}) {
        const auto options = cullOptionsFromText(item, error);
        ASSERT_TRUE(options) << error;
        EXPECT_FALSE(*options == CullOptions()) << item;
        EXPECT_TRUE(*options == *cullOptionsFromText(item, error)) << item;
    }
}

TEST(CullOptions, LaterItemsWin) {
    std::string error;
    const auto options = cullOptionsFromText("method=none expiry=1.5,method=exact", error);
    ASSERT_TRUE(options);
    EXPECT_EQ(options->method, Method::Exact);
    EXPECT_EQ(options->expiry, 1.5);
}

TEST(CullOptions, WhatIsWrongIsNamed) {
    const std::pair<const char*, const char*> cases[] = {
        {"method=cube", "cube"},      {"method", "unknown method"},   {"expiry=big", "big"},
        {"colour=red", "colour"},     {"expiry=1.1x", "1.1x"},        {"Meth=exact", "meth"},
        {"horizon=low", "low"},       {"horizon=1e9", "1e9"},         {"edges=maybe", "maybe"},
        {"skirts=none", "none"},      {"cluster=off", "off"},         {"heights=9", "9"},
        {"heights=3..1", "3..1"},     {"heights=a..b", "a..b"},       {"index=x", "x"},
        {"techniquemargin=-1", "-1"}, {"techniquemargin=inf", "inf"}, {"globe=mars", "mars"},
        {"globe=0/1", "0/1"},         {"globe=6e6", "6e6"},           {"ground=", "ground"}};
    for (const auto& [text, named] : cases) {
        std::string error;
        EXPECT_FALSE(cullOptionsFromText(text, error)) << text;
        EXPECT_NE(error.find(named), std::string::npos) << error;
    }
}

}  // namespace
}  // namespace osgAnalyticBin
