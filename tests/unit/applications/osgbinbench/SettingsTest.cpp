// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What the command line comes to, and what it refuses; methods by their names.

#include "CullMethod.h"
#include "Failure.h"
#include "Settings.h"

#include <osgAnalyticBin/CullOptions.h>

#include <algorithm>
#include <support/Programs.h>

namespace osgAnalyticBin::bench {
namespace {

using Words = std::vector<std::string>;

Settings settingsOf(Words words) {
    words.insert(words.begin(), "osgbinbench");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    Settings settings;
    EXPECT_TRUE(settingsFromCommandLine(static_cast<int>(arguments.size()), arguments.data(), settings));
    return settings;
}

Settings settingsWith(const Words& options) {
    Words words{"earth.osgb", "--path", "p.csv"};
    words.insert(words.end(), options.begin(), options.end());
    return settingsOf(words);
}

TEST(Settings, HaveTheirDefaults) {
    EXPECT_EQ(settingsWith({}).methods, (Words{"sphere", "cluster", "bins"}));
    // a page for the path around the database, where there are poses to show
    EXPECT_EQ(settingsWith({}).report, "");
    EXPECT_EQ(settingsWith({"--report", "page.html"}).report, "page.html");
    EXPECT_EQ(settingsOf({"earth.osgb"}).report, "report.html");
    EXPECT_EQ(settingsOf({"earth.osgb", "--frames", "10"}).report, "");
    // methods without bins keep tiles as long as bins
    EXPECT_EQ(settingsWith({}).expiry, CullOptions::kDefaultExpiry);
    EXPECT_EQ(settingsWith({"--options", "expiry=7"}).expiry, 7.0);
    EXPECT_EQ(settingsWith({"--expiry", "osg"}).expiry, 0.0);
    EXPECT_EQ(settingsWith({"--expiry", "5", "--options", "expiry=7"}).expiry, 5.0);
    EXPECT_EQ(settingsWith({}).flush, defaultFlush());
    EXPECT_EQ(settingsWith({"--flush", "0"}).flush, 0);
}

TEST(Settings, WrongOnesNameTheOption) {
    const std::pair<Words, const char*> cases[] = {
        {{"--methods", "sphere,cube"}, "unknown method \"cube\""},
        {{"--methods", "sphere+horizon"}, "unknown method \"sphere+horizon\""},
        {{"--options", "horizont=3"}, "--options: unknown parameter"},
        {{"--options", "method=paper"}, "--options: "},
        {{"--size", "640"}, "--size: \"640\""},
        {{"--size", "640x480x3"}, "--size: "},
        {{"--threading", "Many"}, "--threading"},
        {{"--vertical-scale", "0"}, "--vertical-scale"},
        {{"--vertical-scale", "nan"}, "--vertical-scale"},
        {{"--frame-rate", "nan"}, "--frame-rate"},
        {{"--timeout", "nan"}, "--timeout"},
        {{"--expiry", "nan"}, "--expiry"},
        {{"--expiry", "own"}, "--expiry"},
        {{"--flush", "-1"}, "--flush"},
        {{"--frames", "10", "--pictures", "pictures"}, "--pictures: "},
        {{"--jumps", "--report", "page.html"}, "--report: "},
        {{"--draw"}, "--draw: "},
        {{"--speed", "100"}, "--speed: "},
        {{"--csv", "/absent/p.csv"}, "--csv: there is no folder"}};
    for (const auto& [words, what] : cases) {
        const std::string error = test::failureOf([&options = words] { (void)settingsWith(options); });
        EXPECT_NE(error.find(what), std::string::npos) << what << " is not in " << error;
    }
    const std::string error = test::failureOf([] { (void)settingsOf({"reprot"}); });
    EXPECT_NE(error.find("the commands are report and scale"), std::string::npos) << error;
}

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

TEST(CullMethod, FliesTheReferenceFirstAndEveryMethodOnceAndTheOracleAfterWhatItRepeats) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(namesOf(cullMethodsFromNames({"cluster", "exact", "none", "cluster", "exact+horizon"})),
              (Names{"none", "cluster", "exact", "exact+horizon"}));
    const std::vector<CullMethod> methods = cullMethodsFromNames({"oracle", "sphere", "exact+horizon+edges"});
    EXPECT_EQ(namesOf(methods), (Names{"none", "exact+horizon+edges", "oracle", "sphere"}));
    EXPECT_TRUE(methods[2].replaysVerdicts);
    EXPECT_FALSE(methods[1].replaysVerdicts);
    EXPECT_EQ(methods[2].sceneName("earth.osgb", {}), methods[1].sceneName("earth.osgb", {}));
    const Names all = namesOf(cullMethodsFromNames({"exact", "all"}));
#ifdef OSGANALYTICBIN_RESEARCH
    EXPECT_EQ(all.size(), 21U);
#else
    EXPECT_EQ(all.size(), 12U);
#endif
    EXPECT_EQ(all[1], "exact") << "each once, in the order given";
    for (const char* const name : {"sphere", "cluster", "exact+horizon+edges", "exact+horizon+edges+occlusion"})
        EXPECT_EQ(std::count(all.begin(), all.end(), name), 1) << name;
}

TEST(CullMethod, PlainNamesCullByPlanesAloneAndSuffixesAddTheirTests) {
    const struct {
        const char* suffix;
        HorizonUse horizon;
        bool edges;
        OcclusionUse occlusion = OcclusionUse::Off;
        const char* options = "";
    } cases[] = {{"", HorizonUse::Off, false, OcclusionUse::Off, "horizon=-5"},
                 {"+horizon", HorizonUse::Declared, false},
                 {"+edges", HorizonUse::Off, true},
                 {"+horizon+edges", HorizonUse::Given, true, OcclusionUse::Off, "horizon=-5,expiry=7"},
                 {"+horizon+edges+occlusion", HorizonUse::Declared, true, OcclusionUse::On},
                 {"+horizon+occlusion", HorizonUse::Declared, false, OcclusionUse::On}};
    for (const std::string base : {"quadratic", "exact"}) {
        for (const auto& each : cases) {
            const CullOptions options = optionsOf(base + each.suffix, each.options);
            EXPECT_EQ(options.horizonUse, each.horizon) << base << each.suffix;
            EXPECT_EQ(options.edges, each.edges) << base << each.suffix;
            EXPECT_EQ(options.occlusion, each.occlusion) << base << each.suffix;
            EXPECT_EQ(options.method, base == "exact" ? Method::Exact : Method::Quadratic);
            if (each.horizon == HorizonUse::Given) {
                EXPECT_EQ(options.horizon, -5.0);
                EXPECT_EQ(options.expiry, 7.0);
            }
        }
    }
    // "bins" are those that users have
    CullOptions defaults;
    defaults.index = IndexUse::On;  // what becomes complete meanwhile would change the figures
    EXPECT_EQ(optionsOf("bins"), defaults);
    EXPECT_EQ(optionsOf("bins", "expiry=7").expiry, 7.0);
    EXPECT_EQ(optionsOf("bins", "occlusion=off").occlusion, OcclusionUse::Off);
    EXPECT_EQ(optionsOf("quadratic+horizon", "edges=on,occlusion=on").occlusion, OcclusionUse::Off);
    EXPECT_TRUE(cullMethodFromName("bins").usesBins);
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
