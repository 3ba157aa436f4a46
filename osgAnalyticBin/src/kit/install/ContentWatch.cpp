// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ContentWatch.h"

#include "../Classes.h"
#include "../PagedChildren.h"
#include "../Spheres.h"
#include "../cull/InstalledBin.h"
#include "../cull/TileFamily.h"
#include "../database/Database.h"
#include "../database/DatabaseCallbacks.h"
#include "../surface/SurfaceWalk.h"
#include "../surface/TilePlates.h"
#include "../tile/Carrier.h"
#include "../tile/InstalledTile.h"
#include "ContentFit.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>

#include <osg/CoordinateSystemNode>
#include <osg/Group>
#include <osg/LOD>
#include <osg/PagedLOD>
#include <osg/Transform>

#include <algorithm>
#include <optional>

namespace osgAnalyticBin {

namespace {

// A group with thousands of children asks for the watch of each, and a dynamic_cast takes long.
const ContentWatch* watchOf(const osg::Node& node) {
    const auto* const callback = node.getComputeBoundingSphereCallback();
    if (!callback || isExactly<ContentWatch>(*callback)) return static_cast<const ContentWatch*>(callback);
    return dynamic_cast<const ContentWatch*>(callback);
}

// Whether a node is in the scene of a database.
bool isBelowDatabase(const osg::Node& node) {
    const bool isRoot = dynamic_cast<const osg::CoordinateSystemNode*>(&node) ||
                        attachedDatabase(const_cast<osg::Node&>(node)) != nullptr;
    return isRoot || std::any_of(node.getParents().begin(), node.getParents().end(),
                                 [](const osg::Group* parent) { return isBelowDatabase(*parent); });
}

// Whether a tile has to hold what stands among the node's children.
bool isInTile(const osg::Node& node) {
    return installedTileOf(node) || std::any_of(node.getParents().begin(), node.getParents().end(),
                                                [](const osg::Group* parent) { return isInTile(*parent); });
}

// About what a tile's bin holds, in the frame above the tile. Not valid: it is not known.
osg::BoundingSphere sphereOfBin(const osg::Node& node) {
    const AnalyticBinCullCallback* const tile = installedBinOf(node);
    const AnalyticBin shown = tile ? tile->shownBin() : AnalyticBin();
    if (!shown.valid() || node.asTransform()) return {};
    const osg::BoundingSphere sphere = shown.boundingSphere(*tile->getInstalledTile()->database().ellipsoid());
    return movedSphere(sphere, osg::Matrixd::inverse(tile->getLocalToEcef()));
}

// Whether a tile of osgTerrain is drawn in a vertical scale, which OSG's own bound is made without.
bool isScaledTerrain(const osg::Node& node) {
    const AnalyticBinCullCallback* const tile = installedBinOf(node);
    return tile && tile->getTerrainShape() && tile->getTerrainShape()->verticalScale != 1.0;
}

// Whether the application has set the sphere of a level of detail so that it may not hold what is loaded there. Where
// the level is chosen by pixels its sphere has to stay as it is.
bool mayBeTooSmall(const osg::BoundingSphere& sphere, const osg::Node& node) {
    const auto* const lod = dynamic_cast<const osg::LOD*>(&node);
    const bool isSet = lod && lod->getCenterMode() == osg::LOD::USER_DEFINED_CENTER && lod->getRadius() >= 0.0f &&
                       lod->getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT;
    const osg::BoundingSphere ofBin = isSet ? sphereOfBin(node) : osg::BoundingSphere();
    constexpr double kRounding = 1e-6;
    const double room = kRounding * (osg::Vec3d(sphere.center()).length() + static_cast<double>(sphere.radius()));
    const double reach = (osg::Vec3d(ofBin.center()) - osg::Vec3d(sphere.center())).length() + ofBin.radius();
    return isSet && !(ofBin.valid() && reach <= sphere.radius() + room);
}

void expandByChildren(osg::BoundingSphere& sphere, const osg::Group& group) {
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
        const osg::Node& child = *group.getChild(i);
        const osg::Transform* const transform = child.asTransform();
        if (!transform || transform->getReferenceFrame() == osg::Transform::RELATIVE_RF)
            sphere.expandRadiusBy(child.getBound());
    }
}

// The node with the bin of the tile that a watched node belongs to. Returns: nullptr where it belongs to none.
const osg::Node* culledNodeOf(const osg::Node& node) {
    const osg::Node* const culled = installedTileOf(node) ? &node : carrierOf(const_cast<osg::Node&>(node));
    return culled && installedTileOf(*culled) ? culled : nullptr;
}

// Says that the mesh of the tile that a watched node belongs to has changed. The next update makes the tile's family
// anew. `isMoved`: the mesh has left its place, which may be empty now.
void doubtMeshOf(const osg::Node& node, bool isMoved) {
    const osg::Node* const culled = culledNodeOf(node);
    if (!culled) return;
    using Tile = InstalledTile;
    InstalledTile& tile = *installedTileOf(*culled);
    tile.doubt(Tile::MeshUnread | Tile::MeshChanged | Tile::NotFilled | (isMoved ? Tile::MeshMoved : 0u));
    for (osg::Group* const parent : culled->getParents()) tile.database().noteChanged(*parent);
}

// Says that the tile draws something beside its mesh.
void noteMoreThanMesh(const osg::Node& node) {
    if (const osg::Node* const culled = culledNodeOf(node))
        installedTileOf(*culled)->doubt(InstalledTile::MoreThanMesh);
}

// The application has replaced the watch of a tile, and perhaps the mesh: the next update places it anew.
void keepUnwatchedVisible(const osg::Node& node) {
    const AnalyticBinCullCallback* const tile = installedBinOf(node);
    if (!tile || watchOf(node)) return;
    tile->getInstalledTile()->doubt(InstalledTile::Outgrown);
    doubtMeshOf(node, false);
    if (isBelowDatabase(node)) tile->getInstalledTile()->database().requestRefit();
}

// A level that others have read in the place of the tile's mesh may leave a gap there.
void doubtLevelsOf(InstalledTile& tile) {
    const InstalledDatabase& database = tile.database();
    if (!areVouchedFor(Database::of(tile).options(), *database.ellipsoid())) tile.doubt(InstalledTile::GapBelow);
}

// What OSG keeps for derived classes.
struct OpenNode : public osg::Node {
    [[nodiscard]] static bool hasBound(const osg::Node& node) { return node.*(&OpenNode::_boundingSphereComputed); }
};

// Whether OSG has to compute the node's bound anew, because it was told of a change.
bool isBoundDue(const osg::Node& node) {
    return !OpenNode::hasBound(node);
}

// Whether OSG culls neither the node nor anything above it, as with light sources and absolute transforms.
bool isNeverCulled(const osg::Node& node) {
    return !node.getCullingActive() || node.getNumChildrenWithCullingDisabled() > 0;
}

}  // namespace

ContentWatch::ContentWatch(const ContentWatch& other, const osg::CopyOp& copyop) : BoundWatch(other, copyop) {}

void ContentWatch::place(osg::Node& node, const std::vector<osg::ref_ptr<osg::Node>>& fitted, InstalledTile* above,
                         InstalledTile* tile) {
    remove(node);
    const osg::ref_ptr<ContentWatch> watch = new ContentWatch;
    watch->_node = &node;
    watch->_in = node.getNumParents() == 1 ? node.getParent(0) : nullptr;
    watch->_above = above;
    watch->_tile = tile;
    watch->_frame = frameOf(node);
    watch->_previous = node.getComputeBoundingSphereCallback();
    const auto add = [&watch](const osg::Node& mesh) {
        watch->_fitted.push_back({&mesh, MeshState::of(mesh), contentOf(mesh), 0});
    };
    for (const auto& mesh : fitted) {
        const osg::Group* const group = mesh == &node && !asTerrain(node) ? node.asGroup() : nullptr;
        if (mesh != &node || asTerrain(node)) add(*mesh);
        for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) add(*group->getChild(i));
    }
    node.setComputeBoundingSphereCallback(watch);
    // what is there already, beside meshes, is looked at with the next bound
    node.dirtyBound();
}

void ContentWatch::remove(osg::Node& node) {
    if (const ContentWatch* const watch = watchOf(node)) {
        node.setComputeBoundingSphereCallback(osg::ref_ptr(watch->_previous).get());
        // it may be larger than without the watch
        node.dirtyBound();
    }
}

void ContentWatch::look() const {
    if (_node) (void)_node->getBound();
}

osg::BoundingSphere ContentWatch::computeBound(const osg::Node& node) const {
    if (&node != _node) return boundOf(node);
    check(node);
    osg::BoundingSphere bound = boundOf(node);
    // about the middle that it has: levels of detail are chosen by the distance from there
    if (isScaledTerrain(node)) bound.expandRadiusBy(sphereOfBin(node));
    if (mayBeTooSmall(bound, node)) expandByChildren(bound, *node.asGroup());
    return bound;
}

bool ContentWatch::hasNewContent(const osg::Node& node) {
    const ContentWatch* const watch = watchOf(node);
    // where the application has replaced the watch, content may have been added unnoticed
    if (!watch && culledNodeOf(node)) return true;
    const osg::Group* const group = asTerrain(node) ? nullptr : node.asGroup();
    for (unsigned int i = 0; watch && watch->_node == &node && group && i < group->getNumChildren(); ++i) {
        const osg::Node& child = *group->getChild(i);
        if (!watch->isWatched(child) && !watch->isFitted(child, i, false, true)) return true;
    }
    return false;
}

const ContentWatch* ContentWatch::ownWatchOf(const osg::Node& node) {
    const ContentWatch* const watch = node.getNumParents() == 1 ? watchOf(node) : nullptr;
    return watch && watch->_node == &node ? watch : nullptr;
}

bool ContentWatch::isWatched(const osg::Node& child) const {
    const ContentWatch* const watch = ownWatchOf(child);
    return watch && watch->_above == _tile && (!watch->_in || watch->_in == _node);
}

// What was noted of a child; nullptr: the bin was not fitted to it. Most stand where they stood, or one place before.
const ContentWatch::Fitted* ContentWatch::fittedOf(const osg::Node& child, std::size_t slot) const {
    const auto isOf = [&child](const Fitted& fitted) { return fitted.node == &child; };
    const auto from = _fitted.begin() + static_cast<std::ptrdiff_t>(std::min(slot, _fitted.size()));
    auto known = std::find_if(from, _fitted.end(), isOf);
    if (known == _fitted.end()) known = std::find_if(_fitted.begin(), from, isOf);
    return known != _fitted.end() && isOf(*known) ? &*known : nullptr;
}

// bounds are not computed before OSG does so: it may crash on those of broken meshes
bool ContentWatch::isFitted(const osg::Node& child, std::size_t slot, bool withBounds, bool withContent) const {
    const Fitted* const known = fittedOf(child, slot);
    if (!known || !(known->state == MeshState::of(child))) return false;
    if (withContent && known->content != contentOf(child)) return false;
    if (!withBounds && known->bounds == 0) return true;
    const std::uint64_t bounds = boundsOf(child);
    if (known->bounds == 0) known->bounds = bounds;
    return known->bounds == bounds;
}

bool ContentWatch::isPartMoved(const osg::Group& group) const {
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
        const Fitted* const fitted = fittedOf(*group.getChild(i), i);
        const MeshState now = fitted ? MeshState::of(*fitted->node) : MeshState();
        if (fitted && now.parts == fitted->state.parts && now.frames != fitted->state.frames) return true;
    }
    return false;
}

bool ContentWatch::isMerged(const osg::Node& node) const {
    const bool is = isBelowDatabase(node);
    _isPending = _isPending || !is;
    return is;
}

// OSG does not tell of changes below a child whose bound the application has computed since.
bool ContentWatch::isHeld(unsigned int i, const osg::Node& child) const {
    return i < _held.size() && _held[i].node.get() == &child && _held[i].sphere == child.getBound() &&
           _held[i].state == MeshState::of(child);
}

void ContentWatch::noteHeld(unsigned int i, const osg::Node& child) const {
    if (i >= _held.size()) _held.resize(i + 1);
    _held[i] = {&child, child.getBound(), MeshState::of(child)};
}

void ContentWatch::check(const osg::Node& node) const {
    _isPending = false;
    TileFamily::look(node);
    const bool isOwnFrame = frameOf(node) == _frame;
    // osgTerrain draws nothing of what is below its tiles
    const osg::Group* const group = asTerrain(node) ? nullptr : node.asGroup();
    std::optional<bool> isInScene;
    const auto isMergedNow = [&] {
        if (!isInScene) isInScene = isMerged(node);
        return *isInScene;
    };
    // beside tiles there may be thousands of models
    std::optional<bool> isContent;
    const auto isInTileNow = [&] {
        if (!isContent) isContent = _tile || !isMergedNow() || isInTile(node);
        return *isContent;
    };
    const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&node);
    const TileFamily* const family = TileFamily::of(node);
    std::size_t fitted = 0;
    int moved = 0;
    bool hasMore = false;
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        const osg::Node& child = *group->getChild(i);
        if (family && family->isWithoutTiles(i, child, moved) && !isInTileNow()) continue;
        const bool isDue = isBoundDue(child);
        const bool isUnchanged = isOwnFrame && !isDue && isHeld(i, child);
        const osg::BoundingSphere& sphere = child.getBound();  // has others look at what is below it, too
        keepUnwatchedVisible(child);
        // the watch of the child would do this, if there were one, or if the application had not replaced it
        const bool isAboveTiles = (family && family->holds(i, child)) || child.getComputeBoundingSphereCallback();
        if (isAboveTiles && !watchOf(child)) forEachPart(child, keepUnwatchedVisible);
        const ContentWatch* const watch = ownWatchOf(child);
        if (watch && watch->_isPending) watch->check(child);
        _isPending = _isPending || (watch && watch->_isPending);
        // where this node has moved, what looks after itself has moved with it, and is not asked
        if ((isOwnFrame && isWatched(child) && !drawsBesideChildren(child)) || !isInTileNow()) continue;
        // OSG does not pass on changes below a node whose bound was never computed
        if (_tile && !isUnchanged) forEachPart(child, [](const osg::Node& part) { (void)part.getBound(); });
        if (isOwnFrame && isFitted(child, i, true, isDue)) {
            ++fitted;
            continue;
        }
        const bool isLevel = paged && isPaged(*paged, i);
        if (isLevel && _tile) doubtLevelsOf(*_tile);
        if (!sphere.valid() && !isNeverCulled(child)) continue;
        hasMore = hasMore || (!isLevel && isMergedNow());
        if (isUnchanged) continue;
        fitIntoTilesFrom(node, const_cast<osg::Node&>(child), sphere, isMergedNow());
        if (isMergedNow()) noteHeld(i, child);
    }
    // a level may be shown in place of those that were read
    const bool isOther = fitted < _fitted.size() || (paged && hasMore);
    if (group && isOther && isMergedNow()) doubtMeshOf(node, !isOwnFrame || isPartMoved(*group));
    if (hasMore) noteMoreThanMesh(node);
    if (group || _fitted.empty() || isFitted(node, 0, true, false)) return;
    // an osgTerrain tile that has other heights
    fitIntoTilesFrom(node, const_cast<osg::Node&>(node), boundOf(node), isMergedNow());
    if (isMergedNow()) doubtMeshOf(node, false);
}

}  // namespace osgAnalyticBin
