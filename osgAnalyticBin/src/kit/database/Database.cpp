// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Database.h"

#include "../CallbackChain.h"
#include "../GlmBridge.h"
#include "../cull/CullCallbacks.h"
#include "../surface/TilePlates.h"

#include <osgTerrain/GeometryTechnique>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

constexpr std::size_t kMostToWiden = 65536;

// Of a mesh that has changed.
void renewEvidence(osg::Node& mesh, const AnalyticBinCullCallback& tile, InstalledTile& installed) {
    const osg::ref_ptr<osg::Node> kept(&mesh);
    const TerrainShape shape = tile.getTerrainShape().value_or(TerrainShape());
    const osg::EllipsoidModel& ellipsoid = *installed.database().ellipsoid();
    core::MeshCover cover = groundOf({{kept}, ellipsoid, tile.getLocalToEcef(), shape}, false).cover;
    // the place of a tile that is vouched for is that of its bin, with its skirts
    const bool hasSkirts = areVouchedFor(tile.getCullOptions(), ellipsoid);
    const double share = hasSkirts ? core::MeshCover::kSkirtRoom : kPlaceRounding;
    cover.isFilled = cover.isFilled && isSamePlace(cover.place, installed.place(), share);
    cover.place = installed.place();
    installed.setCover(cover);
    const DrawnState drawn = drawnStateBelow(mesh, {tile.getCullOptions().plainShaders});
    if (!drawn.hides) installed.doubt(InstalledTile::SeeThrough);
    installed.doubtUpwards(reasonsAbove(drawn));
}

}  // namespace

bool Database::isAttachedTo(const osg::Node& node) const {
    osg::ref_ptr<osgTerrain::Terrain> terrain;
    (void)_terrain.lock(terrain);
    return _root == &node && terrain == dynamic_cast<const osgTerrain::Terrain*>(&node);
}

CullOptions Database::options() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _options;
}

void Database::setOptions(const CullOptions& options) {
    const TerrainShape present = shape(options);
    const std::lock_guard<std::mutex> lock(_mutex);
    _options = options;
    _fittedShape = present;
    beginGeneration();
}

bool Database::replacesClusters() const {
    return _options.cluster == ClusterUse::Replace && _options.method != Method::Sphere && !isMap();
}

// Requires: the lock. What is in the scene by now is not late: it is fitted again anyway.
void Database::beginGeneration() {
    takeMerged(true);
    ++_generation;
}

// Forgets what is in the scene or deleted: all of it, or what something has to be done for. Requires: the lock.
void Database::takeMerged(bool isForAll) {
    const auto isGone = [&](const OnItsWay& content) {
        const bool isLate = content.generation != _generation;
        if (!isForAll && !isLate && !content.isAdded) return false;
        osg::ref_ptr<osg::Node> node;
        if (!content.node.lock(node)) return true;
        if (node->getNumParents() == 0) return false;
        if (isLate) requestRefit();
        if (!content.isAdded) return true;
        for (osg::Group* const parent : node->getParents()) noteChanged(*parent);
        return true;
    };
    _onTheirWay.erase(std::remove_if(_onTheirWay.begin(), _onTheirWay.end(), isGone), _onTheirWay.end());
}

void Database::setRemoved() {
    noteRemoved();
    setMaking(nullptr);
}

osg::ref_ptr<const BinIndex> Database::index() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _index;
}

// The one before ends, and is waited for, without the lock.
void Database::setMaking(TileBoundsSource* making) {
    osg::ref_ptr<TileBoundsSource> replaced = making;
    const std::lock_guard<std::mutex> lock(_mutex);
    _making.swap(replaced);
}

osg::ref_ptr<TileBoundsSource> Database::making() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _making;
}

void Database::adoptIndex() {
    const osg::ref_ptr<TileBoundsSource> making = this->making();
    if (!making) return;
    making->showNotes();
    const osg::ref_ptr<const BinIndex> whole = making->whole();
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!whole || _index) return;
    _index = whole;
    beginGeneration();
    requestRefit();
}

unsigned int Database::generation() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _generation;
}

void Database::noteOnItsWay(osg::Node& content, unsigned int generation, bool isAdded) {
    _arrivals.fetch_add(1, std::memory_order_relaxed);
    const std::lock_guard<std::mutex> lock(_mutex);
    _onTheirWay.push_back({&content, generation, isAdded});
    // a database that is not drawn never processes the list
    constexpr std::size_t kMost = 4096;
    if (_onTheirWay.size() > kMost) _onTheirWay.erase(_onTheirWay.begin(), _onTheirWay.begin() + kMost / 2);
}

// Requires: the lock.
void Database::takeFirstMerged() {
    constexpr std::size_t kMany = 64;
    takeMerged(_onTheirWay.size() > kMany);
}

bool Database::needsUpdate(const TerrainShape& present) {
    osg::ref_ptr<TileBoundsSource> making;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        takeFirstMerged();
        if (isUpdateWanted() || !(present == _fittedShape)) return true;
        if (!_index) making = _making;
    }
    return making && making->hasNews();
}

TerrainShape Database::shape(const CullOptions& options) const {
    const std::optional<double>& vouchedMargin = options.techniqueMargin;
    osg::ref_ptr<osgTerrain::Terrain> terrain;
    if (!_terrain.lock(terrain)) return {1.0, 1.0, false, vouchedMargin.value_or(0.0)};
    // tiles get copies of it
    const osgTerrain::TerrainTechnique* technique = terrain->getTerrainTechniquePrototype();
    const bool isKnown = !technique || typeid(*technique) == typeid(osgTerrain::GeometryTechnique);
    return {terrain->getVerticalScale(), terrain->getSampleRatio(), terrain->getEqualizeBoundaries(),
            vouchedMargin.value_or(isKnown ? 0.0 : HUGE_VAL)};
}

bool Database::isTerrainBlended() const {
    osg::ref_ptr<osgTerrain::Terrain> terrain;
    return _terrain.lock(terrain) && terrain->getBlendingPolicy() == osgTerrain::TerrainTile::ENABLE_BLENDING;
}

TerrainShape Database::fittedShape() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _fittedShape;
}

bool Database::takeShapeChange() {
    const TerrainShape present = shape(options());
    const std::lock_guard<std::mutex> lock(_mutex);
    const bool hasChanged = !(present == _fittedShape);
    _fittedShape = present;
    if (hasChanged) beginGeneration();
    return takeRefit() || hasChanged;
}

void Database::report(Finding finding, const std::string& file) {
    if ((_found.fetch_or(bitOf(finding), std::memory_order_relaxed) & bitOf(finding)) != 0) return;
    tell(finding, file, isMap());
    if (finding == Finding::MovedTile || finding == Finding::TooDeep) report(Finding::Gap, file);
    if (finding == Finding::MovedTile) report(Finding::StrayTile, file);
}

// Told once for a database, whatever globes are inside it. The tile itself has been fitted to what is reported.
void Database::report(InstalledTile& tile, Finding finding, const AnalyticBin& drawn) {
    if (finding < Finding::OtherThanIndexed) return of(tile).report(finding, tile.file);
    const InstalledTile* outermost = &tile;
    while (outermost->parent) outermost = outermost->parent.get();
    of(*outermost).report(finding, tile.file);
    const Widening by{drawn, finding == Finding::Unverifiable};
    for (osg::ref_ptr<InstalledTile> at(&tile); at; at = at->above()) {
        if (!at->ordinal) continue;
        of(*at).correct(*at, by);
        if (at != &tile) of(*at).widen(*at, by);
    }
}

void Database::setRegion(const core::GeodeticBin& region) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _region.reset();
    if (!region.empty()) _region.emplace(toCore(*ellipsoid()), region);
}

std::optional<core::CoveredRegion> Database::region() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _region;
}

void Database::askForPlates(const AnalyticBinCullCallback& tile, osg::Node& mesh) {
    if (!tile.getInstalledTile()->askForPlates()) return;
    const std::lock_guard<std::mutex> lock(_mutex);
    _awaitPlates.emplace_back(&tile, &mesh);
    requestUpdate();
}

// Few at a time: each takes up to some milliseconds.
void Database::makePlates() {
    constexpr std::size_t kMostTiles = 4;
    for (std::size_t i = 0; i < kMostTiles; ++i) {
        osg::ref_ptr<const AnalyticBinCullCallback> tile;
        osg::ref_ptr<osg::Node> mesh;
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            if (_awaitPlates.empty()) return;
            const bool isThere = _awaitPlates.back().first.lock(tile) && _awaitPlates.back().second.lock(mesh);
            _awaitPlates.pop_back();
            if (!isThere || !tile->getInstalledTile() || !ellipsoid()) continue;
        }
        const TerrainShape shape = tile->getTerrainShape().value_or(TerrainShape());
        const TileMeshes meshes{{mesh}, *ellipsoid(), tile->getLocalToEcef(), shape};
        tile->getInstalledTile()->setPlates(groundOf(meshes, true).plates);
    }
    requestUpdate();
}

void Database::widen(InstalledTile& tile, const Widening& by) {
    const std::lock_guard<std::mutex> lock(_mutex);
    // one file may be paged in several places, and below itself
    if (tile.widening ? tile.widening->contains(by) : !by.any()) return;
    tile.doubt(InstalledTile::Outgrown);
    requestUpdate();
    // where no update traversal ever comes, tiles stay visible
    if (_toWiden.size() >= kMostToWiden) return;
    if (!tile.widening) tile.widening = std::make_unique<Widening>();
    tile.widening->expandBy(by);
    _toWiden.emplace_back(&tile);
}

// For when the file is read again. What the application attaches is looked at by itself each time.
void Database::correct(const InstalledTile& tile, const Widening& by) {
    if (tile.isAttached) return;
    const std::lock_guard<std::mutex> lock(_mutex);
    _corrections[{tile.file, *tile.ordinal}].expandBy(by);
}

Widening Database::correction(const std::string& file, std::size_t ordinal) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto known = _corrections.find({file, ordinal});
    return known == _corrections.end() ? Widening() : known->second;
}

void Database::trustMeshes(osg::Node& group) {
    const TileFamily* const family = findCallback<TileFamily>(group.getCullCallback());
    for (unsigned int i = 0; family && i < family->size(); ++i) {
        const FamilyTile& tile = family->tile(i);
        if (!tile.callback() || !tile.part(0)) continue;
        InstalledTile& installed = *tile.callback()->getInstalledTile();
        if (installed.has(InstalledTile::MeshUnread)) renewEvidence(*tile.part(0), *tile.callback(), installed);
        installed.settle(InstalledTile::MeshUnread);
    }
}

void Database::renewFamilies() {
    // each tile that has changed notes its group
    std::set<osg::ref_ptr<osg::Group>> renewed;
    for (const auto& observed : takeChanged()) {
        osg::ref_ptr<osg::Group> group;
        if (!observed.lock(group) || !renewed.insert(group).second) continue;
        TileFamily::renew(*group);
        trustMeshes(*group);
        watch(*group);
    }
}

void Database::update() {
    beginUpdate();
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        takeFirstMerged();
    }
    renewFamilies();
    makePlates();
    adoptIndex();
    widenLoaded();
}

void Database::widenLoaded() {
    decltype(_toWiden) toWiden;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        toWiden.swap(_toWiden);
    }
    for (const auto& observed : toWiden) {
        osg::ref_ptr<InstalledTile> tile;
        const osg::ref_ptr<InstalledTile> latest = observed.lock(tile) ? tile->latest() : nullptr;
        const osg::ref_ptr<osg::NodeCallback> callback = latest ? latest->callback() : nullptr;
        if (!callback) {
            // paged out, or the application has replaced its callbacks
            requestRefit();
            continue;
        }
        auto& bin = static_cast<AnalyticBinCullCallback&>(*callback);
        const std::lock_guard<std::mutex> lock(_mutex);
        bin.setBin(tile->widening->widened(bin.getBin()));
        if (latest == tile) tile->settle(InstalledTile::Outgrown);
    }
}

}  // namespace osgAnalyticBin
