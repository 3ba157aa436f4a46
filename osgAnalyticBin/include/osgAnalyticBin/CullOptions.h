// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/rivals/ComparisonBins.h>

#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// How the tiles of a database are culled.
enum class Method {
    Quadratic,    ///< the quadratic bin: sound; the default
    Exact,        ///< the closed form of the geodetic bin: sound, and tight to rounding
    Paper,        ///< the published nine-point rule: unsound, for comparison
    Corners,      ///< the eight corners of the bin: unsound, for comparison
    Box,          ///< the bin's box along the axes of ECEF: sound, for comparison
    OrientedBox,  ///< the bin's box along east, north and up, and a horizon point: sound, for comparison
    Sphere,       ///< OpenSceneGraph's own bounding spheres, untouched
    None          ///< no culling at all: every tile is drawn
};

/// The name that files, options and command lines use: "quadratic", "exact", "paper", "corners", "box", "orientedbox",
/// "sphere", "none".
[[nodiscard]] OSGANALYTICBIN_EXPORT const char* methodName(Method method) noexcept;

/// Returns: nullopt for an unknown name.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::optional<Method> methodFromName(const std::string& name) noexcept;

/// Whether a method is there to be compared with: it culls by planes alone unless it is told otherwise.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool isForComparison(Method method) noexcept;

/// Whether tiles behind the horizon are culled.
enum class HorizonUse {
    ByMethod,  ///< Off with methods for comparison, Declared with the others; the default
    Declared,  ///< against the lowest surface shown, never below what the database declares
    Off,       ///< never
    Given      ///< against the lowest surface shown, never below CullOptions::horizon
};

/// Whether tiles behind terrain are culled.
enum class OcclusionUse {
    Off,  ///< never; the default
    On,   ///< in every frame
    Auto  ///< while terrain hides a quarter of the tiles in view; elsewhere it is tried again after 8 to 64 views
};

/// What of the skirts that hang from the edges of tiles a bin holds. Tiles of a map always hold all of them: at the
/// border of the map they are in plain view.
enum class SkirtUse {
    /// What an eye above the terrain can see: through cracks between tiles, and whole where a tile ends at the outer
    /// border of its database; the default.
    Cracks,
    /// All of them, for cameras below the terrain; the horizon is used only where it is given.
    All
};

/// What becomes of the osg::ClusterCullingCallbacks of a database, whose culls are not sound on an ellipsoid. Those of
/// a map are left alone.
enum class ClusterUse {
    Replace,  ///< taken off; the horizon does their work; the default
    Keep      ///< left in charge beside the bins
};

/// What an installer, a plugin option string or a stored database says about culling.
struct CullOptions {
    /// How tiles are culled.
    Method method = Method::Quadratic;
    /// Factor by which Method::Paper enlarges its box; at least 1.
    double growth = core::PaperBin::kDefaultGrowth;
    /// Whether tiles behind the horizon are culled.
    HorizonUse horizonUse = HorizonUse::ByMethod;
    /// Altitude in metres below which nothing is drawn anywhere in the database, meshes between their posts included;
    /// the database covers the whole globe. Read with HorizonUse::Given.
    double horizon = 0.0;
    /// Whether shadow passes use the horizon too: cameras that inherit a view point or draw depth alone, and those
    /// relative to them. What casts a shadow may lie behind it, and its back faces may be all that is drawn.
    bool inheritViewpoint = false;
    /// Whether tiles across an edge of the frustum are tested against the edge too, or, with boxes, whether the frustum
    /// is beyond one of their faces. Without a value: not with methods for comparison. Tiles of a map, all of them
    /// boxes, are tested unless it is false.
    std::optional<bool> reverse;
    /// Whether tiles behind terrain are culled: on a globe or a region of one that uses the horizon (see `horizonUse`),
    /// for tiles whose meshes the kit reads, by cameras that do not compute their near plane.
    OcclusionUse occlusion = OcclusionUse::Off;
    /// Seconds for which the DatabasePager keeps a tile's finer children after they were last seen, when it has more
    /// PagedLODs than its target; 0 leaves OSG's own rule alone. Bins cull what spheres keep by chance: without this,
    /// turning the head and back reads the same files again.
    double expiry = kDefaultExpiry;

    /// What bins hold of skirts.
    SkirtUse skirts = SkirtUse::Cracks;
    /// What becomes of ClusterCullingCallbacks.
    ClusterUse cluster = ClusterUse::Replace;
    /// Altitudes in metres that no terrain of the database leaves, at any level of detail: for tiles whose descendants
    /// are known neither from a stored bin nor from an index. The default holds all terrain on earth, on a globe of
    /// more units in proportion. In a map: heights in its own units; left at the default, all terrain on earth in feet.
    core::Interval heights = kTerrainOnEarth;
    /// Whether an index beside the database is used.
    bool index = true;

    /// What `horizonUse` comes to with this method; never ByMethod.
    [[nodiscard]] OSGANALYTICBIN_EXPORT HorizonUse effectiveHorizonUse() const noexcept;

    /// What `reverse` comes to with this method.
    [[nodiscard]] OSGANALYTICBIN_EXPORT bool effectiveReverse() const noexcept;

    /// Whether every item is the same.
    [[nodiscard]] OSGANALYTICBIN_EXPORT bool operator==(const CullOptions& other) const noexcept;

    /// Seconds.
    static constexpr double kDefaultExpiry = 3.0;
    /// Metres: the deepest trench and the highest mountain, with room.
    static constexpr core::Interval kTerrainOnEarth{-11500.0, 9000.0};
};

/// Parses "method=paper,growth=1.1", "horizon=-500", "horizon=off", "inheritviewpoint=on", "reverse=off",
/// "occlusion=on", "expiry=3", "skirts=all", "cluster=keep", "heights=-500..9000", "index=off"; commas or blanks part
/// the items; an empty text is the default. Returns: nullopt when an item is unknown or malformed, with one line in
/// `error` that names it and what is allowed.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::optional<CullOptions> cullOptionsFromText(const std::string& text,
                                                                                   std::string& error);

/// What may stand before the "=" in cullOptionsFromText(): "method", "growth" and so on.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::vector<std::string> cullOptionKeys();

/// The text that cullOptionsFromText() reads back to the same options.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string toText(const CullOptions& options);

}  // namespace osgAnalyticBin
