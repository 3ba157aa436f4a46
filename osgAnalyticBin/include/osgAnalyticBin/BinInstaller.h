// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Export.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osgDB/Options>

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace osgAnalyticBin {

class BinReadFileCallback;
class Coverage;
class Database;
struct ParentTile;
struct PlanarFit;
struct TerrainShape;

/// Puts AnalyticBinCullCallbacks on the tiles of a geocentric database, switches OSG's sphere test off on them and
/// below (drawables keep their boxes), and arranges that tiles that the DatabasePager loads later are treated in the
/// pager's thread. Which nodes are tiles is TileFinder's matter; their bins come from what is stored with them, from
/// the database's index, or from their own surface and the heights that the options declare. Tiles of a map get boxes
/// in its coordinates, by callbacks of their own that files do not keep. Everything else is left
/// as it is. Method::Sphere installs no bins, and takes off those that are there, but keeps following what is paged so
/// that setCullOptions() can switch; removeBins() takes everything off. Running it again replaces what it installed
/// before.
/// A tile that is drawn in several places, and a drawable with a stored bin, are left to OSG.
/// Content of the application's: what is added below a tile while bins are installed is noticed with the next frame, be
/// it static or moving: the tile and those above are kept visible, and their bins grow to hold it in the next update
/// traversal. Content that is to be independent of tiles belongs beside them, on the CoordinateSystemNode or above it.
/// The kit learns of additions and moves from OSG's bounds. When vertices change, call dirty() of the vertex array and
/// dirtyBound() of the drawable. Tiles whose mesh the application replaces need installBins() again.
class OSGANALYTICBIN_EXPORT BinInstaller : public TileFinder {
public:
    /// Installs by these options.
    explicit BinInstaller(const CullOptions& options = {});
    ~BinInstaller() override;

    META_NodeVisitor(osgAnalyticBin, BinInstaller)

        /// The index of the database that is visited; null: none.
        void setIndex(const BinIndex* index) {
        _index = index;
    }

    /// Number of callbacks installed so far.
    [[nodiscard]] std::size_t installed() const { return _installed; }

    /// Visits a node of the database; called by OSG's traversal.
    void apply(osg::Node& node) override;
    /// Enters a globe or a map.
    void apply(osg::CoordinateSystemNode& node) override;
    /// Enters another frame.
    void apply(osg::Transform& node) override;
    /// Arranges, besides, that what is paged in later is treated.
    void apply(osg::PagedLOD& node) override;

protected:
    void visitTile(FoundTile& tile) override;
    void visitOther(osg::Node& node) override;
    void visitTooDeep(osg::Node& node) override;
    void visitMoving(osg::Transform& node) override;

private:
    friend class BinReadFileCallback;
    friend class DatabaseUpdateCallback;
    friend OSGANALYTICBIN_EXPORT std::size_t setCullOptions(osg::Node& node, const CullOptions& options);
    friend OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options,
                                                         const std::string& databaseFileName,
                                                         const osgDB::Options* readOptions);

    // What PagedLODs get for the options that they came with (null: none).
    struct Paging {
        osg::ref_ptr<osgDB::Options> options;
        BinReadFileCallback* callback = nullptr;  // the options keep it
    };
    using PagingByOptions = std::map<osg::ref_ptr<osgDB::Options>, Paging>;

    // Goes on in a file that is paged below a tile of the database (null: below none).
    void continueBelow(Database* database, const TileFrame& frame, const ParentTile* parent);
    // Fits the loaded tiles of an installed database anew.
    void refit(osg::Node& node, Database& database);
    // Looks whether the tiles of each file cover what they are paged below.
    void finish();
    void placeFamilies();

    [[nodiscard]] bool installsBins() const;
    void installAt(osg::Node& root);
    [[nodiscard]] Database& database();
    void passBy(osg::Node& node, bool isTile);
    void install(FoundTile& tile, bool hasNewContent);
    void installPlanar(FoundTile& tile, const PlanarFit& fit, const TerrainShape& shape);
    [[nodiscard]] osg::ref_ptr<ParentTile> linkTo(const FoundTile& tile);
    void noteCovered(const FoundTile& tile, const core::GeodeticBin& extents);
    void goOnBelow(const FoundTile& tile, const ParentTile& link);
    void uninstall(FoundTile& tile);
    // Whether what is visited has to fit into a bin that is stored above.
    [[nodiscard]] bool isBelowStored() const;
    // For what is below a node without a bin, which still has to fit into what is stored above. Requires: _parent.
    [[nodiscard]] osg::ref_ptr<const ParentTile> linkBetween() const;
    void followPaging(osg::PagedLOD& node, const ParentTile* parent, bool isTile);

    CullOptions _options;
    bool _keepsDatabases = false;
    bool _isReading = false;         // what the pager reads, before it is in the scene
    bool _isInMesh = false;          // within a tile's own mesh
    bool _isBelowSelection = false;  // below a node that may leave out some of its children
    osg::ref_ptr<const BinIndex> _index;
    osg::ref_ptr<Database> _database;        // that is visited
    osg::ref_ptr<Database> _refitted;        // that is about to be visited again
    osg::ref_ptr<const ParentTile> _parent;  // below which the visited node is
    PagingByOptions _paging;
    std::shared_ptr<std::map<std::string, Coverage>> _coverage;  // by file
    std::size_t _installed = 0;
    std::vector<osg::Node*> _groups;  // that may get families
};

/// Installs bins below the node. Returns: the number of callbacks installed.
OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options = {});

/// The same for the root of a database that was read from a file: its index, where there is one beside it and the
/// options allow it, tells the heights of what is not loaded yet. An index that cannot be used gives one warning.
OSGANALYTICBIN_EXPORT std::size_t installBins(osg::Node& node, const CullOptions& options,
                                              const std::string& databaseFileName,
                                              const osgDB::Options* readOptions = nullptr);

/// Says of a cull callback of the application's that it always goes on to what is nested in it or below its node, as a
/// user value "osgAnalyticBin.traversesAlways" of the callback. One that does not say so may leave out terrain, and so
/// the horizon is not used while it stands on a tile in view.
OSGANALYTICBIN_EXPORT void setTraversesAlways(osg::Callback& callback);

/// Returns: whether setTraversesAlways() was called for the callback, or it is a plain osg::NodeCallback.
[[nodiscard]] OSGANALYTICBIN_EXPORT bool traversesAlways(const osg::Callback& callback);

/// Takes bins off a node and all below it, and restores what installers changed: callbacks, culling flags, expiry
/// times, the pager's options, and groups that were put above tiles. Call it between frames. What the DatabasePager is
/// reading just now may still arrive with bins, which still cull it correctly.
OSGANALYTICBIN_EXPORT void removeBins(osg::Node& node);

/// Culls databases by other options while they are shown, Method::Sphere and Method::None among them: from the next
/// frame on, tiles are culled as if the database had been read with these options. That goes for tiles that are loaded,
/// for those that the DatabasePager is reading just now, and for those that it reads later. What was known of the
/// database (its index, tiles that did not fit it) stays known. On a database without bins: installBins().
/// Call it between frames, in the event or update phase, where no cull traversal runs; the pager may work meanwhile.
/// Guarantee: the same tiles are drawn as after reading anew; tests: SwitchedCulling.*.
/// Returns: the number of callbacks installed. Cost: as installing bins on what is loaded.
OSGANALYTICBIN_EXPORT std::size_t setCullOptions(osg::Node& node, const CullOptions& options);

}  // namespace osgAnalyticBin
