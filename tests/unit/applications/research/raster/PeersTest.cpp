// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"
#include "Failure.h"
#include "RasterCulling.h"
#include "RivalOptions.h"

#include <osgAnalyticBin/CullOptions.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace osgAnalyticBin::bench {
namespace {

class PeersTest : public testing::Test {
protected:
    void SetUp() override { addPeers(); }
    void TearDown() override { peers() = {}; }
};

TEST_F(PeersTest, AreAmongAllMethods) {
    const std::vector<CullMethod> methods = cullMethodsFromNames({"all"});
    EXPECT_EQ(methods.size(), 22U);
    for (const char* const name : {"cluster+raster", "box", "orientedbox+horizon+edges", "corners", "paper+horizon"})
        EXPECT_EQ(std::count_if(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; }), 1)
            << name;
}

TEST_F(PeersTest, TheRasterStandsOnClusterCallbacks) {
    EXPECT_EQ(cullMethodFromName("cluster+raster").clusters, Clusters::FillForRaster);
    EXPECT_TRUE(cullMethodFromName("cluster+raster").usesRaster());
    EXPECT_FALSE(cullMethodFromName("cluster+raster").usesBins());
}

TEST_F(PeersTest, HaveNoSuffixesThatMakeNoSense) {
    for (const char* const name : {"sphere+raster", "exact+raster", "orientedboxes", "box+horizon+occlusion"})
        EXPECT_THROW((void)cullMethodFromName(name), support::Failure) << name;
}

TEST_F(PeersTest, RulesOfOthersAreReadBySomethingElse) {
    const auto rivalOf = [](const std::string& method, const std::string& binOptions = {}) {
        const std::string scene = cullMethodFromName(method).sceneName("earth.osgb", binOptions);
        const std::size_t begin = scene.find(".(") + 2;
        std::string error;
        const auto options = rivals::rivalOptionsFromText(scene.substr(begin, scene.find(").binrival") - begin), error);
        EXPECT_TRUE(options) << scene << ": " << error;
        return options.value_or(rivals::RivalOptions());
    };
    for (const char* const name : {"box", "orientedbox", "corners", "paper"}) {
        EXPECT_TRUE(cullMethodFromName(name).usesBins() && cullMethodFromName(name).usesRivals()) << name;
        const rivals::RivalOptions plain = rivalOf(name, "horizon=-5");
        EXPECT_EQ(plain.rule, rivals::ruleFromName(name)) << name;
        EXPECT_FALSE(plain.usesHorizon || plain.testsEdges) << name;
        const rivals::RivalOptions both = rivalOf(std::string(name) + "+horizon+edges", "horizon=-5,skirts=all");
        EXPECT_TRUE(both.usesHorizon && both.testsEdges) << name;
        std::string error;
        const auto ofBins = cullOptionsFromText(both.binOptions, error);
        ASSERT_TRUE(ofBins) << error;
        EXPECT_EQ(ofBins->horizon, -5.0) << name;
        EXPECT_EQ(ofBins->skirts, SkirtUse::All) << name;
        EXPECT_EQ(ofBins->occlusion, OcclusionUse::Off) << name;
    }
    EXPECT_FALSE(cullMethodFromName("exact+horizon").usesRivals());
}

}  // namespace
}  // namespace osgAnalyticBin::bench
