// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinInstaller.h"

#include "../CallbackChain.h"
#include "../Classes.h"
#include "../PagedChildren.h"
#include "../Scoped.h"
#include "../cull/CullCallbacks.h"
#include "../cull/DrawnState.h"
#include "../cull/ForeignCallbacks.h"
#include "../cull/InstalledBin.h"
#include "../cull/TileFamily.h"
#include "../database/BinReadFileCallback.h"
#include "../database/Database.h"
#include "../database/DatabaseCallbacks.h"
#include "../surface/TilePlates.h"
#include "../tile/Carrier.h"
#include "../tile/EachNode.h"
#include "../tile/InstalledTile.h"
#include "ContentWatch.h"
#include "Coverage.h"
#include "DeclaredHorizon.h"
#include "NoCulling.h"
#include "SetInstaller.h"
#include "TileCallback.h"
#include "TileFit.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/TileFinder.h>

#include <osg/Notify>
#include <osg/PagedLOD>
#include <osgDB/Registry>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin {

namespace {

// OSG draws a drawable regardless of what its callbacks decide.
void warnOfDrawable(const osg::Node& node) {
    OSG_WARN << "osgAnalyticBin: the drawable \"" << node.getName()
             << "\" has a stored bin; drawables are not culled by bins. Store it with the group above." << std::endl;
}

// What the application says of the frame of the node that bins are installed on.
TileFrame frameBy(const CullOptions& options) {
    TileFrame frame;
    if (options.globe)
        frame.ellipsoid = new osg::EllipsoidModel(options.globe->equatorialRadius(), options.globe->polarRadius());
    return frame;
}

bool isGlobeBroken(const osg::CoordinateSystemNode& node) {
    return node.getEllipsoidModel() && !hasValidRadii(*node.getEllipsoidModel());
}

// Whether a globe is the same as that of the nodes above it.
bool isSameGlobe(const TileFrame& above, const TileFrame& inside) {
    if (!above.ellipsoid || !inside.ellipsoid || above.isProjected || inside.isProjected) return false;
    return above.localToEcef.isIdentity() &&
           above.ellipsoid->getRadiusEquator() == inside.ellipsoid->getRadiusEquator() &&
           above.ellipsoid->getRadiusPolar() == inside.ellipsoid->getRadiusPolar();
}

// Nobody knows the terrain of a part that has no bins any more.
void reportGapAbove(const osg::Node& part) {
    for (osg::Group* const parent : part.getParents()) {
        if (Database* const database = attachedDatabase(*parent)) database->report(Finding::Gap);
        reportGapAbove(*parent);
    }
}

// Whether a subgraph that the installer does not search has nodes that look like tiles.
bool hasTileBelow(osg::Node& subgraph) {
    bool has = false;
    forEachNode(subgraph, [&has](osg::Node& node) {
        has = has || hasStoredBin(node) || dynamic_cast<osg::PagedLOD*>(&node) ||
              dynamic_cast<osgTerrain::TerrainTile*>(&node);
    });
    return has;
}

// Installs bins on the loaded part of a database; see installBins().
class BinInstaller : public TileFinder {
public:
    explicit BinInstaller(const CullOptions& options, const BinIndex* index = nullptr, bool keepsDatabases = false)
        : TileFinder(frameBy(options), options.ground),
          _options(options),
          _keepsDatabases(keepsDatabases),
          _index(index),
          _coverage(std::make_shared<Coverages>()) {}
    ~BinInstaller() override { takeOff(_nested); }
    META_NodeVisitor(osgAnalyticBin, BinInstaller);

    // Number of callbacks installed so far.
    [[nodiscard]] std::size_t installed() const { return _installed + _lods; }

    // Tiles that no CoordinateSystemNode stands above, and those that are paged in later, are brought up to date from
    // the root.
    void installAt(osg::Node& root) {
        // these have databases of their own
        const bool isGlobe = dynamic_cast<osg::CoordinateSystemNode*>(&root) || isPhotogrammetrySet(root);
        if (!isGlobe && _keepsDatabases) _database = attachedDatabase(root);
        if (!isGlobe && !_keepsDatabases) removeDatabase(root);
        if (!isGlobe && !installsBins()) reportGapAbove(root);
        if (_database) _database->setOptions(_options);
        const bool isNamed = !isGlobe && _options.globe;
        if (isNamed) beginNamedGlobe(root);
        root.accept(*this);
        if (_options.method == Method::None) {
            takeOffFirst<NoCulling>(root);
            const osg::ref_ptr<NoCulling> callback = new NoCulling;
            putInFront(root, *callback);
        }
        // the tiles of a globe without any are still to come
        if (isNamed && _installed == 0 && _paging.empty()) _coverage->clear();
        finish();
        // tiles may be added also while other methods cull
        if (!isGlobe && _database && (installsBins() || isNamed)) attach(root, *_database, isNamed && installsBins());
    }

    void apply(osg::Node& node) override {
        const DeclaredHorizon horizon(node, _options);
        TileFinder::apply(node);
    }

    void apply(osg::Transform& node) override {
        const DeclaredHorizon horizon(node, _options);
        TileFinder::apply(node);
    }

    void apply(osg::PagedLOD& node) override {
        const DeclaredHorizon horizon(node, _options);
        const Scoped inMesh(_isInMesh, false);
        TileFinder::apply(node);
    }

    void apply(osg::CoordinateSystemNode& node) override {
        const DeclaredHorizon horizon(node, _options);
        const bool isForeign = _parent && !isSameGlobe(frame(), frameInside(node));
        if (isForeign && installsBins()) Database::report(*recordBetween(), Finding::Unverifiable);
        const bool isBroken = installsBins() && isGlobeBroken(node);
        const Scoped method(_options.method, isBroken ? Method::Sphere : _options.method);
        if (isBroken) {
            OSG_WARN << "osgAnalyticBin: the radii of the globe \"" << node.getName() << "\" in \"" << frame().file
                     << "\" are not two positive numbers; nodes below it get no bins." << std::endl;
        }
        const Scoped parent(_parent, isForeign ? nullptr : _parent);
        const bool isRefit = _refitted.valid();
        osg::ref_ptr<Database> own = isRefit || !_keepsDatabases ? _refitted : databaseOf(node);
        if (own && !own->isAttachedTo(node)) own = nullptr;
        const bool isKept = !isRefit && own;
        _refitted = nullptr;
        if (isKept) own->setOptions(_options);
        const osg::ref_ptr<Database> replaced = databaseOf(node);
        const bool hasMovedTile = replaced && replaced->has(Finding::MovedTile);
        if (!isRefit && replaced && replaced != own && replaced->isAttachedTo(node)) replaced->setRemoved();
        if (!isRefit) detachDatabase(node);
        if (!own) {
            const osg::ref_ptr<osg::EllipsoidModel> ellipsoid =
                node.getEllipsoidModel() && !isGlobeBroken(node) ? node.getEllipsoidModel() : new osg::EllipsoidModel;
            own = newDatabase(ellipsoid.get(), dynamic_cast<osgTerrain::Terrain*>(&node));
            own->setRoot(node);
            // new bins do not tell where a tile stood before
            if (hasMovedTile) own->report(Finding::MovedTile, frame().file);
        }
        const Scoped index(_index, isKept ? own->index() : _index);
        const Scoped database(_database, own);
        const Scoped paging(_paging, PagedReads());
        const Scoped coverage(_coverage, std::make_shared<Coverages>());
        (*_coverage)[{nullptr, frame().file}].expectGlobe();
        const std::size_t before = _installed;
        TileFinder::apply(node);
        // photogrammetry alone is no globe with gaps, and neither is one whose tiles are still to come
        if (!isKept && _installed == before && _paging.empty()) _coverage->clear();
        finish();
        if (isRefit) return;
        const bool hasTiles = _installed > before || !_paging.empty() || _options.globe;
        if (installsBins() && hasTiles) return attach(node, *own, true);
        // tiles that are on their way may have bins
        if (isKept) attach(node, *own, false);
    }

protected:
    void visitTile(FoundTile& tile) override {
        const bool hasNewContent = ContentWatch::hasNewContent(*tile.node);
        const osg::ref_ptr<InstalledTile> before = recordOf(*tile.node);
        // the new bin is where the tile stands now; there is a gap where it stood
        if (before && before->has(InstalledTile::MeshMoved)) database().report(Finding::MovedTile, tile.frame.file);
        removeCallbacks(tile, _nested);
        takeOffFirst<NoCulling>(*tile.node);
        if (installsBins() && mayHaveBin(tile)) return install(tile, hasNewContent, before.get());
        visitWithoutBin(*tile.node, true);
    }

    void visitOther(osg::Node& node) override {
        if (isPhotogrammetrySet(node)) return visitSet(*node.asGroup());
        if (node.asDrawable() && hasStoredBin(node)) warnOfDrawable(node);
        // it may have been a tile when bins were last installed
        if (installedTileOf(node) && !dynamic_cast<Carrier*>(&node))
            removeCallbacks({&node, {}, frame(), 0, {}}, _nested);
        // some groups compute their bounds without their children
        const bool mayKeepSilent = !drawsAllChildren(node) || node.getComputeBoundingSphereCallback();
        const bool isRoot = _database && _database->root() == &node;
        if (installsBins() && node.asGroup() && !_isInMesh && (_parent || mayKeepSilent || isRoot)) {
            ContentWatch::place(node, {}, _parent, _parent);
        } else {
            ContentWatch::remove(node);
        }
        TileFamily::remove(node);
        const bool isInMesh = _isInMesh && !isExactly<osg::Group>(node);
        if (installsBins() && !isInMesh && TileFamily::isPossibleOn(node)) _groups.emplace_back(&node);
        noteBetween(node);
        visitWithoutBin(node, false);
    }

    void visitMoving(osg::Transform& node) override {
        if (isPhotogrammetrySet(node)) return visitSet(node);
        removeCallbacksBelow(node, _nested);
        if (installsBins()) tellAbove(drawnStateBelow(node, stateRules()));
        if (installsBins() && hasTileBelow(node)) database().report(Finding::StrayTile, frame().file);
    }

    // It keeps OSG's own culling; how deep it lies is not known.
    void visitTooDeep(osg::Node&) override {
        if (installsBins()) database().report(Finding::TooDeep, frame().file);
    }

private:
    // The database whose tiles this installer puts bins on.
    class InstallingDatabase final : public Database {
    public:
        using Database::Database;

        std::size_t install(osg::Node& content, const TileFrame& frame, InstalledTile* parent) override {
            BinInstaller installer(options());
            installer.continueBelow(this, frame, parent);
            content.accept(installer);
            installer.finish();
            return installer.installed();
        }
        void watch(osg::Group& group) override { watchFamily(group); }
        void refit(osg::Node& root) override {
            BinInstaller installer(options());
            installer.refit(root, *this);
        }
        void installOnClone(osg::Node& root) override {
            BinInstaller installer(options(), index().get());
            installer.installAt(root);
            if (const osg::ref_ptr<Database> own = attachedDatabase(root)) own->setMaking(making().get());
        }

    protected:
        ~InstallingDatabase() override = default;
    };

    // Prepares for a file that is paged below a tile of the database (`parent` null: below no tile).
    void continueBelow(Database* database, const TileFrame& frame, InstalledTile* parent) {
        setFrame(frame);
        _isReading = true;
        _database = database;
        _index = database->index();
        _parent = parent;
        if (!parent || !parent->ordinal) return;
        Coverage& coverage = (*_coverage)[{parent, frame.file}];
        coverage.expect(*parent);
        coverage.setVisited();
    }

    // Makes the root of a scene without a CoordinateSystemNode that of CullOptions::globe.
    void beginNamedGlobe(osg::Node& root) {
        if (!_database) _database = newDatabase(frame().ellipsoid, nullptr);
        _database->setRoot(root);
        (*_coverage)[{nullptr, frame().file}].expectGlobe();
    }

    // Fits the loaded tiles of an installed database again.
    void refit(osg::Node& node, Database& database) {
        _index = database.index();
        // globes keep their databases
        _keepsDatabases = true;
        if (dynamic_cast<osg::CoordinateSystemNode*>(&node)) {
            _refitted = &database;
        } else {
            _database = &database;
        }
        node.accept(*this);
        placeFamilies();
        database.widenLoaded();
        _refitted = nullptr;
    }

    // Checks whether the tiles of each file cover their parent.
    void finish() {
        for (const auto& [file, coverage] : *_coverage) {
            if (installsBins()) coverage.report(file.second, database());
        }
        _coverage->clear();
        placeFamilies();
        if (!_isReading && _database) _database->widenLoaded();
    }

    // Called after the walk: families that are placed during it would need more stack in deep scenes. From below
    // upwards.
    void placeFamilies() {
        for (auto at = _groups.rbegin(); at != _groups.rend(); ++at) {
            osg::Group& group = *(*at)->asGroup();
            if (!TileFamily::place(group, _isReading && !_parent)) continue;
            Database::trustMeshes(group);
            watchFamily(group);
        }
        _groups.clear();
    }

    // The database's cull callback notices where the application takes the watch of the root away.
    static void attach(osg::Node& root, Database& database, bool isCulling) {
        if (isCulling && !ContentWatch::isOn(root)) ContentWatch::place(root, {}, nullptr, nullptr);
        attachDatabase(root, database, isCulling);
    }

    static void watchFamily(osg::Group& group) {
        if (TileFamily::needsWatch(group) && !ContentWatch::isOn(group))
            ContentWatch::place(group, {}, nullptr, nullptr);
    }

    [[nodiscard]] bool installsBins() const {
        return _options.method != Method::Sphere && _options.method != Method::None;
    }

    [[nodiscard]] Database& database() {
        if (!_database) _database = newDatabase(new osg::EllipsoidModel, nullptr);
        return *_database;
    }

    [[nodiscard]] osg::ref_ptr<Database> newDatabase(const osg::EllipsoidModel* ellipsoid,
                                                     osgTerrain::Terrain* terrain) const {
        return new InstallingDatabase(_options, ellipsoid, terrain, _index.get());
    }

    // Tells the database why not.
    [[nodiscard]] bool mayHaveBin(const FoundTile& tile) {
        const bool isForeign = isOfOtherTerrain(tile, database());
        if (isForeign && _parent) Database::report(*recordBetween(), Finding::Unverifiable);
        if (isForeign || isInstanced(*tile.node, tile.frame, database().root())) {
            database().report(Finding::StrayTile, tile.frame.file);
            return false;
        }
        const osg::EllipsoidModel* const ground = tile.frame.ellipsoid.get();
        if (hasStoredBin(*tile.node)) return !ground || database().decideGround(*ground);
        const bool isOnGlobe = ground && !isMapPlane(*ground);
        if (!isOnGlobe && isBelowStored()) Database::report(*recordBetween(), Finding::Unverifiable);
        return ground && database().decideGround(*ground);
    }

    // Of a node that is no tile. Not inlined, to leave stack for scenes that are nested deep.
    [[gnu::noinline]] void noteBetween(const osg::Node& node) const {
        if (installsBins() && _parent && !_isInMesh) tellAbove(drawnStateAt(node, stateRules()));
    }

    // Tells the tiles above of something below them.
    // What stands above all tiles is asked in every cull traversal.
    void tellAbove(const DrawnState& drawn) const {
        if (_parent) _parent->doubtUpwards(reasonsAbove(drawn));
    }

    [[nodiscard]] StateRules stateRules() const { return {_options.plainShaders}; }

    void visitWithoutBin(osg::Node& node, bool isTile) {
        if (auto* paged = dynamic_cast<osg::PagedLOD*>(&node))
            _paging.follow(*paged, frame(), database(), isBelowStored() ? recordBetween().get() : nullptr, isTile);
        takeOffFirst<NoCulling>(node);
        // a tile's own meshes are not visited
        if (isTile && installsBins()) tellAbove(drawnStateOfTile(node));
        const Scoped selective(_isBelowSelection, _isBelowSelection || (!isTile && !drawsAllChildren(node)));
        traverseBelow(node);
    }

    [[nodiscard]] DrawnState drawnStateOfTile(osg::Node& node) const {
        DrawnState drawn = drawnStateAt(node, stateRules());
        const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&node);
        for (unsigned int i = 0; paged && i < paged->getNumChildren(); ++i) {
            if (!isPaged(*paged, i)) drawn &= drawnStateBelow(*node.asGroup()->getChild(i), stateRules());
        }
        return drawn;
    }

    // Also below other nodes.
    void visitSet(osg::Group& set) {
        removeCallbacksBelow(set, _nested);
        _lods += installOnSet(set, _options);
    }

    // `before`: the tile's record until now; null: none.
    void install(FoundTile& tile, bool hasNewContent, InstalledTile* before) {
        const osg::EllipsoidModel& ellipsoid = tile.frame.ellipsoid ? *tile.frame.ellipsoid : *database().ellipsoid();
        const TerrainShape shape = database().fittedShape();
        const FitSources sources{database().options(),
                                 ellipsoid,
                                 database().index(),
                                 _parent.get(),
                                 database().correction(tile.frame.file, tile.ordinal),
                                 hasNewContent};
        const TileFit fit = fitTile(tile, sources, shape);
        const osg::ref_ptr<InstalledTile> installed =
            new InstalledTile(database(), _parent.get(), tile.frame, tile.ordinal);
        installed->extents = fit.extents;
        installed->stored = fit.stored;
        for (const auto& [finding, drawn] : fit.findings) Database::report(*installed, finding, drawn);
        if (!fit.isTerrain || !isGround(tile, _parent.get(), fit)) return visitWithoutBin(*tile.node, true);

        const osg::ref_ptr<AnalyticBinCullCallback> callback =
            new AnalyticBinCullCallback(fit.bin, ellipsoid, _options);
        osg::Node& culled = culledNode(tile, _isReading);
        if (const osg::Matrixd frame = culledFrame(tile, culled); !frame.isIdentity()) callback->setLocalToEcef(frame);
        if (fit.isScalable) callback->setTerrainShape(shape);
        if (fit.skirt > 0.0) callback->setSkirt(fit.skirt);
        callback->setSurface(fit.surface);
        placeCallback(tile, culled, *callback, *installed);
        if (fit.isDeclared) installed->doubt(InstalledTile::Declared);
        const bool canWait = tile.meshes.size() == 1 && !culled.asTransform();
        const bool withPlates = !canWait || _options.occlusion == OcclusionUse::On || database().arePlatesWanted();
        ++_installed;
        noteDrawn(tile, *installed);
        noteGround(tile, {tile.meshes, ellipsoid, tile.frame.localToEcef, shape}, withPlates,
                   coverWithoutMesh(sources, fit), *installed);
        noteCovered(tile, fit, *installed);
        if (before && &before->database() == _database) before->setSuccessor(*installed);
        visitChildren(tile, *installed);
    }

    // A tile that the application has added to a database with gaps, where the horizon is not given, hides nothing: its
    // mesh is not looked at so closely.
    // `known`: what the tile is taken to cover whatever its mesh is.
    void noteGround(const FoundTile& tile, const TileMeshes& meshes, bool withPlates,
                    const std::optional<core::MeshCover>& known, InstalledTile& installed) {
        const bool isBelowNone = _isReading && !_parent;
        const bool isGiven = database().options().horizonUse == HorizonUse::Given;
        const bool hidesNothing = isBelowNone && !isGiven && database().has(Finding::Gap);
        TileGround ground;
        if (withPlates || !(known || hidesNothing)) ground = groundOf(meshes, withPlates);
        if (withPlates) installed.setPlates(std::move(ground.plates));
        if (hidesNothing) return;
        const core::MeshCover& cover = known ? *known : ground.cover;
        installed.setCover(cover);
        if (!cover.isFilled) database().report(Finding::Hole, tile.frame.file);
    }

    // Whether an ancestor of the visited node has a stored bin, which must contain it.
    [[nodiscard]] bool isBelowStored() const { return _parent && _parent->stored.valid(); }

    // A record for nodes below one without a bin: the stored bin of an ancestor must contain them as well. Requires:
    // _parent.
    [[nodiscard]] osg::ref_ptr<InstalledTile> recordBetween() {
        const osg::ref_ptr<InstalledTile> record = new InstalledTile(database(), _parent.get(), frame(), std::nullopt);
        record->stored = _parent->stored;
        return record;
    }

    // Tiles within the mesh of another cover nothing beside it. A file that is loaded may hold no tiles at all.
    void noteCovered(const FoundTile& tile, const TileFit& fit, InstalledTile& installed) {
        Coverage& coverage = (*_coverage)[{_parent.get(), tile.frame.file}];
        coverage.setVisited();
        if (!_isBelowSelection && !_isInMesh) coverage.add(installed.place(), fit.isInPlace);
        const auto* const paged = dynamic_cast<const osg::PagedLOD*>(tile.node.get());
        for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i) {
            if (!isPaged(*paged, i)) continue;
            Coverage& below = (*_coverage)[{&installed, pagedFilePath(tile.frame.file, paged->getFileName(i))}];
            below.expect(installed);
            if (i < paged->getNumChildren()) below.setVisited();
        }
    }

    void noteDrawn(const FoundTile& tile, InstalledTile& installed) {
        DrawnState drawn = drawnStateOf(*tile.node, stateRules());
        for (const auto& mesh : tile.meshes) drawn &= drawnStateBelow(*mesh, stateRules());
        // a class of the application's may show anything of a tile
        const bool isPaged = dynamic_cast<const osg::PagedLOD*>(tile.node.get());
        if (isPaged && !isOneOf<osg::PagedLOD>(*tile.node)) drawn.hides = drawn.obeysDepth = false;
        // for the tiles above: that of the tile itself is asked for in each view
        drawn.obeysDepth = drawn.obeysDepth && !hasForeignCallback<AnalyticBinCullCallback>(*tile.node);
        if (!drawn.hides) installed.doubt(InstalledTile::SeeThrough);
        installed.doubtUpwards(reasonsAbove(drawn));
    }

    void visitChildren(const FoundTile& tile, InstalledTile& installed) {
        auto* const paged = dynamic_cast<osg::PagedLOD*>(tile.node.get());
        if (paged) _paging.follow(*paged, frame(), database(), &installed, true);
        const Scoped inMesh(_isInMesh, !paged);
        const Scoped below(_parent, osg::ref_ptr<InstalledTile>(&installed));
        traverseBelow(*tile.node);
    }

    CullOptions _options;
    bool _keepsDatabases;
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

}  // namespace

std::size_t installBelow(osg::Node& root, const CullOptions& options, const BinIndex* index, bool keepsDatabases) {
    BinInstaller installer(options, index, keepsDatabases);
    installer.installAt(root);
    if (installer.installed() > 0) TileFamily::expectTilesBelow(root);
    return installer.installed();
}

}  // namespace osgAnalyticBin
