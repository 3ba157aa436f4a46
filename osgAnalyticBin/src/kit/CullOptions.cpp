// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Text.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osg/CoordinateSystemNode>
#include <osg/Notify>
#include <osgDB/FileNameUtils>

#include <array>
#include <mutex>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace osgAnalyticBin {

namespace {

template <class T, std::size_t n>
using Names = std::array<std::pair<T, const char*>, n>;

constexpr Names<Method, 4> kMethods{
    {{Method::Quadratic, "quadratic"}, {Method::Exact, "exact"}, {Method::Sphere, "sphere"}, {Method::None, "none"}}};
constexpr Names<bool, 2> kOnOff{{{true, "on"}, {false, "off"}}};
constexpr Names<OcclusionUse, 3> kOcclusions{
    {{OcclusionUse::On, "on"}, {OcclusionUse::Off, "off"}, {OcclusionUse::Auto, "auto"}}};
constexpr Names<SkirtUse, 2> kSkirts{{{SkirtUse::All, "all"}, {SkirtUse::Cracks, "cracks"}}};
constexpr Names<ClusterUse, 2> kClusters{{{ClusterUse::Keep, "keep"}, {ClusterUse::Replace, "replace"}}};
constexpr Names<bool, 2> kShaders{{{true, "plain"}, {false, "declared"}}};
constexpr Names<IndexUse, 3> kIndexes{{{IndexUse::Auto, "auto"}, {IndexUse::On, "on"}, {IndexUse::Off, "off"}}};

// Deeper than any sea, shallower than half of the smallest radius of a planet that is flown over.
constexpr core::Interval kAltitudes{-1e6, 1e6};

// A day. With longer times nothing expires, and memory fills up.
constexpr double kLongestExpiry = 86400.0;

// Metres: as much as a mountain.
constexpr double kWidestTechnique = 1e4;

template <class T, std::size_t n>
const char* nameOf(const Names<T, n>& names, T value) noexcept {
    for (const auto& [known, name] : names) {
        if (known == value) return name;
    }
    return names[0].second;
}

template <class T, std::size_t n>
std::optional<T> valueNamed(const Names<T, n>& names, const std::string& name) noexcept {
    for (const auto& [value, known] : names) {
        if (name == known) return value;
    }
    return std::nullopt;
}

// "one, two or three"
std::string alternatives(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += i + 1 < words.size() ? ", " : " or ";
        text += words[i];
    }
    return text;
}

bool refuse(const std::string& key, const std::string& value, const std::string& use, std::string& error) {
    error = "bad " + key + " \"" + value + "\" (use " + use + ")";
    return false;
}

// An option whose values have names.
template <const auto& kNames, auto kOption>
struct Choice {
    static bool apply(const char* key, const std::string& value, CullOptions& options, std::string& error) {
        const auto found = valueNamed(kNames, value);
        if (found) options.*kOption = *found;
        std::vector<std::string> words;
        for (const auto& known : kNames) words.emplace_back(known.second);
        return found || refuse(key, value, alternatives(words), error);
    }
    static std::string text(const CullOptions& options) {
        return options.*kOption == CullOptions().*kOption ? "" : nameOf(kNames, options.*kOption);
    }
};

bool applyMethod(const char*, const std::string& value, CullOptions& options, std::string& error) {
    const std::optional<Method> method = valueNamed(kMethods, value);
    if (method) options.method = *method;
    if (!method) error = "unknown method \"" + value + "\" (use quadratic, exact, sphere or none)";
    return method.has_value();
}

std::optional<double> numberWithin(const std::string& value, const core::Interval& range) {
    const auto number = numbersFromText(value, 1);
    const bool isWithin = number && (*number)[0] >= range.lower && (*number)[0] <= range.upper;
    return isWithin ? std::optional<double>((*number)[0]) : std::nullopt;
}

bool applyExpiry(const char* key, const std::string& value, CullOptions& options, std::string& error) {
    const auto seconds = numberWithin(value, {0.0, kLongestExpiry});
    if (seconds) options.expiry = *seconds;
    return seconds || refuse(key, value, "seconds from 0 to 86400, e.g. expiry=3", error);
}

std::string expiryText(const CullOptions& options) {
    return options.expiry == CullOptions::kDefaultExpiry ? "" : numberToText(options.expiry);
}

bool applyTechniqueMargin(const char* key, const std::string& value, CullOptions& options, std::string& error) {
    options.techniqueMargin = numberWithin(value, {0.0, kWidestTechnique});
    return options.techniqueMargin || refuse(key, value, "metres from 0 to 10000, e.g. techniquemargin=50", error);
}

std::string techniqueMarginText(const CullOptions& options) {
    return options.techniqueMargin ? numberToText(*options.techniqueMargin) : "";
}

bool applyHorizon(const char* key, const std::string& value, CullOptions& options, std::string& error) {
    const auto altitude = numberWithin(value, kAltitudes);
    if (altitude) options.horizon = *altitude;
    options.horizonUse = altitude ? HorizonUse::Given : value == "off" ? HorizonUse::Off : HorizonUse::Declared;
    return altitude || value == "off" || value == "declared" ||
           refuse(key, value, "an altitude in metres, e.g. horizon=-500, or declared or off", error);
}

std::string horizonText(const CullOptions& options) {
    if (options.horizonUse == HorizonUse::Given) return numberToText(options.horizon);
    return options.horizonUse == HorizonUse::Off ? "off" : "";
}

bool applyHeights(const char* key, const std::string& value, CullOptions& options, std::string& error) {
    const std::size_t dots = value.find("..");
    const auto low = numberWithin(value.substr(0, dots), kAltitudes);
    const auto high = dots == std::string::npos ? std::nullopt : numberWithin(value.substr(dots + 2), kAltitudes);
    if (!low || !high || *low > *high) {
        return refuse(key, value, "two altitudes in metres, low to high, e.g. heights=-500..9000", error);
    }
    options.heights = {*low, *high};
    return true;
}

std::string heightsText(const CullOptions& options) {
    if (options.heights == CullOptions::kTerrainOnEarth) return {};
    return numberToText(options.heights.lower) + ".." + numberToText(options.heights.upper);
}

// The earth's, metres.
const core::Ellipsoid& wgs84() {
    static const core::Ellipsoid ellipsoid(osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR);
    return ellipsoid;
}

bool applyGlobe(const char* key, const std::string& value, CullOptions& options, std::string& error) {
    constexpr core::Interval kRadii{1.0, 1e12};
    const std::size_t slash = value.find('/');
    const auto equatorial = numberWithin(value.substr(0, slash), kRadii);
    const auto polar = slash == std::string::npos ? std::nullopt : numberWithin(value.substr(slash + 1), kRadii);
    if (osgDB::convertToLowerCase(value) == "wgs84") {
        options.globe = wgs84();
    } else if (equatorial && polar) {
        options.globe.emplace(*equatorial, *polar);
    } else {
        return refuse(key, value, "wgs84, or two radii in metres, e.g. globe=1737400/1737400", error);
    }
    return true;
}

std::string globeText(const CullOptions& options) {
    if (!options.globe) return {};
    if (*options.globe == wgs84()) return "wgs84";
    return numberToText(options.globe->equatorialRadius()) + '/' + numberToText(options.globe->polarRadius());
}

bool applyGround(const char* key, const std::string& value, CullOptions& options, std::string& error) {
    options.ground = value;
    return !value.empty() || refuse(key, value, "the name of the nodes that are ground", error);
}

std::string groundText(const CullOptions& options) {
    return options.ground.find_first_of(",; \t\n") == std::string::npos ? options.ground : "";
}

struct KnownItem {
    const char* key;
    const char* values;
    bool (*apply)(const char* key, const std::string& value, CullOptions& options, std::string& error);
    std::string (*text)(const CullOptions& options);  // empty: the default
};

template <const auto& kNames, auto kOption>
constexpr KnownItem choice(const char* key, const char* values) {
    return {key, values, Choice<kNames, kOption>::apply, Choice<kNames, kOption>::text};
}

constexpr std::array<KnownItem, 14> kItems{
    {{"method", "NAME", applyMethod, [](const CullOptions& o) { return std::string(methodName(o.method)); }},
     {"horizon", "METRES|declared|off", applyHorizon, horizonText},
     choice<kOnOff, &CullOptions::inheritViewpoint>("inheritviewpoint", "on|off"),
     choice<kOnOff, &CullOptions::edges>("edges", "on|off"),
     choice<kOcclusions, &CullOptions::occlusion>("occlusion", "on|off|auto"),
     {"expiry", "SECONDS", applyExpiry, expiryText},
     choice<kSkirts, &CullOptions::skirts>("skirts", "cracks|all"),
     choice<kClusters, &CullOptions::cluster>("cluster", "replace|keep"),
     {"heights", "LOW..HIGH", applyHeights, heightsText},
     {"techniquemargin", "METRES", applyTechniqueMargin, techniqueMarginText},
     choice<kShaders, &CullOptions::plainShaders>("shaders", "declared|plain"),
     choice<kIndexes, &CullOptions::index>("index", "auto|on|off"),
     {"globe", "wgs84|EQUATORIAL/POLAR", applyGlobe, globeText},
     {"ground", "NAME", applyGround, groundText}}};

std::string usage() {
    std::vector<std::string> words;
    for (const KnownItem& item : kItems) words.push_back(std::string(item.key) + '=' + item.values);
    return alternatives(words);
}

bool applyItem(const std::string& key, const std::string& value, CullOptions& options, std::string& error) {
    for (const KnownItem& item : kItems) {
        if (key == item.key) return item.apply(item.key, value, options, error);
    }
    error = "unknown parameter \"" + key + "\" (use " + usage() + ")";
    return false;
}

}  // namespace

const char* methodName(Method method) noexcept {
    return nameOf(kMethods, method);
}

bool CullOptions::operator==(const CullOptions& other) const noexcept {
    const auto items = [](const CullOptions& o) {
        return std::tie(o.method, o.horizonUse, o.horizon, o.inheritViewpoint, o.edges, o.occlusion, o.expiry, o.skirts,
                        o.cluster, o.heights.lower, o.heights.upper, o.techniqueMargin, o.plainShaders, o.index,
                        o.globe, o.ground);
    };
    return items(*this) == items(other);
}

std::vector<std::string> cullOptionKeys() {
    std::vector<std::string> keys;
    for (const KnownItem& item : kItems) keys.emplace_back(item.key);
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
    std::string text;
    for (const KnownItem& item : kItems) {
        const std::string value = item.text(options);
        if (!value.empty()) text += (text.empty() ? "" : ",") + std::string(item.key) + '=' + value;
    }
    return text;
}

}  // namespace osgAnalyticBin
