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

#include <algorithm>
#include <cstdint>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

using MeshParts = std::vector<osg::ref_ptr<const osg::Node>>;

// The nodes of a mesh, where all of them are drawn as long as they are entered.
bool appendParts(const osg::Node& node, MeshParts& parts) {
    parts.emplace_back(&node);
    if (dynamic_cast<const osgTerrain::TerrainTile*>(&node)) return typeid(node) == typeid(osgTerrain::TerrainTile);
    // what has no children draws nothing
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
    family->_nodes.resize(group->getNumChildren());
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

void TileFamily::renew(osg::Node& node) {
    const osg::ref_ptr<TileFamily> old = familyOn(node);
    if (!old || old->_group != &node) return;
    place(node);
    const osg::Group& group = *node.asGroup();
    const bool hasLost = std::any_of(old->_nodes.begin(), old->_nodes.end(),
                                     [&](const auto& tile) { return tile && !group.containsNode(tile); });
    TileFamily* const family = familyOn(node);
    if (family) family->_hasLostTiles = hasLost || old->_hasLostTiles;
}

bool TileFamily::lacksTiles(const osg::Group& group) const {
    for (unsigned int i = 0; i < _nodes.size(); ++i) {
        const bool isThere = i < group.getNumChildren() && _nodes[i] == group.getChild(i);
        if (_nodes[i] && !isThere) return true;
    }
    return _hasLostTiles;
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
    _nodes[slot] = &child;
    _members[slot] = {tile, tile->installedTile()->isSeeThrough(), meshPartsOf(child)};
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

TileFamily::Verdicts TileFamily::test(unsigned int first, const core::PlaneSet& planes, core::PlaneMask undecided,
                                      const core::HorizonEye* eye) const {
    Verdicts verdicts;
    if (first >= _block->size()) return verdicts;
    const TileBlock::Part& part = _block->partFrom(first);
    part.bins.classify(planes, undecided, verdicts.planes);
    verdicts.believed = part.believed.load(std::memory_order_relaxed);
    verdicts.tested = part.bins.filled();
    if (eye) verdicts.hidden = part.bins.hiddenFrom(*eye, verdicts.tested & ~verdicts.planes.outside);
    return verdicts;
}

// Where the family's own tests leave something open, the tile is asked.
Verdict TileFamily::verdict(unsigned int i, const Verdicts& verdicts, const DatabaseView& view,
                            CullTraversal& traversal) const {
    const std::uint64_t bit = std::uint64_t{1} << (i % TileBlock::Part::kMost);
    core::PlaneMask undecided = verdicts.planes.undecided[i % TileBlock::Part::kMost];
    const AnalyticBinCullCallback& tile = *_members[i].tile;
    if (!(verdicts.tested & bit)) return tile.classify(view.planes, undecided, view.eye, traversal);
    if (verdicts.planes.outside & bit) return {core::Side::Outside, Verdict::Plane};
    if (verdicts.hidden & bit) return {core::Side::Outside, Verdict::Horizon};
    if (undecided == 0) return {core::Side::Inside, Verdict::Plane};
    const bool isAcrossEdge = (undecided & (undecided - 1)) != 0;
    const bool isBeyond = isAcrossEdge && tile._testsEdges && tile.isBeyondAnEdge(traversal, view.planes, undecided);
    return isBeyond ? Verdict{core::Side::Outside, Verdict::Edge} : Verdict{core::Side::Straddling, Verdict::Plane};
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
    bool isChanged = group.getNumChildren() != _nodes.size();
    Verdicts verdicts;
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
        if (i % TileBlock::Part::kMost == 0) verdicts = test(i, view.planes, before, view.eye);
        osg::Node* const child = group.getChild(i);
        if (!isMember(i, *child, verdicts)) {
            isChanged = isChanged || (_nodes[i] && _nodes[i] != child);
            child->accept(nv);
            continue;
        }
        const Verdict verdict = this->verdict(i, verdicts, view, traversal);
        const bool culled =
            verdict.side == core::Side::Outside || isSmall(cullStack.getCurrentCullingSet(), (*_block)[i].bound);
        count(traversal, nv, verdict, culled);
        if (culled) continue;
        setMask(verdicts.planes.undecided[i % TileBlock::Part::kMost]);
        traversal.setKept(child);
        child->accept(nv);
        traversal.setKept(nullptr);
        setMask(before);
    }
    if (isChanged) view.database->noteChanged(group);
}

}  // namespace osgAnalyticBin
