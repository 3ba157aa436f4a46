// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Classes.h"
#include "../database/BinReadFileCallback.h"
#include "../database/Database.h"
#include "../database/DatabaseCallbacks.h"
#include "../tile/EachNode.h"
#include "../tile/TileBoundsSource.h"
#include "BinInstaller.h"

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/CoordinateSystemNode>
#include <osg/NodeVisitor>
#include <osg/Notify>
#include <osg/PagedLOD>
#include <osgDB/Callbacks>
#include <osgDB/Registry>
#include <osgTerrain/TerrainTile>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>

namespace osgAnalyticBin {

namespace {

void reportMissing(osg::Node& node, const CullOptions& options) {
    bool hasGlobe = options.globe.has_value();
    std::size_t tiles = 0, stored = 0;
    forEachNode(node, [&](osg::Node& at) {
        hasGlobe = hasGlobe || dynamic_cast<osg::CoordinateSystemNode*>(&at);
        if (dynamic_cast<osgTerrain::TerrainTile*>(&at) || dynamic_cast<osg::PagedLOD*>(&at)) ++tiles;
        if (hasStoredBin(at)) ++stored;
    });
    // they may be added later
    if (options.globe && tiles + stored == 0) return;
    const auto missing = [&]() -> const char* {
        if (stored > 0) return "the bins stored there are not valid, or cannot be compared with what is drawn";
        if (tiles == 0)
            return "tiles are PagedLODs with a mesh, osgTerrain tiles, and nodes with setStoredBin(). Install bins "
                   "again "
                   "when there are some";
        if (hasGlobe && !options.ground.empty()) return "none of the loaded nodes has the name of the ground";
        if (hasGlobe) return "none of them has a mesh that is known to be ground";
        return "no osg::CoordinateSystemNode stands above them. Put one above them, or name the globe by the option "
               "globe="
               " (globe=wgs84) if they are in earth-centred coordinates";
    };
    OSG_NOTICE << "osgAnalyticBin: 0 tiles got bins, of " << tiles << " PagedLODs and osgTerrain tiles: " << missing()
               << ". OSG's own culling is used." << std::endl;
}

std::size_t install(osg::Node& node, const CullOptions& options, const BinIndex* index) {
    const std::size_t installed = installBelow(node, options, index, false);
    OSG_INFO << "osgAnalyticBin: " << installed << " tiles with " << toText(options) << std::endl;
    const bool wantsBins = options.method != Method::Sphere && options.method != Method::None;
    if (wantsBins && installed == 0) reportMissing(node, options);
    return installed;
}

// Tells it once: a program that adds tiles adds many.
std::size_t refuseTile(const char* why) {
    static std::atomic<bool> hasSaid{false};
    if (!hasSaid.exchange(true))
        OSG_WARN << "osgAnalyticBin: addTile(): " << why << " OSG's own culling is used there." << std::endl;
    return 0;
}

// Visits the databases that are attached to nodes of a scene.
void forEachDatabase(osg::Node& node, const std::function<void(osg::Node&, Database&)>& visit) {
    forEachNode(node, [&visit](osg::Node& at) {
        if (const osg::ref_ptr<Database> database = attachedDatabase(at)) visit(at, *database);
    });
}

bool isApplications(osgDB::ReadFileCallback* callback) {
    auto* const ours = dynamic_cast<BinReadFileCallback*>(callback);
    osgDB::ReadFileCallback* const own = ours ? ours->previous() : callback;
    return own && !isOneOf<osgDB::ReadFileCallback>(*own);
}

// Whether a callback of the application's reads the files: it may make more of them than an index of them holds.
bool isReadByApplication(osg::Node& node, const osgDB::Options* options) {
    osgDB::Registry& registry = *osgDB::Registry::instance();
    bool is = isApplications(registry.getReadFileCallback());
    const auto ask = [&is](const osgDB::Options* of) { is = is || (of && isApplications(of->getReadFileCallback())); };
    ask(registry.getOptions());
    ask(options);
    forEachNode(node, [&](osg::Node& at) {
        const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&at);
        if (paged) ask(dynamic_cast<const osgDB::Options*>(paged->getDatabaseOptions()));
    });
    return is;
}

// Starts to make an index, if tiles want one.
void makeIndex(osg::Node& node, TileBoundsSource* index) {
    bool isWanted = false;
    forEachDatabase(node, [&](osg::Node& at, Database& database) {
        // files do not tell of a globe that the options name
        const bool hasGlobe = dynamic_cast<osg::CoordinateSystemNode*>(&at);
        const bool isWantedHere = index && hasGlobe && database.has(Finding::IndexWanted);
        database.setMaking(isWantedHere ? index : nullptr);
        isWanted = isWanted || isWantedHere;
    });
    if (isWanted) index->start();
}

}  // namespace

std::size_t setCullOptions(osg::Node& node, const CullOptions& options) {
    return installBelow(node, options, nullptr, true);
}

std::size_t installBins(osg::Node& node, const CullOptions& options) {
    return installBins(node, options, {});
}

std::size_t installBins(osg::Node& node, const CullOptions& options, const std::string& databaseFileName,
                        const osgDB::Options* readOptions) {
    // an index numbers the tiles that are found without a name
    IndexUse use = options.ground.empty() ? options.index : IndexUse::Off;
    if (use == IndexUse::Auto && isReadByApplication(node, readOptions)) use = IndexUse::On;
    const ChosenIndex chosen = chooseIndex(databaseFileName, readOptions, use);
    const std::size_t installed = install(node, options, chosen.index.get());
    makeIndex(node, chosen.making.get());
    return installed;
}

std::size_t addTile(osg::Node& database, osg::Node& tile, const osg::Matrixd& parentToEcef) {
    const osg::ref_ptr<Database> attached = attachedDatabase(database);
    if (!attached) return refuseTile("the node has no bins: installBins() was not called for it, or without globe=.");
    if (tile.getNumParents() > 0) return refuseTile("a tile is attached already. Add it before it is attached.");
    const unsigned int generation = attached->generation();
    TileFrame frame;
    frame.ellipsoid = attached->ellipsoid();
    frame.localToEcef = parentToEcef;
    frame.file = tile.getName();
    frame.isBelowTile = true;  // a mesh that pages nothing is a tile
    frame.isAttached = true;
    // only the application knows what lies between its tiles
    attached->report(Finding::Gap, frame.file);
    const std::size_t installed = attached->install(tile, frame, nullptr);
    attached->noteOnItsWay(tile, generation, true);
    return installed;
}

bool isIndexAwaited(osg::Node& node) {
    bool isAwaited = false;
    forEachDatabase(node, [&isAwaited](osg::Node&, Database& database) {
        const osg::ref_ptr<TileBoundsSource> index = database.making();
        isAwaited = isAwaited || (index && !index->hasEnded());
    });
    return isAwaited;
}

bool waitForIndex(osg::Node& node, double seconds) {
    bool isWhole = true;
    forEachDatabase(node, [&](osg::Node& at, Database& database) {
        const osg::ref_ptr<TileBoundsSource> index = database.making();
        if (!index) return;
        isWhole = index->waitUntilWhole(std::chrono::duration<double>(seconds)) && isWhole;
        bringUpToDate(at, database);
    });
    return isWhole;
}

void InstallBinsCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    if (!isDone()) {
        installBins(*node, getCullOptions());
        setDone();
    }
    const osg::ref_ptr<osg::Callback> self(this);
    traverse(node, nv);
    // a clone of the node may share it
    constexpr int kOwn = 2;  // references: the node's and this one
    if (nv->getVisitorType() != osg::NodeVisitor::UPDATE_VISITOR || referenceCount() > kOwn) return;
    node->removeUpdateCallback(this);
    node->addEventCallback(this);
}

std::size_t installBinsByIndex(osg::Node& node, const CullOptions& options, const BinIndex& index) {
    return install(node, options, &index);
}

}  // namespace osgAnalyticBin
