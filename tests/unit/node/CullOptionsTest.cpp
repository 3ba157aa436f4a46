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
    EXPECT_EQ(options->growth, 1.1);
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
    for (const Method method : {Method::Quadratic, Method::Exact, Method::Paper, Method::Corners, Method::Box,
                                Method::OrientedBox, Method::Sphere, Method::None}) {
        EXPECT_EQ(methodFromName(methodName(method)), method);
        CullOptions options;
        options.method = method;
        options.growth = 1.0 + 1.0 / 3.0;
        std::string error;
        const auto back = cullOptionsFromText(toText(options), error);
        ASSERT_TRUE(back) << error;
        EXPECT_EQ(back->method, method);
        EXPECT_EQ(back->growth, options.growth);
        EXPECT_EQ(back->horizonUse, HorizonUse::ByMethod);
        EXPECT_EQ(back->edges, std::nullopt);
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

// In scenes that older versions have stored.
TEST(CullOptions, EdgesAreReadByTheirOldName) {
    std::string error;
    for (const bool isOn : {false, true}) {
        const auto options = cullOptionsFromText(isOn ? "reverse=on" : "reverse=off", error);
        ASSERT_TRUE(options) << error;
        EXPECT_EQ(options->edges, isOn);
        EXPECT_NE(toText(*options).find(isOn ? ",edges=on" : ",edges=off"), std::string::npos);
    }
    EXPECT_FALSE(cullOptionsFromText("reverse=maybe", error));
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

TEST(CullOptions, MethodsForComparisonCullByPlanesAloneUnlessTold) {
    std::string error;
    const auto horizonOf = [&](const char* text) { return cullOptionsFromText(text, error)->effectiveHorizonUse(); };
    const auto edgesOf = [&](const char* text) { return cullOptionsFromText(text, error)->effectiveEdges(); };
    for (const std::string name : {"paper", "corners", "box", "orientedbox"}) {
        const std::string text = "method=" + name;
        EXPECT_EQ(horizonOf(text.c_str()), HorizonUse::Off) << name;
        EXPECT_FALSE(edgesOf(text.c_str())) << name;
        EXPECT_EQ(horizonOf(("horizon=declared," + text).c_str()), HorizonUse::Declared) << name;
        EXPECT_EQ(horizonOf((text + ",horizon=-500").c_str()), HorizonUse::Given) << name;
        EXPECT_TRUE(edgesOf((text + ",edges=on").c_str())) << name;
    }
    for (const std::string name : {"quadratic", "exact"}) {
        const std::string text = "method=" + name;
        EXPECT_EQ(horizonOf(text.c_str()), HorizonUse::Declared) << name;
        EXPECT_TRUE(edgesOf(text.c_str())) << name;
        EXPECT_EQ(horizonOf((text + ",horizon=off").c_str()), HorizonUse::Off) << name;
        EXPECT_FALSE(edgesOf((text + ",edges=off").c_str())) << name;
    }
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

TEST(CullOptions, AreEqualInAllItemsOrNot) {
    std::string error;
    for (const char* item : {"method=exact", "growth=1.5", "horizon=off", "horizon=-500", "inheritviewpoint=on",
                             "edges=off", "expiry=5", "skirts=all", "cluster=keep", "heights=-500..9000",
                             "heights=-11500..8000", "techniquemargin=0", "index=off"}) {
        const auto options = cullOptionsFromText(item, error);
        ASSERT_TRUE(options) << error;
        EXPECT_FALSE(*options == CullOptions()) << item;
        EXPECT_TRUE(*options == *cullOptionsFromText(item, error)) << item;
    }
}

TEST(CullOptions, LaterItemsWin) {
    std::string error;
    const auto options = cullOptionsFromText("method=paper growth=1.5,method=corners", error);
    ASSERT_TRUE(options);
    EXPECT_EQ(options->method, Method::Corners);
    EXPECT_EQ(options->growth, 1.5);
}

TEST(CullOptions, WhatIsWrongIsNamed) {
    const std::pair<const char*, const char*> cases[] = {
        {"method=cube", "cube"},      {"method", "unknown method"},  {"growth=big", "big"},
        {"growth=0.5", "0.5"},        {"growth=nan", "nan"},         {"growth=11", "11"},
        {"colour=red", "colour"},     {"growth=1.1x", "1.1x"},       {"Meth=paper", "meth"},
        {"horizon=low", "low"},       {"horizon=1e9", "1e9"},        {"edges=maybe", "maybe"},
        {"skirts=none", "none"},      {"cluster=off", "off"},        {"heights=9", "9"},
        {"heights=3..1", "3..1"},     {"heights=a..b", "a..b"},      {"index=x", "x"},
        {"techniquemargin=-1", "-1"}, {"techniquemargin=inf", "inf"}};
    for (const auto& [text, named] : cases) {
        std::string error;
        EXPECT_FALSE(cullOptionsFromText(text, error)) << text;
        EXPECT_NE(error.find(named), std::string::npos) << error;
    }
}

}  // namespace
}  // namespace osgAnalyticBin
