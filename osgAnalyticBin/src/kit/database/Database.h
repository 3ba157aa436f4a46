// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/InstalledTile.h"
#include "../tile/TileBoundsSource.h"
#include "Finding.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/core/horizon/CoveredRegion.h>

#include <osg/CoordinateSystemNode>
#include <osg/Referenced>
#include <osg/observer_ptr>
#include <osgTerrain/Terrain>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

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
    /// stands; `parent`: the tile that pages it, null: none. Returns: the number of bins.
    virtual std::size_t install(osg::Node& content, const TileFrame& frame, InstalledTile* parent) = 0;
    /// Fits the loaded tiles again. `root`: the node that it is attached to. Requires: no cull traversal runs.
    virtual void refit(osg::Node& root) = 0;
    /// Has a group that got a family after bins were installed notice changes among its children.
    virtual void watch(osg::Group& group) = 0;
    /// Gives a clone of its root a database of its own.
    virtual void installOnClone(osg::Node& root) = 0;

    /// The node that the database is attached to: the CoordinateSystemNode, or, without one, the root of the scene.
    void setRoot(const osg::Node& node) { _root = &node; }
    /// Null: it is not known yet.
    [[nodiscard]] const osg::Node* root() const { return _root; }
    /// Whether bins cull at present. If not, cull traversals only look for work. Requires: no cull traversal runs.
    void setCulling(bool is) { _isCulling = is; }
    [[nodiscard]] bool isCulling() const { return _isCulling; }
    /// Whether the database is attached to this node and follows its Terrain. A cloned scene may refer to the database
    /// of the original.
    [[nodiscard]] bool isAttachedTo(const osg::Node& node) const;

    [[nodiscard]] CullOptions options() const;
    /// The same without a copy, for cull traversals: setOptions() is not called while one runs.
    [[nodiscard]] const CullOptions& optionsOfCull() const { return _options; }

    /// Replaces the options. Tiles that were installed with the old ones but are not merged into the scene yet are
    /// fitted again in the first update traversal that finds them there. Requires: no cull traversal runs.
    void setOptions(const CullOptions& options);

    /// Whether the horizon culls in place of osg::ClusterCullingCallbacks. A map has none. For cull traversals.
    [[nodiscard]] bool replacesClusters() const;

    /// How often setOptions() was called, an index was adopted, or the shape of the terrain has changed.
    [[nodiscard]] unsigned int generation() const;

    /// Call when bins are removed: files that are read from now on get none.
    void setRemoved();

    /// Records content that is not merged into the scene yet, with bins by what held in `generation`.
    /// `isAdded`: it brings tiles to a place where none were expected, because the application attaches it, or the
    /// PagedLOD that pages it is no tile. The next update after it is attached adds the tiles to the families of the
    /// groups there.
    void noteOnItsWay(osg::Node& content, unsigned int generation, bool isAdded);
    /// How often it was called.
    [[nodiscard]] unsigned int arrivals() const { return _arrivals.load(std::memory_order_relaxed); }

    /// Null: there is none, or none yet.
    [[nodiscard]] osg::ref_ptr<const BinIndex> index() const;
    /// Sets an index that is being made. When it is complete, an update adopts it: the tiles in the scene are fitted
    /// again. Null: none is made.
    void setMaking(TileBoundsSource* making);
    [[nodiscard]] osg::ref_ptr<TileBoundsSource> making() const;

    /// The present shape (vertical scale, skirts) from the Terrain, if any, and these options. Not for pager threads,
    /// because the application may change the Terrain at the same time.
    [[nodiscard]] TerrainShape shape(const CullOptions& options) const;

    /// Whether it follows this Terrain; null: none.
    [[nodiscard]] bool follows(const osgTerrain::Terrain* terrain) const { return _terrain == terrain; }

    /// Whether the Terrain, if any, has tiles blended that inherit its policy. Not for pager threads, as shape().
    [[nodiscard]] bool isTerrainBlended() const;

    /// The shape at the last update traversal, which tiles are fitted to. For any thread.
    [[nodiscard]] TerrainShape fittedShape() const;

    /// Whether update() has something to do, or will have once what is on its way is merged. The database's update
    /// callback is on its node only meanwhile: viewers that draw on demand draw frames as long as there is one.
    /// `present`: shape() of the options.
    [[nodiscard]] bool needsUpdate(const TerrainShape& present);

    /// In the update traversal: whether all loaded tiles have to be fitted again. Resets the answer.
    [[nodiscard]] bool takeShapeChange();

    /// Remembers what was found in a file, and tells the user of it the first time.
    void report(Finding finding, const std::string& file = {});
    /// The same of a tile. If the bins of the tiles above it are concerned, these stay visible until the next update,
    /// which expands their bins by what the tile draws, or, where that cannot be compared with them, takes these away.
    static void report(InstalledTile& tile, Finding finding, const AnalyticBin& drawn = {});
    [[nodiscard]] bool has(Finding finding) const {
        return (_found.load(std::memory_order_relaxed) & bitOf(finding)) != 0;
    }

    /// Says which region a regional database covers; empty: it covers the globe or has a gap.
    void setRegion(const core::GeodeticBin& region);
    /// Returns: nullopt if it covers the globe or has a gap.
    [[nodiscard]] std::optional<core::CoveredRegion> region() const;

    /// Has one of the next updates give the tile plates. `mesh`: the tile's own mesh.
    void askForPlates(const AnalyticBinCullCallback& tile, osg::Node& mesh);
    /// @{
    /// Whether tiles that are read from now on get their plates while they are read, as the last camera that looked for
    /// hidden tiles said.
    void wantPlates(bool areWanted) { _arePlatesWanted.store(areWanted, std::memory_order_relaxed); }
    [[nodiscard]] bool arePlatesWanted() const { return _arePlatesWanted.load(std::memory_order_relaxed); }
    /// @}

    /// Has the next update expand a tile's bin by what was found below it. The tile stays visible until then.
    void widen(InstalledTile& tile, const Widening& by);

    /// Call when a family was placed on a group or made anew: meshes of its tiles that have changed since bins were
    /// installed are trusted again, by new evidence. osgUtil::Optimizer may have changed their form: the new form is as
    /// good. Requires: no cull traversal runs.
    static void trustMeshes(osg::Node& group);

    /// What was reported for a tile or its descendants.
    [[nodiscard]] Widening correction(const std::string& file, std::size_t ordinal) const;

    /// In the update traversal, before takeShapeChange(): does what was asked for since the last one.
    void update();

    /// Call in cull traversals: they notice most of what there is to do.
    void noteCull() {
        _wasCulled.store(true, std::memory_order_relaxed);
        _lastCull.store(now(), std::memory_order_relaxed);
    }
    /// Whether the last cull ended a while ago, so that the processor's caches may not hold what culls read. Of several
    /// views in a frame only the first one is cold.
    [[nodiscard]] bool isCold() const {
        constexpr Clock::rep kWhile = std::chrono::duration_cast<Clock::duration>(std::chrono::milliseconds(1)).count();
        return now() - _lastCull.load(std::memory_order_relaxed) >= kWhile;
    }
    /// Whether there was a cull traversal since this was last asked.
    [[nodiscard]] bool takeCull() { return _wasCulled.exchange(false, std::memory_order_relaxed); }

    /// Expands the bins of tiles by what was found below them. Call it after bins were installed on nodes of the scene.
    /// Requires: no cull traversal runs.
    void widenLoaded();

protected:
    ~Database() override = default;

private:
    using Clock = std::chrono::steady_clock;
    [[nodiscard]] static Clock::rep now() { return Clock::now().time_since_epoch().count(); }

    using TileKey = std::pair<std::string, std::size_t>;
    struct OnItsWay {
        osg::observer_ptr<osg::Node> node;
        unsigned int generation;
        bool isAdded;
    };

    [[nodiscard]] static constexpr unsigned int bitOf(Finding finding) { return 1u << static_cast<unsigned>(finding); }
    void correct(const InstalledTile& tile, const Widening& by);
    void adoptIndex();
    void beginGeneration();
    void takeMerged(bool isForAll);
    void takeFirstMerged();
    void makePlates();
    void renewFamilies();

    const osg::observer_ptr<osgTerrain::Terrain> _terrain;
    const osg::Node* _root = nullptr;
    bool _isCulling = false;
    std::atomic<bool> _wasCulled{false};
    std::atomic<Clock::rep> _lastCull{0};  // when it ended
    std::atomic<unsigned int> _arrivals{0};
    std::atomic<bool> _arePlatesWanted{false};
    std::atomic<unsigned int> _found{0};  // a bit for each Finding
    mutable std::mutex _mutex;            // guards the members below
    CullOptions _options;
    osg::ref_ptr<const BinIndex> _index;
    osg::ref_ptr<TileBoundsSource> _making;
    std::optional<core::CoveredRegion> _region;
    TerrainShape _fittedShape;
    unsigned int _generation = 0;
    std::vector<OnItsWay> _onTheirWay;
    std::map<TileKey, Widening> _corrections;
    std::vector<osg::observer_ptr<InstalledTile>> _toWiden;
    std::vector<std::pair<osg::observer_ptr<const AnalyticBinCullCallback>, osg::observer_ptr<osg::Node>>> _awaitPlates;
};

}  // namespace osgAnalyticBin
