// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"
#include "Failure.h"

#include <osgAnalyticBin/CullOptions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace osgAnalyticBin::bench {
namespace {

using support::Failure;

std::vector<std::string> namesOf(const std::vector<CullMethod>& methods) {
    std::vector<std::string> names;
    for (const CullMethod& method : methods) names.push_back(method.name);
    return names;
}

// What the kit makes of the parameters in the name of a scene.
CullOptions optionsOf(const std::string& method, const std::string& binOptions = {}) {
    const std::string scene = cullMethodFromName(method).sceneName("earth.osgb", binOptions);
    const std::size_t begin = scene.find(".(") + 2;
    std::string error;
    const auto options = cullOptionsFromText(scene.substr(begin, scene.find(").analyticbin") - begin), error);
    EXPECT_TRUE(options) << scene << ": " << error;
    return options.value_or(CullOptions());
}

TEST(CullMethod, FliesTheReferenceFirstAndEveryMethodOnce) {
    const std::vector<std::string> names{"none", "cluster", "exact", "exact+horizon"};
    EXPECT_EQ(namesOf(cullMethodsFromNames({"cluster", "exact", "none", "cluster", "exact+horizon"})), names);
}

TEST(CullMethod, AllStandsForWhatIsWorthComparing) {
    const std::vector<std::string> names = namesOf(cullMethodsFromNames({"exact", "all"}));
#ifdef OSGANALYTICBIN_RESEARCH
    EXPECT_EQ(names.size(), 21U);
#else
    EXPECT_EQ(names.size(), 12U);
#endif
    EXPECT_EQ(names[0], "none");
    EXPECT_EQ(names[1], "exact") << "each once, in the order given";
    for (const char* const name : {"sphere", "cluster", "exact+horizon+edges", "exact+horizon+edges+occlusion"})
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST(CullMethod, TheOracleComesAfterWhatItRepeats) {
    const std::vector<std::string> names{"none", "exact+horizon+edges", "oracle", "sphere"};
    const std::vector<CullMethod> methods = cullMethodsFromNames({"oracle", "sphere", "exact+horizon+edges"});
    EXPECT_EQ(namesOf(methods), names);
    EXPECT_TRUE(methods[2].replaysVerdicts);
    EXPECT_FALSE(methods[1].replaysVerdicts);
    EXPECT_EQ(methods[2].sceneName("earth.osgb", {}), methods[1].sceneName("earth.osgb", {}));
}

TEST(CullMethod, KnowsWhatBecomesOfTheClusterCallbacks) {
    EXPECT_EQ(cullMethodFromName("none").clusters, Clusters::Remove);
    EXPECT_TRUE(cullMethodFromName("none").cullsNothing);
    EXPECT_EQ(cullMethodFromName("sphere").clusters, Clusters::Remove);
    EXPECT_EQ(cullMethodFromName("cluster").clusters, Clusters::Fill);
    EXPECT_EQ(cullMethodFromName("quadratic+horizon").clusters, Clusters::Keep);
}

TEST(CullMethod, PlainNamesCullByPlanesAlone) {
    for (const char* const name : {"quadratic", "exact"}) {
        const CullOptions plain = optionsOf(name, "horizon=-5");
        EXPECT_EQ(plain.horizonUse, HorizonUse::Off) << name;
        EXPECT_FALSE(plain.edges) << name;
        const CullOptions horizon = optionsOf(std::string(name) + "+horizon");
        EXPECT_EQ(horizon.horizonUse, HorizonUse::Declared) << name;
        EXPECT_FALSE(horizon.edges) << name;
        const CullOptions edges = optionsOf(std::string(name) + "+edges");
        EXPECT_EQ(edges.horizonUse, HorizonUse::Off) << name;
        EXPECT_TRUE(edges.edges) << name;
        const CullOptions both = optionsOf(std::string(name) + "+horizon+edges", "horizon=-5,skirts=all");
        EXPECT_EQ(both.horizonUse, HorizonUse::Given) << name;
        EXPECT_EQ(both.horizon, -5.0) << name;
        EXPECT_EQ(both.skirts, SkirtUse::All) << name;
        EXPECT_TRUE(both.edges) << name;
        EXPECT_EQ(both.occlusion, OcclusionUse::Off) << name;
        const CullOptions all = optionsOf(std::string(name) + "+horizon+edges+occlusion");
        EXPECT_EQ(all.horizonUse, HorizonUse::Declared) << name;
        EXPECT_EQ(all.occlusion, OcclusionUse::On) << name;
        EXPECT_TRUE(all.edges) << name;
        EXPECT_FALSE(optionsOf(std::string(name) + "+horizon+occlusion").edges) << name;
    }
    EXPECT_EQ(optionsOf("exact+horizon").method, Method::Exact);
}

TEST(CullMethod, BinsAreThoseThatUsersHave) {
    CullOptions defaults;
    defaults.index = IndexUse::On;  // what becomes complete meanwhile would change the figures
    EXPECT_EQ(optionsOf("bins"), defaults);
    EXPECT_EQ(optionsOf("bins", "skirts=all").skirts, SkirtUse::All);
    EXPECT_TRUE(cullMethodFromName("bins").usesBins);
}

TEST(CullMethod, NamesThePseudoLoader) {
    EXPECT_EQ(cullMethodFromName("exact+horizon+edges").sceneName("a/earth.osgb", "skirts=all"),
              "a/earth.osgb.(method=exact,index=on,horizon=declared,skirts=all,edges=on,occlusion=off).analyticbin");
    EXPECT_EQ(cullMethodFromName("cluster").sceneName("earth.osgb", "horizon=-5"),
              "earth.osgb.(method=sphere).analyticbin");
#ifdef OSGANALYTICBIN_RESEARCH
    EXPECT_EQ(cullMethodFromName("orientedbox+horizon+edges").sceneName("earth.osgb", "skirts=all"),
              "earth.osgb.(method=orientedbox,index=on,horizon=declared,skirts=all,edges=on,occlusion=off).binrival");
#else
    EXPECT_THROW((void)cullMethodFromName("orientedbox"), Failure);
#endif
}

TEST(CullMethod, RefusesWhatIsUnknownOrMakesNoSense) {
    for (const char* const name :
         {"spheres", "sphere+horizon", "exact+raster", "oracle+horizon", "exact+edges+horizon", "exact+horizon+horizon",
          "exact+", "+horizon", "", "exact+edges+occlusion", "box+horizon+occlusion", "exact+horizon+occlusion+edges",
          "bins+horizon", "orientedboxes"})
        EXPECT_THROW((void)cullMethodFromName(name), Failure) << name;
}

}  // namespace
}  // namespace osgAnalyticBin::bench
