// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osgDB/Options>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace osgAnalyticBin {

class BinReadFileCallback;
struct AwaitingTile;
class Coverage;
struct TileFit;
class Database;
struct ParentTile;

/// Visits the loaded part of a database and installs bins on it, as installBins() promises.
class BinInstaller : public TileFinder {
public:
    /// Installs by these options.
    explicit BinInstaller(const CullOptions& options = {});
    ~BinInstaller() override;

    META_NodeVisitor(osgAnalyticBin, BinInstaller)

        /// The index of the database that is visited; null: none.
        void setIndex(const BinIndex* index) {
        _index = index;
    }

    /// Installs bins below the root of a scene or a database.
    void installAt(osg::Node& root);

    /// Number of callbacks installed so far.
    [[nodiscard]] std::size_t installed() const { return _installed + _boxes; }

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
    // Looks whether the tiles of each file cover what they are paged below. `content`: what was read; null: a scene.
    void finish(osg::Node* content = nullptr);
    // Has others see the tiles.
    void publishTiles(osg::Node* content);
    void placeFamilies();

    [[nodiscard]] bool installsBins() const;
    [[nodiscard]] Database& database();
    void passBy(osg::Node& node, bool isTile);
    void visitSet(osg::Group& set);
    void install(FoundTile& tile, bool hasNewContent);
    [[nodiscard]] osg::ref_ptr<ParentTile> linkTo(const FoundTile& tile);
    void noteCovered(const FoundTile& tile, const TileFit& fit, const ParentTile& link);
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
    std::size_t _boxes = 0;                        // of photogrammetry sets
    std::vector<osg::Node*> _groups;               // that may get families
    std::vector<osg::ref_ptr<ParentTile>> _links;  // of tiles that it has installed bins on
    std::vector<AwaitingTile> _awaiting;
};

}  // namespace osgAnalyticBin
