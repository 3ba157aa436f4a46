// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../index/AutoIndex.h"
#include "../tile/InstalledTile.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/core/horizon/CoveredRegion.h>
#include <osgAnalyticBin/core/mesh/CrackBounds.h>

#include <osg/CoordinateSystemNode>
#include <osg/Referenced>
#include <osg/observer_ptr>
#include <osgTerrain/Terrain>

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

struct ParentTile;

/// What a tile's bin has to be expanded by.
struct Widening {
    AnalyticBin bin;
    bool isBoundless = false;  ///< the extents of what was found are unknown

    [[nodiscard]] bool any() const { return isBoundless || bin.valid(); }
    [[nodiscard]] bool contains(const Widening& other) const;
    void expandBy(const Widening& other);
    /// The expanded bin. An unknown (invalid) bin stays unknown.
    [[nodiscard]] AnalyticBin widened(const AnalyticBin& bin) const;
};

/// State shared by all tiles of one installed database, loaded already or paged in later. Bins are put on them by the
/// installer, which derives from it.
/// Threads: pager and cull threads may call everything except update() and setOptions().
class Database : public InstalledDatabase {
public:
    /// `terrain` and `index` may be null.
    Database(const CullOptions& options, const osg::EllipsoidModel* ellipsoid, osgTerrain::Terrain* terrain,
             const BinIndex* index)
        : InstalledDatabase(ellipsoid),
          _terrain(terrain),
          _options(options),
          _index(index),
          _fittedShape(shape(options)) {}

    /// The database of a tile.
    [[nodiscard]] static Database& of(const InstalledTile& tile) { return static_cast<Database&>(tile.database()); }

    /// Installs bins on content that was read from one of its files, in the thread that reads it. `frame`: where it
    /// stands; `parent`: the tile that pages it, null: none.
    virtual void install(osg::Node& content, const TileFrame& frame, const ParentTile* parent) = 0;
    /// Fits the loaded tiles again. `root`: the node that it is attached to. Requires: no cull traversal runs.
    virtual void refit(osg::Node& root) = 0;
    /// Gives a clone of its root a database of its own.
    virtual void installOnClone(osg::Node& root) = 0;

    /// The node that the database is attached to: the CoordinateSystemNode, or, without one, the root of the scene.
    void setRoot(const osg::Node& node) { _root = &node; }
    /// Whether the database is attached to this node and follows its Terrain. A cloned scene may refer to the database
    /// of the original.
    [[nodiscard]] bool isAttachedTo(const osg::Node& node) const;

    /// Unique within the process, also over databases that are deleted.
    [[nodiscard]] unsigned long number() const { return _number; }

    [[nodiscard]] CullOptions options() const;

    /// Replaces the options. Tiles that were installed with the old ones but are not merged into the scene yet are
    /// fitted again in the first update traversal that finds them there. Requires: no cull traversal runs.
    void setOptions(const CullOptions& options);

    /// How often setOptions() was called or an index was adopted.
    [[nodiscard]] unsigned int generation() const;

    /// Call when bins are removed: files that are read from now on get none.
    void setRemoved();

    /// Records that a file was read, and its bins were installed with the options and the index of `generation`.
    void noteRead(osg::Node& content, unsigned int generation);

    /// Null: there is none, or none yet.
    [[nodiscard]] osg::ref_ptr<const BinIndex> index() const;
    /// Call when a tile that pages finer ones would take its bin from an index.
    void noteIndexWanted() { _isIndexWanted.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool isIndexWanted() const { return _isIndexWanted.load(std::memory_order_relaxed); }
    /// Sets an index that is being made. When it is complete, an update adopts it: the tiles in the scene are fitted
    /// again. Null: none is made.
    void setMaking(AutoIndex* making);
    [[nodiscard]] osg::ref_ptr<AutoIndex> making() const;

    /// The present shape (vertical scale, skirts) from the Terrain, if any, and these options. Not for pager threads,
    /// because the application may change the Terrain at the same time.
    [[nodiscard]] TerrainShape shape(const CullOptions& options) const;

    /// The shape at the last update traversal, which tiles are fitted to. For any thread.
    [[nodiscard]] TerrainShape fittedShape() const;

    /// Whether update() has something to do, or will have once what is on its way is merged. The database's update
    /// callback is on its node only meanwhile: viewers that draw on demand draw frames as long as there is one.
    [[nodiscard]] bool needsUpdate();

    /// In the update traversal: whether all loaded tiles have to be fitted again. Resets the answer.
    [[nodiscard]] bool takeShapeChange();

    /// Records that part of the globe may not be covered by tiles of known depth. The horizon is off then, unless the
    /// options give its altitude.
    void noteGap(const std::string& where);
    [[nodiscard]] bool hasGap() const { return _hasGap.load(std::memory_order_relaxed); }

    /// Call when the mesh of a tile is not known to fill its place. Tells the user once. The horizon is off while the
    /// tile is in view.
    void noteHole(const std::string& where);
    /// Records that something below a tile may be drawn in front of what is nearer: neither the tile nor its ancestors
    /// are hidden.
    static void noteIgnoresDepth(const ParentTile& tile);
    /// Records a tile that is drawn in several places or that moves. Such a tile has no bin, and does not count as an
    /// occluder: if there is a gap as well, the horizon is off, even if its altitude was given.
    void noteStrayTile(const std::string& where);
    [[nodiscard]] bool hasStrayTile() const { return _hasStrayTile.load(std::memory_order_relaxed); }

    /// Says which region a regional database covers; empty: it covers the globe or has a gap.
    void setRegion(const core::GeodeticBin& region);
    /// Returns: nullopt if it covers the globe or has a gap.
    [[nodiscard]] std::optional<core::CoveredRegion> region() const;

    /// Call when the eye is not over the region, so that the horizon hides nothing. Tells the user once.
    void noteEyeBesideRegion();

    /// Records that a tile is not where its bin was stored or installed. The horizon is off then, even if its altitude
    /// was given.
    void noteMovedTile(const std::string& where);
    [[nodiscard]] bool hasMovedTile() const { return _hasMovedTile.load(std::memory_order_relaxed); }

    /// Call when occlusion is wanted for a camera whose near plane OSG computes only after the cull traversal. Warns
    /// once.
    void noteUnknownNearPlane();

    /// Call when a camera uses occlusion. Tiles that are read from now on get their plates while they are read, this
    /// tile gets them in one of the next updates. `mesh`: the tile's own mesh.
    void askForPlates(const AnalyticBinCullCallback& tile, osg::Node& mesh);
    [[nodiscard]] bool wantsPlates() const { return _wantsPlates.load(std::memory_order_relaxed); }

    /// Call when osgTerrain tiles have a technique that the kit does not know.
    void noteUnknownTechnique();

    /// Call when a tile does not fit the index: warns once, and expands the tile's ancestors at the next update.
    static void reportMisfit(const ParentTile& tile, const AnalyticBin& bin);

    /// Call when a tile is larger than the bin stored with it or with its parent. Does the same as reportMisfit().
    static void reportFalseBin(const ParentTile& tile, const AnalyticBin& bin);

    /// Call when a tile may legitimately draw outside of its ancestors' bins. Expands them without a warning.
    static void noteLarger(const ParentTile& tile, const AnalyticBin& bin) { widenFrom(tile, {bin}); }

    /// The same for one tile, but not for its ancestors. Until the next update the tile stays visible.
    static void widenAlone(const ParentTile& tile, const Widening& by);

    /// Call when it cannot be checked whether a tile fits into the bins stored with it and its ancestors: warns once,
    /// and keeps the ancestors visible from the next update on.
    static void reportUnverifiable(const ParentTile& tile);

    /// Records content below a tile that its bin does not contain. The tile stays visible until the next update expands
    /// the bin.
    void noteContent(const AnalyticBinCullCallback& tile, const Widening& by);

    /// Call when a family was placed on a group or made anew: meshes of its tiles that have changed since bins were
    /// installed are trusted again, by new evidence. osgUtil::Optimizer may have changed their form: the new form is as
    /// good. Requires: no cull traversal runs.
    static void trustMeshes(osg::Node& group);

    /// What was reported for a tile or its descendants.
    [[nodiscard]] Widening correction(const std::string& file, std::size_t ordinal) const;

    /// In the update traversal, before takeShapeChange(): does what was asked for since the last one.
    void update();

    /// Call in cull traversals: they notice most of what there is to do.
    void noteCull() { _wasCulled.store(true, std::memory_order_relaxed); }
    /// Whether there was a cull traversal since this was last asked.
    [[nodiscard]] bool takeCull() { return _wasCulled.exchange(false, std::memory_order_relaxed); }

    /// Expands the bins of tiles by what was found below them. Call it after bins were installed on nodes of the scene.
    /// Requires: no cull traversal runs.
    void widenLoaded();

protected:
    ~Database() override = default;

private:
    using TileKey = std::pair<std::string, std::size_t>;

    void widen(const ParentTile& tile, const Widening& by, bool isFitted);
    static void widenFrom(const ParentTile& tile, const Widening& by);
    static void warn(const ParentTile& tile, bool Database::*hasWarned, const char* what);
    void adoptIndex();
    void renewOnTheirWay();
    void findLateComers();
    void makePlates();
    void renewFamilies();

    static inline std::atomic<unsigned long> _count{0};

    const unsigned long _number = ++_count;
    const osg::observer_ptr<osgTerrain::Terrain> _terrain;
    const osg::Node* _root = nullptr;
    std::atomic<bool> _wasCulled{false};
    std::atomic<bool> _hasGap{false};
    std::atomic<bool> _hasHole{false};
    std::atomic<bool> _hasStrayTile{false};
    std::atomic<bool> _hasMovedTile{false};
    std::atomic<bool> _hasUnknownTechnique{false};
    std::atomic<bool> _hasUnknownNearPlane{false};
    std::atomic<bool> _hasEyeBesideRegion{false};
    std::atomic<bool> _wantsPlates{false};
    std::atomic<bool> _isIndexWanted{false};
    mutable std::mutex _mutex;  // guards the members below
    CullOptions _options;
    osg::ref_ptr<const BinIndex> _index;
    osg::ref_ptr<AutoIndex> _making;
    std::optional<core::CoveredRegion> _region;
    TerrainShape _fittedShape;
    unsigned int _generation = 0;
    std::vector<osg::observer_ptr<osg::Node>> _onTheirWay;  // not merged yet, of this generation
    std::vector<osg::observer_ptr<osg::Node>> _lateComers;  // the same, of earlier ones
    bool _hasWarnedOfIndex = false, _hasWarnedOfStored = false, _hasWarnedOfUnverifiable = false;
    std::map<TileKey, Widening> _corrections;
    std::vector<std::pair<osg::observer_ptr<AnalyticBinCullCallback>, Widening>> _toWiden;
    std::vector<std::pair<osg::observer_ptr<const AnalyticBinCullCallback>, osg::observer_ptr<osg::Node>>> _awaitPlates;
};

/// A tile, as its paged descendants refer to it.
struct ParentTile : public osg::Referenced {
    osg::ref_ptr<const ParentTile> parent;  // null: a tile of the root file
    osg::observer_ptr<AnalyticBinCullCallback> callback;
    bool isTile = true;  // false: a node without a bin, between tiles; it has neither number nor extents
    std::string file;
    std::size_t ordinal = 0;
    bool hasNewContent = false;  // since bins were last installed on it
    core::GeodeticBin extents;
    bool isMeasured = false;  // the extents are those of its mesh, and finer tiles may leave them
    core::GeodeticBin place;  // that its own mesh has; empty: not known
    core::TileEdges edges;
    // The tile's stored bin, or that of the nearest ancestor with one. Invalid: there is none.
    AnalyticBin stored;
    // The database of the tile: a globe inside another globe has its own.
    osg::ref_ptr<Database> database;
    // What the callback's bin has to be expanded by; null: nothing. Guarded by the database.
    mutable std::unique_ptr<Widening> widening;

protected:
    ~ParentTile() override = default;
};

}  // namespace osgAnalyticBin
