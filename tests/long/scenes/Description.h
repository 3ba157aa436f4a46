// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A scene in numbers: what it is built of, what happens in which frame, and what looks at it. Everything random is in
// here, so that a part can be left out and the rest stays as it was. As text: SceneText.h.

#pragma once

#include "Includes.h"

#include <osg/CullSettings>

namespace osgAnalyticBin::test {

/// A tile of one of the scene's databases. Tiles of level n + 1 are a quarter of those of level n.
struct TileKey {
    int database = 0;
    int level = 0;
    int column = 0;
    int row = 0;

    [[nodiscard]] bool operator==(const TileKey& other) const;
    /// "database.level.column.row".
    [[nodiscard]] std::string text() const;
    /// Whether this tile is the other one, or above it.
    [[nodiscard]] bool holds(const TileKey& other) const;
    [[nodiscard]] TileKey parent() const { return {database, level - 1, column / 2, row / 2}; }
    [[nodiscard]] TileKey quarter(int i) const { return {database, level + 1, 2 * column + i % 2, 2 * row + i / 2}; }
};

enum class MeshKind {
    Local,   ///< float vertices below a static MatrixTransform
    Ecef,    ///< float vertices in ECEF
    Terrain  ///< osgTerrain::TerrainTile
};

/// How the content of a file stands in it.
enum class FileShape {
    Tiles,  ///< a group of four tiles
    Slots,  ///< a group of four groups with one tile each
    Whole   ///< one tile of the same extents, without a group
};

/// A database: a globe of tiles, or a map.
struct DatabaseSpec {
    double equatorial = 6378137.0, polar = 6356752.3142;
    bool isMap = false;
    int columns = 8, rows = 4;
    int shownColumns = 8;  ///< fewer: a region, not the whole globe
    int firstRow = 0;      ///< of a region: rows of tiles to the south of it
    int levels = 1;        ///< finer ones, in files
    int posts = 5;
    MeshKind mesh = MeshKind::Local;
    FileShape fileShape = FileShape::Tiles;
    bool storesBins = false;
    bool groupsLeaves = true;  ///< stored bins of the last level are on a group above the mesh, and not on the mesh
    bool hasSkirts = true;
    bool hasQuads = true;         ///< skirts are made of quads, and not of triangles
    bool isLoaded = false;        ///< the files' content is there from the beginning
    bool leavesArePaged = false;  ///< tiles of the last level are PagedLODs without files
    bool requestsBins = false;    ///< bins are installed by an InstallBinsCallback, and not by installBins()
    double relief = 3000.0;       ///< heights are within plus and minus this, metres
    double waves = 5.0;  ///< hills and valleys: radians of the sine for a radian of latitude, for 50 km in a map
    double verticalScale = 1.0;
    double range = 3.0;  ///< tiles are refined nearer than this many of their radii
    CullOptions options;
    osg::Vec3d position;  ///< of the centre
    double turn = 0.0;    ///< radians about its own axis
    osg::Vec3d drift;     ///< metres a frame

    /// Whether the tiles cover the whole globe.
    [[nodiscard]] bool isWhole() const { return !isMap && shownColumns == columns && rows == columns / 2; }
    [[nodiscard]] double scale() const { return equatorial / 6378137.0; }
    /// Metres: a globe's radius; the width of a map that shows all its columns.
    [[nodiscard]] double size() const { return isMap ? 64000.0 : equatorial; }
    /// Radians; in a map, metres.
    [[nodiscard]] double tileWidth(int level) const;
    /// From hill to hill along a meridian: radians; in a map, metres.
    [[nodiscard]] double waveLength() const { return (isMap ? 5e4 : 1.0) * 2.0 * osg::PI / waves; }
    void setWaveLength(double length) { waves = (isMap ? 5e4 : 1.0) * 2.0 * osg::PI / length; }
    /// From the database's own frame to the world's in a frame.
    [[nodiscard]] osg::Matrixd toWorld(int frame) const;
};

/// What else a scene is made of, and what happens to it.
enum class PartKind {
    // built in: between tiles
    Switch,
    Sequence,
    Lod,
    Paged,
    Proxy,
    PlainGroup,
    Turned,    // a static transform with a tile in its own frame below it
    Instance,  // a tile is the one of another column under a transform
    Again,     // the whole database a second time, elsewhere
    MovingTiles,
    Caster,     // a group that casts the visitors that it meets
    GroupTree,  // groups above the tiles of a database
    // what tiles draw
    MeshHole,
    ReversedFaces,
    NarrowTile,
    DrawsNothing,  // a class of the application's
    // what files hold
    Adding,      // a file adds to its tile, and replaces nothing
    Objects,     // a paged file of houses
    EqualNames,  // of all files of a database
    // on nodes
    CullingOff,
    UserCull,
    UserUpdate,
    DrawableBin,
    Outline,  // polygon modes
    Fill,
    State,      // see States.h
    LeavesOut,  // cull callbacks
    PushesState,
    Masks,
    Meddles,  // with tiles that the traversal has not come to
    Vanish,   // see Parts.cpp
    OneShot,  // an update callback that takes itself off
    BoundCallback,
    NoBoundCallback,
    DrawableCull,  // callbacks of drawables
    DrawableDraw,
    DrawableUpdate,
    DrawableBound,
    Raise,  // the vertices of a mesh
    // models
    Tower,
    Vehicle,
    Sign,      // is drawn in front of all
    Unculled,  // stands elsewhere, and says so
    Traffic,   // many small towers that ask whether terrain hides them
    // cameras, picks
    Camera,
    Pick,
    // events
    Toggle,
    SetOptions,
    Install,
    Uninstall,
    SetScale,
    Clone,
    SaveAndLoad,
    Expire,
    Move,
    Shove,    // a transform at or above a mesh is turned about the axis
    TileData  // of osgTerrain, see Parts.cpp
};

/// Where in the scene a part is.
enum class Hook {
    Root,
    Globe,
    Tile,
    Own,
    Mesh,
    Geode,
    File,
    Slot,
    Drawable,  ///< the first one of the geode
    Above,     ///< a group of GroupTree
    Place,     ///< the transform above a database
    View,      ///< the camera's own state
    Model,     ///< of the first part
    Tower      ///< its drawable
};

/// One ingredient or event.
struct Part {
    PartKind kind = PartKind::Tower;
    int id = 0;           ///< tells parts of one scene apart
    int frame = 0;        ///< 0: from the beginning
    int until = 0;        ///< the frame that takes it away again; 0: none
    bool isLate = false;  ///< after the update traversal of its frame, else before
    Hook hook = Hook::Globe;
    TileKey tile;
    int variant = 0;
    unsigned int value = 1;                  ///< of a state: osg::StateAttribute::GLModeValue
    double latitude = 0.0, longitude = 0.0;  ///< radians; in a map, metres
    double low = 0.0, high = 0.0;            ///< metres
    double amount = 0.0;
    bool asks = false;  ///< a model asks whether terrain hides it
    osg::Matrixd view, projection;
    CullOptions options;
};

/// What is culled for in one frame.
struct ViewSpec {
    bool isActive = true;
    osg::Matrixd view, projection;
    osg::CullSettings::CullingMode cullingMode = osg::CullSettings::VIEW_FRUSTUM_SIDES_CULLING;
    osg::CullSettings::ComputeNearFarMode computeNearFar = osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
    double smallFeaturePixels = 2.0;
    bool isTileByTile = false;  ///< as a TileSurvey has it
};

/// What a scene has more of than others.
enum class Theme { Anything, Models, ScaledTerrain, Hills };

struct Description {
    std::uint64_t seed = 0;
    Theme theme = Theme::Anything;
    bool hasBins = true;  ///< else both scenes have none: what fails then is the oracle's fault
    std::vector<DatabaseSpec> databases;
    std::vector<Part> parts;
    std::vector<ViewSpec> views;  ///< one a frame; the first frame is 1

    [[nodiscard]] const DatabaseSpec& database(int number) const { return databases[static_cast<std::size_t>(number)]; }

    /// Radians by which the frame of a tile is turned about the axis of its database.
    [[nodiscard]] double turnOf(const TileKey& tile) const;
};

/// In the order of the enumerators of Hook.
[[nodiscard]] const std::vector<const char*>& hookWords();

/// The name of the node that a hook is.
[[nodiscard]] std::string nodeName(Hook hook, const TileKey& tile);

/// Variants of cameras in the scene from this number on let near and far planes be computed where the view does.
constexpr int kFixedCameras = 9;

/// Classes of the groups of a GroupTree, by its amount: plain groups, and others.
constexpr int kGroupClasses = 6;

/// Whether parts of a kind are built by makeModel().
[[nodiscard]] bool isModel(PartKind kind);
/// Whether the application may leave out a tile or a part of one, or draw it otherwise than by its vertices.
[[nodiscard]] bool altersDrawing(PartKind kind);

/// Whether a vertical scale is set. OSG's spheres of osgTerrain tiles do not follow it, and cull visible ones.
[[nodiscard]] bool hasScaledTerrain(const Description& description);

/// Whether a database consists of osgTerrain tiles.
[[nodiscard]] bool hasTerrain(const Description& description);

}  // namespace osgAnalyticBin::test
