// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileFamily.h"

#include "BinCulling.h"
#include "Database.h"
#include "InstalledTile.h"
#include "ShownDepth.h"
#include "TileCallback.h"

#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>
#include <osgTerrain/TerrainTile>

#include <cmath>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

using MeshParts = std::vector<osg::ref_ptr<const osg::Node>>;

// The nodes of a mesh, where all of them are drawn as long as they are entered.
bool appendParts(const osg::Node& node, MeshParts& parts) {
    parts.emplace_back(&node);
    if (dynamic_cast<const osgTerrain::TerrainTile*>(&node)) return typeid(node) == typeid(osgTerrain::TerrainTile);
    const osg::Group* const group = node.asGroup();
    bool areKnown = drawsAllChildren(node) && (!group || group->getNumChildren() > 0);
    for (unsigned int i = 0; areKnown && group && i < group->getNumChildren(); ++i) {
        areKnown = appendParts(*group->getChild(i), parts);
    }
    return areKnown;
}

// The mesh of a tile with a single one.
const osg::Node* meshOf(const osg::Node& tile) {
    const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&tile);
    if (!paged) return &tile;
    const bool isSingle = paged->getNumChildren() > 0 && paged->getNumFileNames() > 0 && paged->getFileName(0).empty();
    for (unsigned int i = 1; i < paged->getNumFileNames(); ++i) {
        if (paged->getFileName(i).empty()) return nullptr;
    }
    return isSingle ? paged->getChild(0) : nullptr;
}

MeshParts meshPartsOf(const osg::Node& tile) {
    const osg::Node* const mesh = meshOf(tile);
    MeshParts parts;
    if (!mesh || !appendParts(*mesh, parts)) return {};
    return parts;
}

TileFamily* familyOn(const osg::Node& node) {
    for (osg::Callback* at = const_cast<osg::Node&>(node).getCullCallback(); at; at = at->getNestedCallback()) {
        if (auto* const family = dynamic_cast<TileFamily*>(at)) return family;
    }
    return nullptr;
}

// The first test of all bins, as the kernels begin with it. Planes that have the sphere inside are cleared.
bool isOutside(const core::SphereData& sphere, const core::PlaneSet& planes, core::PlaneMask& undecided) {
    core::PlaneMask inside = 0;
    for (core::PlaneMask left = undecided, i = 0; left != 0; left >>= 1, ++i) {
        if (!(left & 1)) continue;
        const core::PlaneBlock& block = planes.blocks()[i / core::PlaneBlock::kLanes];
        const std::size_t lane = i % core::PlaneBlock::kLanes;
        const double distance = (block.normalX[lane] * sphere.center[0] + block.normalY[lane] * sphere.center[1]) +
                                (block.normalZ[lane] * sphere.center[2] + block.offset[lane]);
        const double threshold = static_cast<double>(sphere.reach) + block.rounding[lane];
        if (distance < -threshold) return true;
        if (distance >= threshold) inside |= core::PlaneMask{1} << i;
    }
    undecided &= ~inside;
    return false;
}

}  // namespace

TileFamily::TileFamily(const TileFamily& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}

TileFamily::~TileFamily() = default;

bool TileFamily::isPossibleOn(const osg::Node& node) {
    return typeid(node) == typeid(osg::Group) || typeid(node) == typeid(osg::CoordinateSystemNode);
}

void TileFamily::place(osg::Node& node) {
    remove(node);
    osg::Group* const group = isPossibleOn(node) ? node.asGroup() : nullptr;
    if (!group) return;
    const osg::ref_ptr<TileFamily> family = new TileFamily;
    family->_group = group;
    family->_block = new TileBlock(group->getNumChildren());
    family->_members.resize(group->getNumChildren());
    bool hasMembers = false;
    for (unsigned int i = 0; i < group->getNumChildren(); ++i) {
        hasMembers = family->add(*group->getChild(i), i) || hasMembers;
    }
    if (hasMembers) node.addCullCallback(family);
}

void TileFamily::remove(osg::Node& node) {
    if (const osg::ref_ptr<TileFamily> family = familyOn(node)) takeOff(node, *family);
}

bool TileFamily::add(osg::Node& child, std::size_t slot) {
    const AnalyticBinCullCallback* const tile = installedBinOf(child);
    if (!tile || !tile->_prepared || tile->_hasLocalFrame) return false;
    if (!_ellipsoid) {
        _ellipsoid = tile->_prepared->ellipsoid;
        _shape = tile->_shape;
    }
    const bool isSameShape = _shape.has_value() == tile->_shape.has_value() && (!_shape || *_shape == *tile->_shape);
    if (!(*_ellipsoid == tile->_prepared->ellipsoid) || !isSameShape) return false;
    _members[slot] = {&child, tile, tile->installedTile()->isSeeThrough(), meshPartsOf(child)};
    tile->installedTile()->joinFamily(*_block, slot);
    tile->fillSlot();
    tile->fillSlot();
    return true;
}

// As AnalyticBinCullCallback::isCulled() and eyeOn() ask it for one tile.
bool TileFamily::culls(const osg::Node& group, osg::CullStack& cullStack, const DatabaseView& view) const {
    const osg::CullingSet::Mask mask = cullStack.getCurrentCullingSet().getCullingMask();
    return &group == _group && !getNestedCallback() && (mask & osg::CullingSet::VIEW_FRUSTUM_CULLING) &&
           view.modelView == cullStack.getModelViewMatrix() && view.projection == cullStack.getProjectionMatrix() &&
           view.ellipsoid == *_ellipsoid && (!_shape || *_shape == view.shape) && !hasActiveOccluders(cullStack);
}

void TileFamily::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* const cullStack = nv->asCullStack();
    const DatabaseView* const view = cullStack ? CullTraversal::of(*nv).databaseView() : nullptr;
    if (!view || !culls(*node, *cullStack, *view)) {
        traverse(node, nv);
        return;
    }
    cullChildren(*node->asGroup(), *nv, *cullStack, *view, CullTraversal::of(*nv));
}

void TileFamily::cullChildren(osg::Group& group, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                              const DatabaseView& view, CullTraversal& traversal) const {
    // OSG's stack of culling sets may move while a child is entered
    const auto setMask = [&cullStack](core::PlaneMask mask) {
        osg::Polytope& frustum = cullStack.getCurrentCullingSet().getFrustum();
        frustum.getCurrentMask() = mask;
        frustum.setResultMask(mask);
    };
    const core::PlaneMask before = cullStack.getCurrentCullingSet().getFrustum().getCurrentMask();
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
        osg::Node* const child = group.getChild(i);
        if (!member(i, *child)) {
            child->accept(nv);
            continue;
        }
        core::PlaneMask undecided = before;
        const Verdict verdict = this->verdict(i, view, traversal, undecided);
        const bool culled =
            verdict.side == core::Side::Outside || isSmall(cullStack.getCurrentCullingSet(), (*_block)[i].bound);
        count(traversal, nv, verdict, culled);
        if (culled) continue;
        setMask(undecided);
        traversal.setKept(child);
        child->accept(nv);
        traversal.setKept(nullptr);
        setMask(before);
    }
}

Verdict TileFamily::verdict(std::size_t slot, const DatabaseView& view, CullTraversal& traversal,
                            core::PlaneMask& undecided) const {
    const core::SphereData& sphere = (*_block)[slot].sphere;
    if (isOutside(sphere, view.planes, undecided)) return {core::Side::Outside, Verdict::Plane};
    if (view.eye && _block->isHidden(slot, *view.eye)) return {core::Side::Outside, Verdict::Horizon};
    const bool isForComparison = std::isinf(sphere.reach);
    if (undecided == 0 && !isForComparison) return {core::Side::Inside, Verdict::Plane};
    return _members[slot].tile->classify(view.planes, undecided, isForComparison ? view.eye : nullptr, traversal);
}

}  // namespace osgAnalyticBin
