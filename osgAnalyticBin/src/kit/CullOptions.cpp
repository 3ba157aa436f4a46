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

// An option whose values have names.
template <const auto& kNames, auto kOption>
struct Choice {
    static bool apply(const std::string& value, CullOptions& options) {
        const auto found = valueNamed(kNames, value);
        if (found) options.*kOption = *found;
        return found.has_value();
    }
    static std::string text(const CullOptions& options) {
        return options.*kOption == CullOptions().*kOption ? "" : nameOf(kNames, options.*kOption);
    }
};

std::optional<double> numberWithin(const std::string& value, const core::Interval& range) {
    const auto number = numbersFromText(value, 1);
    const bool isWithin = number && (*number)[0] >= range.lower && (*number)[0] <= range.upper;
    return isWithin ? std::optional<double>((*number)[0]) : std::nullopt;
}

// Two numbers with something between.
std::optional<std::pair<double, double>> numbersWithin(const std::string& value, const std::string& between,
                                                       const core::Interval& range) {
    const std::size_t at = value.find(between);
    if (at == std::string::npos) return std::nullopt;
    const auto first = numberWithin(value.substr(0, at), range);
    const auto second = numberWithin(value.substr(at + between.size()), range);
    return first && second ? std::optional(std::pair(*first, *second)) : std::nullopt;
}

bool applyExpiry(const std::string& value, CullOptions& options) {
    const auto seconds = numberWithin(value, {0.0, kLongestExpiry});
    if (seconds) options.expiry = *seconds;
    return seconds.has_value();
}

std::string expiryText(const CullOptions& options) {
    return options.expiry == CullOptions::kDefaultExpiry ? "" : numberToText(options.expiry);
}

bool applyTechniqueMargin(const std::string& value, CullOptions& options) {
    options.techniqueMargin = numberWithin(value, {0.0, kWidestTechnique});
    return options.techniqueMargin.has_value();
}

std::string techniqueMarginText(const CullOptions& options) {
    return options.techniqueMargin ? numberToText(*options.techniqueMargin) : "";
}

bool applyHorizon(const std::string& value, CullOptions& options) {
    const auto altitude = numberWithin(value, kAltitudes);
    if (altitude) options.horizon = *altitude;
    options.horizonUse = altitude ? HorizonUse::Given : value == "off" ? HorizonUse::Off : HorizonUse::Declared;
    return altitude || value == "off" || value == "declared";
}

std::string horizonText(const CullOptions& options) {
    if (options.horizonUse == HorizonUse::Given) return numberToText(options.horizon);
    return options.horizonUse == HorizonUse::Off ? "off" : "";
}

bool applyHeights(const std::string& value, CullOptions& options) {
    const auto heights = numbersWithin(value, "..", kAltitudes);
    if (!heights || heights->first > heights->second) return false;
    options.heights = {heights->first, heights->second};
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

bool applyGlobe(const std::string& value, CullOptions& options) {
    const auto radii = numbersWithin(value, "/", {1.0, 1e12});
    if (radii) options.globe.emplace(radii->first, radii->second);
    const bool isEarth = osgDB::convertToLowerCase(value) == "wgs84";
    if (isEarth) options.globe = wgs84();
    return radii || isEarth;
}

std::string globeText(const CullOptions& options) {
    if (!options.globe) return {};
    if (*options.globe == wgs84()) return "wgs84";
    return numberToText(options.globe->equatorialRadius()) + '/' + numberToText(options.globe->polarRadius());
}

bool applyGround(const std::string& value, CullOptions& options) {
    options.ground = value;
    return !value.empty();
}

std::string groundText(const CullOptions& options) {
    return options.ground.find_first_of(",; \t\n") == std::string::npos ? options.ground : "";
}

struct KnownItem {
    const char* key;
    const char* values;
    bool (*apply)(const std::string& value, CullOptions& options);  // returns: whether the value is allowed
    std::string (*text)(const CullOptions& options);                // empty: the default
    const char* meaning;
};

template <const auto& kNames, auto kOption>
constexpr KnownItem choice(const char* key, const char* values, const char* meaning) {
    return {key, values, Choice<kNames, kOption>::apply, Choice<kNames, kOption>::text, meaning};
}

constexpr std::array<KnownItem, 13> kItems{
    {{"method", "quadratic|exact|sphere|none", Choice<kMethods, &CullOptions::method>::apply,
      [](const CullOptions& options) { return std::string(methodName(options.method)); },
      "How tiles are culled: by bins, quadratic (default) or exact; sphere leaves OSG's culling alone; none culls "
      "nothing."},
     {"horizon", "METRES|declared|off", applyHorizon, horizonText,
      "Culls tiles behind the horizon of the lowest surface shown. METRES, such as -500: altitude below which nothing "
      "is drawn; declared: the altitude that the database declares; default declared."},
     choice<kOnOff, &CullOptions::inheritViewpoint>(
         "inheritviewpoint", "on|off",
         "The horizon also for cameras that inherit a view point (shadow passes); default off."),
     choice<kOnOff, &CullOptions::edges>("edges", "on|off",
                                         "Tests tiles across an edge of the frustum against the edge too; default on."),
     choice<kOcclusions, &CullOptions::occlusion>(
         "occlusion", "on|off|auto",
         "Culls tiles behind terrain, where the near plane is fixed; auto: while that hides a quarter of the tiles in "
         "view; default auto."),
     {"expiry", "SECONDS", applyExpiry, expiryText,
      "Time, up to 86400, for which finer tiles out of view are kept when the DatabasePager has more than its target; "
      "default 3, 0 leaves OSG's own rule alone."},
     choice<kClusters, &CullOptions::cluster>(
         "cluster", "replace|keep",
         "Whether the database's ClusterCullingCallbacks cull nothing (default) or are left in charge."),
     {"heights", "LOW..HIGH", applyHeights, heightsText,
      "Range of altitudes in metres of all terrain in the database, for tiles that are in no index; default "
      "-11500..9000."},
     {"techniquemargin", "METRES", applyTechniqueMargin, techniqueMarginText,
      "Declares that osgTerrain tiles with another technique, or moved by shaders, stay within this distance, 0 to "
      "10000, of the mesh that GeometryTechnique makes; default: other techniques are not culled."},
     choice<kShaders, &CullOptions::plainShaders>(
         "shaders", "declared|plain",
         "plain: declares that all shaders draw all of each triangle where its vertices are; otherwise terrain under a "
         "shader hides nothing unless the application declares its program; default declared."),
     choice<kIndexes, &CullOptions::index>(
         "index", "auto|on|off",
         "Whether an index beside the database (DATABASE.bins) is used; auto (default): made in the background where "
         "there is none."),
     {"globe", "wgs84|EQUATORIAL/POLAR", applyGlobe, globeText,
      "The globe, by its radii in metres, where no CoordinateSystemNode stands above the tiles."},
     {"ground", "NAME", applyGround, groundText,
      "The name of the nodes that are the tiles' ground; all else keeps OSG's own culling."}}};

bool applyItem(const std::string& key, const std::string& value, CullOptions& options, std::string& error) {
    std::string usage;
    for (const KnownItem& item : kItems) {
        const std::string text = std::string(item.key) + '=' + item.values;
        usage += (usage.empty() ? "" : ", ") + text;
        if (key != item.key) continue;
        if (item.apply(value, options)) return true;
        error = "bad " + key + " \"" + value + "\" (use " + text + ')';
        return false;
    }
    error = "unknown parameter \"" + key + "\" (use " + usage + ')';
    return false;
}

}  // namespace

const char* methodName(Method method) noexcept {
    return nameOf(kMethods, method);
}

bool CullOptions::operator==(const CullOptions& other) const noexcept {
    const auto items = [](const CullOptions& o) {
        return std::tie(o.method, o.horizonUse, o.horizon, o.inheritViewpoint, o.edges, o.occlusion, o.expiry,
                        o.cluster, o.heights.lower, o.heights.upper, o.techniqueMargin, o.plainShaders, o.index,
                        o.globe, o.ground);
    };
    return items(*this) == items(other);
}

std::vector<CullOptionItem> cullOptionItems() {
    std::vector<CullOptionItem> items;
    for (const KnownItem& item : kItems) items.push_back({item.key, item.values, item.meaning});
    return items;
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
