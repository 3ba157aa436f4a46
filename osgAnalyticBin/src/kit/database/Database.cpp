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
#include <typeinfo>
#include <utility>

namespace osgAnalyticBin {

namespace {

constexpr std::size_t kMostToWiden = 65536;

using Contents = std::vector<osg::observer_ptr<osg::Node>>;

// Forgets what is in the scene or deleted. Calls `visit` for what is in the scene. Returns: whether there is any.
template <class Visit>
bool takeMerged(Contents& contents, const Visit& visit) {
    bool found = false;
    const auto isGone = [&](const osg::observer_ptr<osg::Node>& observed) {
        osg::ref_ptr<osg::Node> node;
        if (!observed.lock(node)) return true;
        const bool isMerged = node->getNumParents() > 0;
        if (isMerged) visit(*node);
        found = found || isMerged;
        return isMerged;
    };
    contents.erase(std::remove_if(contents.begin(), contents.end(), isGone), contents.end());
    return found;
}

bool takeMerged(Contents& contents) {
    return takeMerged(contents, [](osg::Node&) {});
}

// A database that is not drawn never processes these lists.
void keepFew(Contents& contents) {
    constexpr std::size_t kMostOnTheirWay = 4096;
    if (contents.size() > kMostOnTheirWay) contents.erase(contents.begin(), contents.begin() + kMostOnTheirWay / 2);
}

// Of a mesh that has changed.
void renewEvidence(osg::Node& mesh, const AnalyticBinCullCallback& tile, InstalledTile& installed) {
    const osg::ref_ptr<osg::Node> kept(&mesh);
    const TerrainShape shape = tile.getTerrainShape().value_or(TerrainShape());
    const osg::EllipsoidModel& ellipsoid = *installed.database().ellipsoid();
    core::MeshCover cover = coverOf({{kept}, ellipsoid, tile.getLocalToEcef(), shape});
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
    renewOnTheirWay();
}

bool Database::replacesClusters() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _options.cluster == ClusterUse::Replace && _options.method != Method::Sphere && !isMap();
}

// Requires: the lock.
void Database::renewOnTheirWay() {
    ++_generation;
    (void)takeMerged(_onTheirWay);
    _lateComers.insert(_lateComers.end(), _onTheirWay.begin(), _onTheirWay.end());
    _onTheirWay.clear();
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
    renewOnTheirWay();
    requestRefit();
}

unsigned int Database::generation() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _generation;
}

void Database::noteRead(osg::Node& content, unsigned int generation) {
    const std::lock_guard<std::mutex> lock(_mutex);
    Contents& contents = generation == _generation ? _onTheirWay : _lateComers;
    contents.emplace_back(&content);
    keepFew(contents);
}

void Database::noteAdded(osg::Node& tile, unsigned int generation) {
    noteRead(tile, generation);
    const std::lock_guard<std::mutex> lock(_mutex);
    _added.emplace_back(&tile);
    keepFew(_added);
}

void Database::findLateComers() {
    constexpr std::size_t kMany = 64;
    const std::lock_guard<std::mutex> lock(_mutex);
    if (_onTheirWay.size() > kMany) (void)takeMerged(_onTheirWay);
    if (!_lateComers.empty() && takeMerged(_lateComers)) requestRefit();
    (void)takeMerged(_added, [this](osg::Node& tile) {
        for (osg::Group* const parent : tile.getParents()) noteChanged(*parent);
    });
}

bool Database::needsUpdate() {
    findLateComers();
    const osg::ref_ptr<TileBoundsSource> making = this->making();
    return isUpdateWanted() || (making && making->isWhole() && !index()) || !(shape(options()) == fittedShape());
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

TerrainShape Database::fittedShape() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _fittedShape;
}

bool Database::takeShapeChange() {
    const TerrainShape present = shape(options());
    const std::lock_guard<std::mutex> lock(_mutex);
    const bool hasChanged = !(present == _fittedShape);
    _fittedShape = present;
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
    for (InstalledTile* at = &tile; at; at = at->parent.get()) {
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
    report(Finding::PlatesWanted);
    if (!tile.getInstalledTile()->askForPlates()) return;
    const std::lock_guard<std::mutex> lock(_mutex);
    _awaitPlates.emplace_back(&tile, &mesh);
    requestUpdate();
}

// Some at a time: each takes up to some milliseconds.
void Database::makePlates() {
    constexpr std::size_t kMostTiles = 8;
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
        tile->getInstalledTile()->setPlates(tilePlates({{mesh}, *ellipsoid(), tile->getLocalToEcef(), shape}));
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

void Database::correct(const InstalledTile& tile, const Widening& by) {
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
    for (const auto& observed : takeChanged()) {
        osg::ref_ptr<osg::Group> group;
        if (!observed.lock(group)) continue;
        TileFamily::renew(*group);
        trustMeshes(*group);
        watch(*group);
    }
}

void Database::update() {
    beginUpdate();
    findLateComers();
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
        const osg::ref_ptr<osg::NodeCallback> callback = observed.lock(tile) ? tile->callback() : nullptr;
        if (!callback) {
            // paged out, or fitted anew while the tile was on its way
            requestRefit();
            continue;
        }
        auto& bin = static_cast<AnalyticBinCullCallback&>(*callback);
        const std::lock_guard<std::mutex> lock(_mutex);
        bin.setBin(tile->widening->widened(bin.getBin()));
        tile->settle(InstalledTile::Outgrown);
    }
}

}  // namespace osgAnalyticBin
