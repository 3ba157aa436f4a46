// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"
#include "Failure.h"

#include <gtest/gtest.h>

namespace osgAnalyticBin::bench {
namespace {

TEST(CullMethod, FliesTheReferenceFirstAndEveryMethodOnce) {
    const auto methods = cullMethodsFromNames({"cluster", "exact", "none", "cluster"});
    ASSERT_EQ(methods.size(), 3U);
    EXPECT_EQ(methods[0].name, "none");
    EXPECT_EQ(methods[1].name, "cluster");
    EXPECT_EQ(methods[2].name, "exact");
}

TEST(CullMethod, KnowsWhoKeepsTheClusterCallbacks) {
    EXPECT_TRUE(cullMethodFromName("none").removesClusters);
    EXPECT_TRUE(cullMethodFromName("none").cullsNothing);
    EXPECT_TRUE(cullMethodFromName("sphere").removesClusters);
    EXPECT_FALSE(cullMethodFromName("cluster").removesClusters);
    EXPECT_FALSE(cullMethodFromName("quadratic").removesClusters);
}

TEST(CullMethod, NamesThePseudoLoader) {
    EXPECT_EQ(cullMethodFromName("exact").sceneName("a/earth.osgb", "horizon=-5,reverse=off"),
              "a/earth.osgb.(method=exact,horizon=-5,reverse=off).analyticbin");
    EXPECT_EQ(cullMethodFromName("cluster").sceneName("earth.osgb", "horizon=-5"),
              "earth.osgb.(method=sphere).analyticbin");
}

TEST(CullMethod, RefusesUnknownNames) {
    EXPECT_THROW((void)cullMethodFromName("spheres"), Failure);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
