// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin {

/// How the tiles of a database are culled.
enum class Method {
    Quadratic,  ///< the quadratic bin; the default
    Exact,      ///< the closed form of the geodetic bin: tight to rounding
    Sphere,     ///< OpenSceneGraph's own bounding spheres, untouched
    None        ///< no culling below the node that it is installed on: every tile is drawn
};

/// The name that files, options and command lines use: "quadratic", "exact", "sphere", "none".
[[nodiscard]] OSGANALYTICBIN_EXPORT const char* methodName(Method method) noexcept;

/// Whether tiles behind the horizon are culled.
enum class HorizonUse {
    Declared,  ///< with the lowest surface shown, which is never taken to be below the declared altitude; the default
    Off,       ///< never
    Given      ///< with the lowest surface shown, which is never taken to be below CullOptions::horizon
};

/// Whether tiles behind terrain are culled.
enum class OcclusionUse {
    Off,  ///< never
    On,   ///< in every frame
    Auto  ///< the default: while terrain hides a quarter of the tiles in view; elsewhere it is tried again after 8 to
          ///< 256 views. A frame may hide nothing while the search for the next one is made.
};

/// What the osg::ClusterCullingCallbacks of a database do, which may cull visible tiles of an ellipsoid. Those of a map
/// cull.
enum class ClusterUse {
    Replace,  ///< nothing while bins are installed; the horizon replaces them; the default
    Keep      ///< they cull in addition to the bins
};

/// Whether an index of the bins of a whole database is used.
enum class IndexUse {
    Off,  ///< never
    On,   ///< where there is one beside the database
    Auto  ///< the default: where there is none, one is made in the background, and kept in the user's cache folder; for
          ///< databases in local files, whose tiles have no stored bins
};

/// The options of culling, from an installer, a plugin option string or a stored database.
struct CullOptions {
    /// How tiles are culled.
    Method method = Method::Quadratic;
    /// Whether tiles behind the horizon are culled.
    HorizonUse horizonUse = HorizonUse::Declared;
    /// Altitude in metres below which the database draws nothing, not even between the posts of its meshes. The
    /// database has to cover the whole globe. Used with HorizonUse::Given.
    double horizon = 0.0;
    /// Whether shadow passes use the horizon, too: cameras that inherit a view point or draw depth alone, and cameras
    /// relative to them. By default they do not, because terrain behind the horizon may cast a shadow into the picture.
    bool inheritViewpoint = false;
    /// Whether tiles across an edge of the frustum are also tested against the edge.
    bool edges = true;
    /// Whether tiles behind terrain are culled: on a globe or a region of one that uses the horizon (see `horizonUse`),
    /// for tiles whose meshes the kit reads.
    OcclusionUse occlusion = OcclusionUse::Auto;
    /// Seconds for which the DatabasePager keeps a tile's finer children after they were last in view, when it has more
    /// PagedLODs than its target; 0: OSG's own rule. Times that the database or the application sets stay. Spheres keep
    /// many tiles beside the view, bins do not: without this time, turning the camera away and back would read the same
    /// files again.
    double expiry = kDefaultExpiry;

    /// What becomes of ClusterCullingCallbacks.
    ClusterUse cluster = ClusterUse::Replace;
    /// The range of altitudes in metres of all terrain in the database, at every level of detail. It is used for tiles
    /// whose descendants are known neither from a stored bin nor from an index. The default holds all terrain on earth;
    /// on a globe with more units it grows in proportion. In a map: heights in the map's units; the default holds all
    /// terrain on earth in feet.
    core::Interval heights = kTerrainOnEarth;
    /// With a value, the application vouches for all osgTerrain tiles: they are drawn without holes, and no point of
    /// them lies farther than this many metres from the mesh that osgTerrain::GeometryTechnique makes of the same
    /// heights. Set it for terrain with another technique, or with shaders that move vertices. Bins are enlarged by the
    /// value. The horizon is still used, but a value above zero keeps tiles from hiding the tiles behind them. Without
    /// a value, tiles with another technique are never culled, and shaders are assumed to move nothing.
    std::optional<double> techniqueMargin;
    /// Whether all shaders (osg::Program) on the terrain and above it draw all of each triangle where its vertices are,
    /// and nearer or farther as these are. Without this, terrain under a program hides nothing unless
    /// setDrawsTriangles() was called for the program.
    bool plainShaders = false;
    /// Whether an index is used, and made where there is none.
    IndexUse index = IndexUse::Auto;
    /// The globe of tiles that no osg::CoordinateSystemNode stands above, in metres: the node that bins are installed
    /// on is in its earth-centred coordinates. Where there is a CoordinateSystemNode, that one counts. Without a value,
    /// only tiles with stored bins are found without a CoordinateSystemNode.
    std::optional<core::Ellipsoid> globe;
    /// The name of the nodes that are the ground of tiles, such as "BTGTerrainGroup" in SimGear's files. Each of them
    /// is a tile by itself if it is a mesh that stays in its place. Nothing else is a tile then, except what has a
    /// stored bin: objects beside the ground keep OSG's own culling. No index is used. Empty: TileFinder decides.
    std::string ground;

    /// Whether every item is the same.
    [[nodiscard]] OSGANALYTICBIN_EXPORT bool operator==(const CullOptions& other) const noexcept;

    /// Seconds.
    static constexpr double kDefaultExpiry = 3.0;
    /// Metres: from below the deepest trench to above the highest mountain.
    static constexpr core::Interval kTerrainOnEarth{-11500.0, 9000.0};
};

/// Parses "method=exact,edges=off", "horizon=-500", "horizon=off", "inheritviewpoint=on",
/// "occlusion=on", "expiry=3", "cluster=keep", "heights=-500..9000", "techniquemargin=50",
/// "shaders=plain", "index=off", "globe=wgs84", "globe=1737400/1737400", "ground=NAME"; separated by commas or blanks;
/// capital letters in a name do not matter; an empty text gives the default. Returns: nullopt when an item is unknown
/// or malformed, with one line in `error` that names it and what is allowed.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::optional<CullOptions> cullOptionsFromText(const std::string& text,
                                                                                   std::string& error);

/// An option of cullOptionsFromText(), for lists.
struct CullOptionItem {
    std::string key;      ///< "edges"
    std::string values;   ///< "on|off"
    std::string meaning;  ///< A sentence.
};
/// All of them.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::vector<CullOptionItem> cullOptionItems();

/// The text that cullOptionsFromText() reads back to the same options. A name of the ground with a blank or a comma is
/// left out.
[[nodiscard]] OSGANALYTICBIN_EXPORT std::string toText(const CullOptions& options);

/// The options of a stored scene. The default where the text is malformed, after one warning for all scenes with it.
[[nodiscard]] OSGANALYTICBIN_EXPORT CullOptions storedCullOptions(const std::string& text);

}  // namespace osgAnalyticBin
