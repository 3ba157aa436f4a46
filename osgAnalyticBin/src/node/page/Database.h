// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "IndexAdoption.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/TileFinder.h>
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

class Coverage;
struct ParentTile;

/// What a tile's bin has to be widened by.
struct Widening {
    AnalyticBin bin;
    bool isBoundless = false;  ///< what was found cannot be told

    [[nodiscard]] bool any() const { return isBoundless || bin.valid(); }
    [[nodiscard]] bool contains(const Widening& other) const;
    void expandBy(const Widening& other);
    /// The wider bin; one that is not known stays so.
    [[nodiscard]] AnalyticBin widened(const AnalyticBin& bin) const;
};

/// What the tiles of one installed database share: those that are loaded, and those that the DatabasePager will load.
/// Threads: everything may be called from the pager's threads and from cull threads but update() and setOptions().
class Database : public osg::Referenced {
public:
    /// `terrain` and `index` may be null.
    Database(const CullOptions& options, const osg::EllipsoidModel* ellipsoid, osgTerrain::Terrain* terrain,
             const BinIndex* index)
        : _ellipsoid(ellipsoid),
          _terrain(terrain),
          _index(index),
          _adoption(!index && options.index == IndexUse::Auto),
          _options(options),
          _fittedShape(shape(options)) {}

    /// The node that the database is attached to: the CoordinateSystemNode, or, without one, the root of the scene.
    void setRoot(const osg::Node& node) { _root = &node; }
    /// Whether it is attached to this node, and follows its Terrain. Clones of a scene share what names databases.
    [[nodiscard]] bool isAttachedTo(const osg::Node& node) const;

    /// A number that no other database of this process has or had.
    [[nodiscard]] unsigned long number() const { return _number; }

    [[nodiscard]] CullOptions options() const;

    /// Culls by other options from now on. Tiles that were treated by the old ones and are still on their way, read or
    /// not, are fitted anew in the update traversal that finds them in the scene. Not while a cull traversal runs.
    void setOptions(const CullOptions& options);

    /// How often setOptions() was called.
    [[nodiscard]] unsigned int generation() const;

    /// Says that bins are taken off: what is read from now on gets none.
    void setRemoved();
    [[nodiscard]] bool isRemoved() const { return _isRemoved.load(std::memory_order_relaxed); }

    /// Says that a file's content is on its way into the scene, treated by the options of that generation.
    void noteRead(osg::Node& content, unsigned int generation);

    /// mapPlane() once a tile of a map has got a bin.
    [[nodiscard]] const osg::EllipsoidModel* ellipsoid() const {
        return _ground.load(std::memory_order_relaxed) == Ground::Map ? mapPlane() : _ellipsoid.get();
    }
    /// Whether a tile on this ellipsoid, or in the plane of a map, may have a bin: all tiles with bins are on a globe,
    /// or all are in a map. The first one that is asked for tells which.
    [[nodiscard]] bool takes(const osg::EllipsoidModel& ellipsoid);
    [[nodiscard]] const BinIndex* index() const { return _index.get(); }
    /// The entry of a tile in the index that is in use or being made. Returns: nullopt where there is no index, or no
    /// entry yet. `isWhole`: whether the index is complete.
    [[nodiscard]] std::optional<BinIndex::Entry> indexEntry(const std::string& file, std::size_t ordinal,
                                                            bool& isWhole) const;
    /// The index that is being made, and the tiles that wait for it.
    [[nodiscard]] IndexAdoption& adoption() { return _adoption; }

    /// The shape that the Terrain, if any, gives its tiles at present, as far as these options tell. Not in the pager's
    /// threads: the application may change it meanwhile.
    [[nodiscard]] TerrainShape shape(const CullOptions& options) const;

    /// The shape that tiles are fitted to: that of the last update traversal. In any thread.
    [[nodiscard]] TerrainShape fittedShape() const;

    /// Says that tiles were met that are not fitted to the present shape.
    void requestRefit() const { _isRefitWanted.store(true, std::memory_order_relaxed); }

    /// Says that the children of a group with a family have changed. The next update makes the family anew.
    void noteChanged(osg::Group& group) const;

    /// In the update traversal: whether the loaded tiles have to be fitted anew, told once.
    [[nodiscard]] bool takeShapeChange();

    /// Says that something of the globe may not be covered by tiles of known depth: no horizon then, unless given.
    void noteGap(const std::string& where);
    [[nodiscard]] bool hasGap() const { return _hasGap.load(std::memory_order_relaxed); }

    /// Says that the database has a tile that is drawn in several places, or that moves. It has no bin, and whether it
    /// hides what is behind it is not looked at: with a gap no horizon then, given or not.
    void noteStrayTile(const std::string& where);
    [[nodiscard]] bool hasStrayTile() const { return _hasStrayTile.load(std::memory_order_relaxed); }

    /// Says what the tiles of a file cover: noteGap(), but for root files that cover a region.
    void noteCoverage(const std::string& file, const Coverage& coverage);

    /// The region that a regional database covers; none: the database covers the globe, or has a gap.
    [[nodiscard]] std::optional<core::CoveredRegion> region() const;

    /// Says that an eye is not over the region, where the horizon hides nothing. Says so to the user once.
    void noteEyeBesideRegion();

    /// Says that a tile does not stand where its bin was stored or installed. Its place is a gap, and no horizon is
    /// used, not even a given one.
    void noteMovedTile(const std::string& where);
    [[nodiscard]] bool hasMovedTile() const { return _hasMovedTile.load(std::memory_order_relaxed); }

    /// Says that occlusion was asked for by a camera whose near plane OSG computes after the cull traversal. Warns
    /// once.
    void noteUnknownNearPlane();

    /// Says that a camera looks for tiles behind terrain. Tiles that are read from now on get their plates at once,
    /// this one in one of the next updates. `mesh`: what it draws by itself.
    void askForPlates(const AnalyticBinCullCallback& tile, osg::Node& mesh);
    [[nodiscard]] bool wantsPlates() const { return _wantsPlates.load(std::memory_order_relaxed); }

    /// Says that osgTerrain tiles are drawn in a way that is not known.
    void noteUnknownTechnique();

    /// Says that a tile does not fit the index: warns once, and widens the tile's ancestors at the next update.
    static void reportMisfit(const ParentTile& tile, const AnalyticBin& bin);

    /// Says that a tile is larger than the bin that is stored with it or with its parent: likewise.
    static void reportFalseBin(const ParentTile& tile, const AnalyticBin& bin);

    /// Says that what a tile draws may leave the bins of the tiles above it, for good reasons: these are widened.
    static void noteLarger(const ParentTile& tile, const AnalyticBin& bin) { widenFrom(tile, {bin}); }

    /// Says that nobody can tell whether a tile fits into the bins that are stored with it and above it: warns once,
    /// and has the tile's ancestors kept visible from the next update on.
    static void reportUntold(const ParentTile& tile);

    /// Says that something stands below a tile, now or from now on, that its bin does not hold. The tile is kept
    /// visible until the next update widens the bin.
    void noteContent(const AnalyticBinCullCallback& tile, const Widening& by);

    /// Says what a tile and its loaded descendants are culled by. The loaded bins of the tiles above it grow to hold
    /// that in the next update. Not valid: it is not known, and these tiles are culled by their declared bins.
    static void noteLoaded(const ParentTile& tile, const AnalyticBin& shown);

    /// Says that a tile which is loaded, or on its way, is not held by the bin of a tile above it: likewise. The tile
    /// above is kept visible meanwhile.
    void noteLoaded(const AnalyticBinCullCallback& above, const AnalyticBin& shown);

    /// What the reports said of a tile or its descendants.
    [[nodiscard]] Widening correction(const std::string& file, std::size_t ordinal) const;

    /// In the update traversal, before takeShapeChange(): widens the loaded tiles that were reported.
    void update();

    /// Where no cull traversal runs, after bins were installed on what is in the scene: widens tiles by what was found
    /// below them.
    void widenLoaded();

protected:
    ~Database() override = default;

private:
    enum class Ground { Open, Globe, Map };
    using TileKey = std::pair<std::string, std::size_t>;

    void widen(const ParentTile& tile, const Widening& by, bool isFitted);
    void applyWidenings();
    void growLoadedBins();
    static void widenFrom(const ParentTile& tile, const Widening& by);
    static void warn(const ParentTile& tile, bool Database::*hasWarned, const char* what);
    void refitLateComers();
    void makePlates();
    void renewFamilies();

    static inline std::atomic<unsigned long> _count{0};

    const unsigned long _number = ++_count;
    const osg::ref_ptr<const osg::EllipsoidModel> _ellipsoid;
    const osg::observer_ptr<osgTerrain::Terrain> _terrain;
    const osg::Node* _root = nullptr;
    const osg::ref_ptr<const BinIndex> _index;
    IndexAdoption _adoption;
    mutable std::atomic<bool> _isRefitWanted{false};
    std::atomic<Ground> _ground{Ground::Open};
    std::atomic<bool> _isRemoved{false};
    std::atomic<bool> _hasGap{false};
    std::atomic<bool> _hasStrayTile{false};
    std::atomic<bool> _hasMovedTile{false};
    std::atomic<bool> _hasUnknownTechnique{false};
    std::atomic<bool> _hasUnknownNearPlane{false};
    std::atomic<bool> _hasEyeBesideRegion{false};
    std::atomic<bool> _wantsPlates{false};
    mutable std::mutex _mutex;  // guards what follows
    CullOptions _options;
    std::optional<core::CoveredRegion> _region;
    TerrainShape _fittedShape;
    unsigned int _generation = 0;
    std::vector<osg::observer_ptr<osg::Node>> _onTheirWay;  // treated by the present options
    std::vector<osg::observer_ptr<osg::Node>> _lateComers;  // treated by earlier ones
    bool _hasWarnedOfIndex = false, _hasWarnedOfStored = false, _hasWarnedOfUntold = false;
    std::map<TileKey, Widening> _corrections;
    struct Widened {
        osg::observer_ptr<AnalyticBinCullCallback> callback;
        Widening by;
        bool isLoaded = false;  // it is there already
    };
    struct Grown {
        osg::observer_ptr<AnalyticBinCullCallback> callback;
        AnalyticBin shown;
        bool wasKeptVisible = false;
    };
    std::vector<Widened> _toWiden;
    std::vector<Grown> _toGrow;
    mutable std::vector<osg::observer_ptr<osg::Group>> _changedGroups;
    std::vector<std::pair<osg::observer_ptr<const AnalyticBinCullCallback>, osg::observer_ptr<osg::Node>>> _awaitPlates;
};

/// A tile as those that are paged below it see it.
struct ParentTile : public osg::Referenced {
    osg::ref_ptr<const ParentTile> parent;  // null: a tile of the root file
    osg::observer_ptr<AnalyticBinCullCallback> callback;
    bool isTile = true;  // false: a node without a bin, between tiles; it has neither number nor extents
    std::string file;
    std::size_t ordinal = 0;
    bool hasNewContent = false;  // since bins were last installed on it
    core::GeodeticBin extents;
    core::TileEdges edges;
    // What the tile is culled by, where a stored bin says so; else that of the nearest tile above that has one.
    // Invalid: there is none.
    AnalyticBin stored;
    // Of the tile: a globe inside another has its own.
    osg::ref_ptr<Database> database;
    // By how much its callback has to be widened; null: not at all. Guarded by the database.
    mutable std::unique_ptr<Widening> widening;
    // Whether its bin holds no more than what is loaded.
    bool isLoadedOnly = false;
    // Whether no other thread than the one that installs bins can have it yet.
    mutable bool isBeingInstalled = false;
    // All that was noted as loaded. Guarded by the database.
    mutable AnalyticBin loaded;

protected:
    ~ParentTile() override = default;
};

}  // namespace osgAnalyticBin
