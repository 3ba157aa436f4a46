// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracles: exact comparison of what is written with what is read back; dense samples of the bin for the sphere.
// The interval arithmetic behind expandBy and contains is tested in core/GeodeticBinTest.cpp.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::GeodeticBin;

TEST(AnalyticBin, IsInvalidUntilSomethingIsPutIn) {
    AnalyticBin bin;
    EXPECT_FALSE(bin.valid());
    bin.expandBy(core::Geodetic{0.1, 0.2, 30.0});
    EXPECT_TRUE(bin.valid());
    EXPECT_TRUE(bin.contains(core::Geodetic{0.1, 0.2, 30.0}));
    bin.init();
    EXPECT_FALSE(bin.valid());
}

TEST(AnalyticBin, ExpandingByABinTakesTheLargerMargin) {
    AnalyticBin bin(GeodeticBin::fromDegrees({0, 1}, {0, 1}, {0, 1}), 0.5);
    bin.expandBy(AnalyticBin(GeodeticBin::fromDegrees({2, 3}, {2, 3}, {-5, 7}), 2.0));
    EXPECT_EQ(bin.margin(), 2.0);
    EXPECT_EQ(bin.bin(), GeodeticBin::fromDegrees({0, 3}, {0, 3}, {-5, 7}));
    bin.expandBy(AnalyticBin());
    EXPECT_EQ(bin.margin(), 2.0);
}

TEST(AnalyticBin, TextRoundTripIsExactForQuadtreeCells) {
    for (int level = 0; level < 12; ++level) {
        const double width = 22.5 / (1 << level);
        for (int i = 0; i < 50; ++i) {
            const double south = -90.0 + width * (i * 7 % (8 << level));
            const double west = -180.0 + width * (i * 13 % (16 << level));
            const AnalyticBin bin(
                GeodeticBin::fromDegrees({south, south + width}, {west, west + width}, {-412.25, 8848.9}), 0.125);
            EXPECT_EQ(AnalyticBin::fromText(bin.toText()), bin) << bin.toText();
        }
    }
}

TEST(AnalyticBin, TextRoundTripOfAnyAnglesContainsTheBin) {
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const double a = random.uniform(-1.57, 1.57);
        const double b = random.uniform(-1.57, 1.57);
        const double west = random.uniform(-3.14, 3.14);
        const AnalyticBin bin(
            GeodeticBin({std::min(a, b), std::max(a, b)}, {west, west + 0.3}, {-1.0 / 3.0, 1e5 / 7.0}));
        const AnalyticBin back = AnalyticBin::fromText(bin.toText());
        ASSERT_TRUE(back.contains(bin)) << bin.toText();
        ASSERT_LE(back.bin().latitude().upper - bin.bin().latitude().upper, 1e-15);
        ASSERT_LE(bin.bin().longitude().lower - back.bin().longitude().lower, 1e-15);
    }
}

TEST(AnalyticBin, TextIsDegreesAndMetresAsAPersonWouldWriteThemAndTheSag) {
    AnalyticBin bin(GeodeticBin::fromDegrees({-22.5, 0}, {157.5, 180}, {-10376, 12.5}), 1.0);
    EXPECT_EQ(bin.toText(), "-22.5 157.5 -10376 0 180 12.5 1");
    bin.setSag(2500.0);
    EXPECT_EQ(bin.toText(), "-22.5 157.5 -10376 0 180 12.5 1 2500");
    EXPECT_EQ(AnalyticBin::fromText(bin.toText()), bin);
}

TEST(AnalyticBin, BrokenTextIsAnInvalidBin) {
    for (const char* text :
         {"", "1 2 3", "1 2 3 4 5 6", "1 2 3 4 5 6 7 8 9", "0 0 0 1 1 1 0 -1", "a b c d e f g", "4 2 3 1 5 6 0",
          "0 0 nan 1 1 1 0", "0 0 0 1 1 inf 0", "-91 0 0 1 1 1 0", "0 0 0 91 1 1 0", "0 0 5 1 1 1 0", "0 0 0 1 1 1 -1",
          "0,0,0,1,1,1,0", "0 0 0 1 1 1e999 0", "0 -1e300 0 1 1 1 0"})
        EXPECT_FALSE(AnalyticBin::fromText(text).valid()) << text;
}

// Terrain is taken as pairs of a post's height and the dip of the chords beside it.
TEST(AnalyticBin, ExaggerationHoldsScaledPostsAndTheirUnscaledDips) {
    Random random(7);
    for (int trial = 0; trial < 2000; ++trial) {
        AnalyticBin bin;
        std::vector<std::pair<double, double>> posts;
        for (int part = 0; part < 3; ++part) {
            const double dip = random.uniform(0.0, 3000.0);
            const double post = random.uniform(-11000.0, 9000.0);
            posts.emplace_back(post, dip);
            AnalyticBin own(GeodeticBin::fromDegrees({0, 1}, {0, 1}, {post - dip, post}));
            own.setSag(dip);
            bin.expandBy(own);
        }
        for (const double scale : {-2.0, -0.5, 0.0, 0.25, 1.0, 3.0, 20.0}) {
            const core::Interval scaled = bin.exaggerated(scale).bin().altitude();
            for (const auto& [post, dip] : posts) {
                ASSERT_LE(scaled.lower, scale * post - dip + 1e-9) << scale;
                ASSERT_GE(scaled.upper, scale * post - 1e-9) << scale;
            }
        }
        ASSERT_EQ(bin.exaggerated(1.0), bin);
    }
    EXPECT_FALSE(AnalyticBin(GeodeticBin::wholeGlobe({0, 1})).exaggerated(std::nan("")).valid());
}

TEST(AnalyticBin, IsStoredWithANodeAsATypeOfOsgsOwn) {
    const osg::ref_ptr<osg::Group> node = new osg::Group;
    EXPECT_FALSE(hasStoredBin(*node));
    EXPECT_FALSE(storedBin(*node).valid());
    const AnalyticBin bin(GeodeticBin::fromDegrees({0, 22.5}, {0, 22.5}, {-10, 20}), 0.5);
    setStoredBin(*node, bin);
    EXPECT_TRUE(hasStoredBin(*node));
    EXPECT_EQ(storedBin(*node), bin);
    const osg::Object* value = node->getUserDataContainer()->getUserObject(0);
    EXPECT_STREQ(value->libraryName(), "osg");
    EXPECT_STREQ(value->className(), "StringValueObject");
}

TEST(AnalyticBin, TheLowestAltitudeOfASurfaceIsStoredBesideTheBin) {
    const osg::ref_ptr<osg::Group> node = new osg::Group;
    EXPECT_FALSE(storedSurfaceLow(*node));
    setStoredSurfaceLow(*node, -1.0 / 3.0);
    EXPECT_EQ(storedSurfaceLow(*node), -1.0 / 3.0);
    EXPECT_FALSE(hasStoredBin(*node));
    node->setUserValue("osgAnalyticBin.surfaceLow", std::string("nan"));
    EXPECT_FALSE(storedSurfaceLow(*node));
}

double reachOf(const osg::BoundingSphere& sphere, const AnalyticBin& bin, int samplesAcross) {
    double reach = 0.0;
    for (const osg::Vec3d& p : samples(bin, samplesAcross))
        reach = std::max(reach, (p - osg::Vec3d(sphere.center())).length());
    return reach;
}

TEST(AnalyticBin, SphereHoldsTheBinAndIsNotMuchLargerThanNeeded) {
    const osg::EllipsoidModel wgs84;
    for (const double width : {22.5, 5.625, 0.1}) {
        for (double south = -90.0; south + width <= 90.0; south += 22.5) {
            const AnalyticBin bin(
                GeodeticBin::fromDegrees({south, south + width}, {170.0, 170.0 + width}, {-400.0, 8800.0}));
            const osg::BoundingSphere sphere = bin.boundingSphere(wgs84);
            const double reach = reachOf(sphere, bin, 9);
            EXPECT_LE(reach, sphere.radius());
            EXPECT_LE(sphere.radius(), 1.15 * reach + 2.0) << width << " at " << south;
        }
    }
    EXPECT_FALSE(AnalyticBin().boundingSphere(wgs84).valid());
    const AnalyticBin globe(GeodeticBin::wholeGlobe({-11000.0, 9000.0}));
    EXPECT_LE(reachOf(globe.boundingSphere(wgs84), globe, 15), globe.boundingSphere(wgs84).radius());
}

TEST(CullOptions, EmptyTextIsTheDefault) {
    for (const char* text :
         {"", "method=quadratic expiry=3,occlusion=auto;horizon=declared,edges=on", "cluster=replace,index=auto"})
        EXPECT_TRUE(optionsOf(text) == CullOptions()) << text;
    EXPECT_EQ(CullOptions().method, Method::Quadratic);
    EXPECT_EQ(CullOptions().expiry, 3.0);
    EXPECT_EQ(CullOptions().occlusion, OcclusionUse::Auto);
}

TEST(CullOptions, OfAllItemsReadBackAndDifferFromTheDefault) {
    std::istringstream items(
        "method=exact method=sphere method=none horizon=off horizon=-500.25 inheritviewpoint=on edges=off expiry=0 "
        "expiry=0.1 expiry=86400 cluster=keep heights=-500.5..9000 heights=-11500..8000 techniquemargin=0 "
        "techniqueMargin=50 index=off index=on occlusion=off occlusion=on globe=wgs84 globe=1738100/1736000 "
        "ground=BTGTerrainGroup");
    for (std::string item; items >> item;) {
        const CullOptions options = optionsOf(item);
        EXPECT_FALSE(options == CullOptions()) << item;
        EXPECT_TRUE(optionsOf(toText(options)) == options) << item;
    }
}

TEST(CullOptions, MeanWhatTheySay) {
    const CullOptions options = optionsOf("method=none expiry=1.5,method=exact,horizon=-500,heights=-500.5..9000");
    EXPECT_EQ(options.method, Method::Exact) << "later items win";
    EXPECT_EQ(options.expiry, 1.5);
    EXPECT_EQ(options.horizonUse, HorizonUse::Given);
    EXPECT_EQ(options.horizon, -500.0);
    EXPECT_EQ(options.heights, (core::Interval{-500.5, 9000.0}));
    const CullOptions moon = optionsOf("globe=1738100/1736000");
    ASSERT_TRUE(moon.globe);
    EXPECT_EQ(std::pair(moon.globe->equatorialRadius(), moon.globe->polarRadius()), std::pair(1738100.0, 1736000.0));
    EXPECT_NE(toText(optionsOf("globe=WGS84")).find("globe=wgs84"), std::string::npos);
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
