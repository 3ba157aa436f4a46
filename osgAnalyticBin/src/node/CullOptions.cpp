// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Text.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace osgAnalyticBin {

namespace {

constexpr std::array<std::pair<Method, const char*>, 4> kMethodNames{
    {{Method::Quadratic, "quadratic"}, {Method::Exact, "exact"}, {Method::Sphere, "sphere"}, {Method::None, "none"}}};

constexpr std::array<std::pair<IndexUse, const char*>, 3> kIndexNames{
    {{IndexUse::Auto, "auto"}, {IndexUse::On, "on"}, {IndexUse::Off, "off"}}};

// Methods that older versions had, which are in the applications now.
constexpr std::array<const char*, 4> kMovedMethods{"paper", "corners", "box", "orientedbox"};
// The factor of method=paper, which older versions stored with every method.
constexpr const char* kMovedKey = "growth";
constexpr const char* kStoredGrowth = "1.1";

// Deeper than any sea, shallower than half of the smallest radius of a planet that is flown over.
constexpr double kDeepestHorizon = -1e6;

// A day. With longer times nothing expires, and memory fills up.
constexpr double kLongestExpiry = 86400.0;

// Metres: as much as a mountain.
constexpr double kWidestTechnique = 1e4;

bool applyMethod(const std::string& value, CullOptions& options, std::string& error) {
    const std::optional<Method> method = methodFromName(value);
    if (method) options.method = *method;
    const bool isMoved = std::find(kMovedMethods.begin(), kMovedMethods.end(), value) != kMovedMethods.end();
    if (isMoved) {
        error = "method=" + value + " is there for comparison alone: read DATABASE.(method=" + value +
                ").binrival, or run osgbinbench --methods " + value;
    } else if (!method) {
        error = "unknown method \"" + value + "\" (use quadratic, exact, sphere or none)";
    }
    return method.has_value();
}

// A number within a range. `meaning`: what the number is, and an example.
template <class Number>
bool applyNumber(const std::string& key, const std::string& value, const core::Interval& range, const char* meaning,
                 Number& option, std::string& error) {
    const auto number = numbersFromText(value, 1);
    if (!number || (*number)[0] < range.lower || (*number)[0] > range.upper) {
        error = "bad " + key + " \"" + value + "\" (use " + meaning + ")";
        return false;
    }
    option = (*number)[0];
    return true;
}

bool applyExpiry(const std::string& value, CullOptions& options, std::string& error) {
    return applyNumber("expiry", value, {0.0, kLongestExpiry}, "seconds from 0 to 86400, e.g. expiry=3", options.expiry,
                       error);
}

bool applyTechniqueMargin(const std::string& value, CullOptions& options, std::string& error) {
    return applyNumber("techniquemargin", value, {0.0, kWidestTechnique},
                       "metres from 0 to 10000, e.g. techniquemargin=50", options.techniqueMargin, error);
}

bool applyHorizon(const std::string& value, CullOptions& options, std::string& error) {
    if (value == "declared" || value == "off") {
        options.horizonUse = value == "off" ? HorizonUse::Off : HorizonUse::Declared;
        return true;
    }
    const auto number = numbersFromText(value, 1);
    if (!number || (*number)[0] < kDeepestHorizon || (*number)[0] > -kDeepestHorizon) {
        error = "bad horizon \"" + value + "\" (use an altitude in metres, e.g. horizon=-500, or declared or off)";
        return false;
    }
    options.horizonUse = HorizonUse::Given;
    options.horizon = (*number)[0];
    return true;
}

bool applyHeights(const std::string& value, CullOptions& options, std::string& error) {
    const std::size_t dots = value.find("..");
    const auto low = numbersFromText(value.substr(0, dots), 1);
    const auto high = dots == std::string::npos ? std::nullopt : numbersFromText(value.substr(dots + 2), 1);
    if (!low || !high || (*low)[0] > (*high)[0] || (*low)[0] < kDeepestHorizon || (*high)[0] > -kDeepestHorizon) {
        error = "bad heights \"" + value + "\" (use two altitudes in metres, low to high, e.g. heights=-500..9000)";
        return false;
    }
    options.heights = {(*low)[0], (*high)[0]};
    return true;
}

// One of two words.
bool applyChoice(const std::string& key, const std::string& value, const char* first, const char* second, bool& isFirst,
                 std::string& error) {
    isFirst = value == first;
    if (isFirst || value == second) return true;
    error = "bad " + key + " \"" + value + "\" (use " + first + " or " + second + ")";
    return false;
}

bool applySkirts(const std::string& value, CullOptions& options, std::string& error) {
    bool all = false;
    if (!applyChoice("skirts", value, "all", "cracks", all, error)) return false;
    options.skirts = all ? SkirtUse::All : SkirtUse::Cracks;
    return true;
}

bool applyCluster(const std::string& value, CullOptions& options, std::string& error) {
    bool keep = false;
    if (!applyChoice("cluster", value, "keep", "replace", keep, error)) return false;
    options.cluster = keep ? ClusterUse::Keep : ClusterUse::Replace;
    return true;
}

bool applyEdges(const std::string& value, CullOptions& options, std::string& error) {
    return applyChoice("edges", value, "on", "off", options.edges, error);
}

bool applyOcclusion(const std::string& value, CullOptions& options, std::string& error) {
    if (value == "auto") {
        options.occlusion = OcclusionUse::Auto;
        return true;
    }
    if (value != "on" && value != "off") {
        error = "bad occlusion \"" + value + "\" (use on, off or auto)";
        return false;
    }
    options.occlusion = value == "on" ? OcclusionUse::On : OcclusionUse::Off;
    return true;
}

bool applyShaders(const std::string& value, CullOptions& options, std::string& error) {
    return applyChoice("shaders", value, "plain", "declared", options.plainShaders, error);
}

bool applyIndex(const std::string& value, CullOptions& options, std::string& error) {
    for (const auto& [use, name] : kIndexNames) {
        if (value != name) continue;
        options.index = use;
        return true;
    }
    error = "bad index \"" + value + "\" (use auto, on or off)";
    return false;
}

bool applyInheritViewpoint(const std::string& value, CullOptions& options, std::string& error) {
    return applyChoice("inheritviewpoint", value, "on", "off", options.inheritViewpoint, error);
}

struct KnownItem {
    const char* key;
    const char* values;
    bool (*apply)(const std::string& value, CullOptions& options, std::string& error);
};

constexpr std::array<KnownItem, 12> kItems{{{"method", "NAME", applyMethod},
                                            {"horizon", "METRES|declared|off", applyHorizon},
                                            {"inheritviewpoint", "on|off", applyInheritViewpoint},
                                            {"edges", "on|off", applyEdges},
                                            {"occlusion", "on|off|auto", applyOcclusion},
                                            {"expiry", "SECONDS", applyExpiry},
                                            {"skirts", "cracks|all", applySkirts},
                                            {"cluster", "replace|keep", applyCluster},
                                            {"heights", "LOW..HIGH", applyHeights},
                                            {"techniquemargin", "METRES", applyTechniqueMargin},
                                            {"shaders", "declared|plain", applyShaders},
                                            {"index", "auto|on|off", applyIndex}}};

// The name that edges= had; it is read in stored scenes, too.
constexpr const char* kOldEdges = "reverse";

std::string usage() {
    std::string text;
    for (std::size_t i = 0; i < kItems.size(); ++i) {
        if (i > 0) text += i + 1 < kItems.size() ? ", " : " or ";
        text += std::string(kItems[i].key) + '=' + kItems[i].values;
    }
    return text;
}

bool applyItem(const std::string& key, const std::string& value, CullOptions& options, std::string& error) {
    for (const KnownItem& item : kItems) {
        if (key == item.key) return item.apply(value, options, error);
    }
    if (key == kOldEdges) {
        static std::atomic<bool> hasSaid{false};
        if (!hasSaid.exchange(true))
            OSG_NOTICE << "osgAnalyticBin: the option reverse= is called edges= now; the old name is still read."
                       << std::endl;
        return applyEdges(value, options, error);
    }
    if (key == kMovedKey && value == kStoredGrowth) return true;
    if (key == kMovedKey) {
        error = "growth= belongs to method=paper: read DATABASE.(method=paper,growth=FACTOR).binrival";
        return false;
    }
    error = "unknown parameter \"" + key + "\" (use " + usage() + ")";
    return false;
}

}  // namespace

const char* methodName(Method method) noexcept {
    for (const auto& [value, name] : kMethodNames) {
        if (value == method) return name;
    }
    return "quadratic";
}

std::optional<Method> methodFromName(const std::string& name) noexcept {
    for (const auto& [value, known] : kMethodNames) {
        if (name == known) return value;
    }
    return std::nullopt;
}

bool CullOptions::operator==(const CullOptions& other) const noexcept {
    const auto items = [](const CullOptions& o) {
        return std::tie(o.method, o.horizonUse, o.horizon, o.inheritViewpoint, o.edges, o.occlusion, o.expiry, o.skirts,
                        o.cluster, o.heights.lower, o.heights.upper, o.techniqueMargin, o.plainShaders, o.index);
    };
    return items(*this) == items(other);
}

std::vector<std::string> cullOptionKeys() {
    std::vector<std::string> keys;
    for (const KnownItem& item : kItems) keys.emplace_back(item.key);
    keys.emplace_back(kOldEdges);
    return keys;
}

std::optional<CullOptions> cullOptionsFromText(const std::string& text, std::string& error) {
    std::string spaced = text;
    for (char& c : spaced) {
        if (c == ',' || c == ';') c = ' ';
    }
    CullOptions options;
    std::istringstream items(spaced);
    for (std::string item; items >> item;) {
        const std::size_t equals = item.find('=');
        const std::string value = equals == std::string::npos ? std::string() : item.substr(equals + 1);
        if (!applyItem(osgDB::convertToLowerCase(item.substr(0, equals)), value, options, error)) return std::nullopt;
    }
    return options;
}

CullOptions storedCullOptions(const std::string& text) {
    std::string error;
    if (const auto options = cullOptionsFromText(text, error)) return *options;
    static std::mutex mutex;
    static std::set<std::string> told;
    const std::lock_guard<std::mutex> lock(mutex);
    if (told.insert(text).second)
        OSG_WARN << "osgAnalyticBin: a stored scene: " << error << "; using the default options." << std::endl;
    return {};
}

std::string toText(const CullOptions& options) {
    std::string text = std::string("method=") + methodName(options.method);
    if (options.horizonUse == HorizonUse::Off) text += ",horizon=off";
    if (options.horizonUse == HorizonUse::Given) text += ",horizon=" + numberToText(options.horizon);
    if (options.inheritViewpoint) text += ",inheritviewpoint=on";
    if (!options.edges) text += ",edges=off";
    if (options.occlusion != OcclusionUse::Auto)
        text += options.occlusion == OcclusionUse::On ? ",occlusion=on" : ",occlusion=off";
    if (options.expiry != CullOptions::kDefaultExpiry) text += ",expiry=" + numberToText(options.expiry);
    if (options.skirts == SkirtUse::All) text += ",skirts=all";
    if (options.cluster == ClusterUse::Keep) text += ",cluster=keep";
    if (!(options.heights == CullOptions::kTerrainOnEarth)) {
        text += ",heights=" + numberToText(options.heights.lower) + ".." + numberToText(options.heights.upper);
    }
    if (options.techniqueMargin) text += ",techniquemargin=" + numberToText(*options.techniqueMargin);
    if (options.plainShaders) text += ",shaders=plain";
    if (options.index != IndexUse::Auto) text += options.index == IndexUse::On ? ",index=on" : ",index=off";
    return text;
}

}  // namespace osgAnalyticBin
