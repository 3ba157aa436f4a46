// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../cull/DrawnState.h"
#include "../database/BinReadFileCallback.h"
#include "TileCallback.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osgDB/Options>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace osgTerrain {
class Terrain;
}

namespace osgAnalyticBin {

class Coverage;
class InstalledTile;
struct FitSources;
struct TileFit;
class Database;

/// Installs bins on the loaded part of a database; see installBins().
class BinInstaller : public TileFinder {
public:
    /// `options`: what to install.
    explicit BinInstaller(const CullOptions& options = {});
    ~BinInstaller() override;

    META_NodeVisitor(osgAnalyticBin, BinInstaller)

        /// The index of the database that is visited; null: none.
        void setIndex(const BinIndex* index) {
        _index = index;
    }

    /// Has databases that are there keep what they know.
    void keepDatabases() { _keepsDatabases = true; }

    /// Installs bins below the root of a scene or a database.
    void installAt(osg::Node& root);

    /// Number of callbacks installed so far.
    [[nodiscard]] std::size_t installed() const { return _installed + _lods; }

    /// Visits a node of the database; called by OSG's traversal.
    void apply(osg::Node& node) override;
    /// Begins a globe or a map.
    void apply(osg::CoordinateSystemNode& node) override;
    /// Applies the transform to the frame of the tiles below.
    void apply(osg::Transform& node) override;
    /// Also sets a read callback, which installs bins on the tiles that are paged in later.
    void apply(osg::PagedLOD& node) override;

protected:
    void visitTile(FoundTile& tile) override;
    void visitOther(osg::Node& node) override;
    void visitTooDeep(osg::Node& node) override;
    void visitMoving(osg::Transform& node) override;

private:
    class InstallingDatabase;

    // Prepares for a file that is paged below a tile of the database (`parent` null: below no tile).
    void continueBelow(Database* database, const TileFrame& frame, InstalledTile* parent);
    // Makes the root of a scene without a CoordinateSystemNode that of CullOptions::globe.
    void beginNamedGlobe(osg::Node& root);
    // Fits the loaded tiles of an installed database again.
    void refit(osg::Node& node, Database& database);
    // Checks whether the tiles of each file cover their parent.
    void finish();
    void placeFamilies();
    static void watchFamily(osg::Node& group);

    [[nodiscard]] bool installsBins() const;
    [[nodiscard]] Database& database();
    [[nodiscard]] osg::ref_ptr<Database> newDatabase(const osg::EllipsoidModel* ellipsoid,
                                                     osgTerrain::Terrain* terrain) const;
    void visitWithoutBin(osg::Node& node, bool isTile);
    void visitSet(osg::Group& set);
    void install(FoundTile& tile, bool hasNewContent);
    void noteCovered(const FoundTile& tile, const TileFit& fit, InstalledTile& installed);
    void noteCover(const FoundTile& tile, const FitSources& sources, const TileFit& fit, InstalledTile& installed);
    void noteDrawn(const FoundTile& tile, InstalledTile& installed);
    [[nodiscard]] DrawnState drawnStateOfTile(osg::Node& node) const;
    // Of a node that is no tile. Not inlined, to leave stack for scenes that are nested deep.
    [[gnu::noinline]] void noteBetween(const osg::Node& node) const;
    // Tells the tiles above of something below them.
    void tellAbove(const DrawnState& drawn) const;
    [[nodiscard]] StateRules stateRules() const { return {_options.plainShaders}; }
    void visitChildren(const FoundTile& tile, InstalledTile& installed);
    // Tells the database why not.
    [[nodiscard]] bool mayHaveBin(const FoundTile& tile);
    // Whether an ancestor of the visited node has a stored bin, which must contain it.
    [[nodiscard]] bool isBelowStored() const;
    // A record for nodes below one without a bin: the stored bin of an ancestor must contain them as well. Requires:
    // _parent.
    [[nodiscard]] osg::ref_ptr<InstalledTile> recordBetween();

    CullOptions _options;
    bool _keepsDatabases = false;
    bool _isReading = false;         // the content of a file, not merged into the scene yet
    bool _isInMesh = false;          // within a tile's own mesh
    bool _isBelowSelection = false;  // below a node that may not draw all of its children
    osg::ref_ptr<const BinIndex> _index;
    osg::ref_ptr<Database> _database;     // the visited one
    osg::ref_ptr<Database> _refitted;     // about to be fitted again
    osg::ref_ptr<InstalledTile> _parent;  // the parent tile of the visited node
    PagedReads _paging;
    // By the tile that pages the file (null: none) and the file's name, which may be the same for several tiles.
    using Coverages = std::map<std::pair<const InstalledTile*, std::string>, Coverage>;
    std::shared_ptr<Coverages> _coverage;
    std::size_t _installed = 0;
    std::size_t _lods = 0;            // of photogrammetry sets
    std::vector<osg::Node*> _groups;  // candidates for families
    NestedCallbacks _nested;          // taken off when the installer is done
};

}  // namespace osgAnalyticBin
