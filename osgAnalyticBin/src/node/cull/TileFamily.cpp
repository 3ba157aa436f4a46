// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileFamily.h"

#include "../../core/Bits.h"
#include "../CallbackChain.h"
#include "../Classes.h"
#include "../tile/InstalledTile.h"
#include "../tile/MeshCulling.h"
#include "BinCulling.h"
#include "DrawnState.h"
#include "InstalledBin.h"
#include "TilePlan.h"

#include <osgAnalyticBin/PhotogrammetrySet.h>

#include <osg/CoordinateSystemNode>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osgTerrain/TerrainTile>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cstdint>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

using MeshParts = TileFamily::MeshParts;

// Collects the nodes of a mesh. Returns: whether OSG draws the whole mesh as long as it enters each of them, and there
// is room for all.
bool appendParts(osg::Node& node, MeshParts& parts, std::size_t& count) {
    if (count == parts.size()) return false;
    parts[count++] = &node;
    if (dynamic_cast<const osgTerrain::TerrainTile*>(&node)) return typeid(node) == typeid(osgTerrain::TerrainTile);
    // a group without children draws nothing
    osg::Group* const group = node.asGroup();
    bool areKnown = drawsAllChildren(node) && (!group || group->getNumChildren() > 0);
    for (unsigned int i = 0; areKnown && group && i < group->getNumChildren(); ++i) {
        areKnown = appendParts(*group->getChild(i), parts, count);
    }
    return areKnown;
}

// The mesh of a tile. Returns: nullptr where the tile has several or none.
osg::Node* meshOf(osg::Node& tile) {
    auto* const paged = dynamic_cast<osg::PagedLOD*>(&tile);
    if (!paged) return &tile;
    const bool isSingle = paged->getNumChildren() > 0 && paged->getNumFileNames() > 0 && paged->getFileName(0).empty();
    for (unsigned int i = 1; i < paged->getNumFileNames(); ++i) {
        if (paged->getFileName(i).empty()) return nullptr;
    }
    return isSingle ? paged->getChild(0) : nullptr;
}

MeshParts meshPartsOf(osg::Node& tile) {
    osg::Node* const mesh = meshOf(tile);
    MeshParts parts;
    std::size_t count = 0;
    if (!mesh || !appendParts(*mesh, parts, count)) return {};
    return parts;
}

}  // namespace

TileFamily::TileFamily(const TileFamily& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}

TileFamily::~TileFamily() = default;

bool TileFamily::isPossibleOn(const osg::Node& node) {
    return typeid(node) == typeid(osg::Group) || typeid(node) == typeid(osg::CoordinateSystemNode) ||
           (typeid(node) == typeid(osg::MatrixTransform) && isPhotogrammetrySet(node));
}

TileFamily::TileFamily(osg::Group& group)
    : _group(&group),
      _block(new TileBlock(group.getNumChildren())),
      _nodes(group.getNumChildren()),
      _members(group.getNumChildren()) {
    const unsigned int children = group.getNumChildren();
    for (unsigned int i = 0; i < children; ++i) _hasTiles = add(*group.getChild(i), i) || _hasTiles;
    for (unsigned int i = 0; i < children; ++i) _hasGroups = addFamilyOf(*group.getChild(i), i) || _hasGroups;
    if (!hasSameChildren(group)) _block->columnUnion().addDoubts(1);
}

bool TileFamily::place(osg::Node& node) {
    remove(node);
    if (!isPossibleOn(node)) return false;
    const osg::ref_ptr<TileFamily> family = new TileFamily(*node.asGroup());
    const bool isUsed = family->_hasTiles || family->_hasGroups;
    if (isUsed) node.addCullCallback(family);
    return isUsed;
}

void TileFamily::remove(osg::Node& node) {
    if (const osg::ref_ptr<TileFamily> family = findCallback<TileFamily>(node.getCullCallback())) {
        takeOff(node, *family);
        ColumnUnion* const columns = family->_block ? &family->_block->columnUnion() : nullptr;
        // what the group shows is no longer held there
        if (columns && columns->above()) columns->above()->addDoubts(1);
        if (columns) columns->setAbove(nullptr);
    }
}

void TileFamily::renew(osg::Node& node) {
    const osg::ref_ptr<TileFamily> old = findCallback<TileFamily>(node.getCullCallback());
    if (!old || old->_group != &node || !old->_hasTiles) return;
    const osg::ref_ptr<ColumnUnion> above = old->_block->columnUnion().above();
    old->_block->columnUnion().setAbove(nullptr);
    remove(node);
    osg::Group& group = *node.asGroup();
    const osg::ref_ptr<TileFamily> family = new TileFamily(group);
    family->_hasLostTiles =
        old->_hasLostTiles || std::any_of(old->_nodes.begin(), old->_nodes.end(),
                                          [&](const auto& tile) { return tile && !group.containsNode(tile); });
    if (!family->_ellipsoid) family->_ellipsoid = old->_ellipsoid;
    if (above) family->_block->columnUnion().setAbove(above);
    if (family->_hasTiles || family->_hasLostTiles) node.addCullCallback(family);
}

bool TileFamily::addFamilyOf(osg::Node& child, std::size_t slot) {
    const TileFamily* const below = findCallback<TileFamily>(child.getCullCallback());
    const bool isBelow = below && !_nodes[slot] && below->_group == &child && below->_ellipsoid &&
                         child.getNumParents() == 1 && isExactly<osg::Group>(child) &&
                         !(_ellipsoid && *_ellipsoid != *below->_ellipsoid);
    if (!isBelow) return false;
    _nodes[slot] = &child;
    _ellipsoid = below->_ellipsoid;
    below->_block->columnUnion().setAbove(&_block->columnUnion());
    return true;
}

bool TileFamily::hasSameChildren(const osg::Group& group) const {
    bool isSame = group.getNumChildren() == _nodes.size();
    for (unsigned int i = 0; isSame && i < group.getNumChildren(); ++i) isSame = group.getChild(i) == _nodes[i];
    return isSame;
}

bool TileFamily::hasLost(const osg::Group& group) const {
    // tiles are looked for when they are tested
    const bool hasLostGroup =
        _hasGroups && !hasSameChildren(group) &&
        std::any_of(_nodes.begin(), _nodes.end(), [&](const auto& node) { return node && !group.containsNode(node); });
    return _hasLostTiles || hasLostGroup;
}

void TileFamily::look(const osg::Node& node) {
    const TileFamily* const family = findCallback<TileFamily>(const_cast<osg::Node&>(node).getCullCallback());
    if (!family || family->_group != &node || family->hasSameChildren(*node.asGroup())) return;
    if (family->_block->columnUnion().isSure()) family->_block->columnUnion().addDoubts(1);
}

const ColumnUnion* TileFamily::columnUnion(const osg::Group& group) const {
    if (_group != &group) return nullptr;
    const ColumnUnion& columns = _block->columnUnion();
    const bool isInTree = _hasGroups || columns.above();
    return isInTree && columns.isSure() ? &columns : nullptr;
}

const ColumnUnion* TileFamily::columnUnionOf(osg::Group& group) {
    const TileFamily* const family = findCallback<TileFamily>(group.getCullCallback());
    return family ? family->columnUnion(group) : nullptr;
}

bool TileFamily::add(osg::Node& child, std::size_t slot) {
    const AnalyticBinCullCallback* const tile = installedBinOf(child);
    // a transform may move
    if (!tile || !tile->_isTested || tile->_frame || child.asTransform()) return false;
    if (!_ellipsoid) {
        _ellipsoid = tile->ellipsoid();
        _shape = tile->_setup->shape;
        _testsEdges = tile->_setup->options.edges;
        _trustsShaders = tile->_setup->options.plainShaders;
    }
    const bool isSame =
        *_ellipsoid == tile->ellipsoid() && _testsEdges == tile->_setup->options.edges && _shape == tile->_setup->shape;
    if (!isSame) return false;
    _nodes[slot] = &child;
    _block->addMember(slot);
    const MeshParts parts = meshPartsOf(child);
    const bool hasTerrain = std::any_of(parts.begin(), parts.end(), [](const auto& part) {
        return dynamic_cast<const osgTerrain::TerrainTile*>(part.get()) != nullptr;
    });
    _members[slot] = {tile, dynamic_cast<osg::PagedLOD*>(&child), parts, hasTerrain, TileEntry(child, parts)};
    tile->getInstalledTile()->joinFamily(*_block, slot);
    tile->fillSlot();
    return true;
}

// The same conditions as in AnalyticBinCullCallback::isCulled() and eyeOn(), for all tiles together.
bool TileFamily::culls(const osg::Node& group, osg::CullStack& cullStack, const DatabaseView& view) const {
    const osg::CullingSet::Mask mask = cullStack.getCurrentCullingSet().getCullingMask();
    return &group == _group && _hasTiles && !getNestedCallback() && (mask & osg::CullingSet::VIEW_FRUSTUM_CULLING) &&
           view.modelView == cullStack.getModelViewMatrix() && view.projection == cullStack.getProjectionMatrix() &&
           view.ellipsoid == *_ellipsoid && (!_shape || *_shape == view.shape) && !hasActiveOccluders(cullStack);
}

void TileFamily::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* const cullStack = nv->asCullStack();
    CullTraversal* const traversal = cullStack ? &CullTraversal::of(*nv) : nullptr;
    const DatabaseView* const view =
        traversal && !traversal->statistics().isTileByTile() ? traversal->databaseView() : nullptr;
    if (!view || !culls(*node, *cullStack, *view)) {
        traverse(node, nv);
        return;
    }
    cullChildren(*node->asGroup(), *nv, *cullStack, *view, *traversal);
}

bool TileFamily::enterFamilyOf(osg::Node& node, osgUtil::CullVisitor& visitor, CullTraversal& traversal,
                               Footprint::Notes& notes) {
    osg::Callback* const callback = node.getCullCallback();
    if (!callback || !isExactly<TileFamily>(*callback) || !isExactly<osg::Group>(node)) return false;
    const TileFamily& family = static_cast<const TileFamily&>(*callback->asNodeCallback());
    const DatabaseView* const view = traversal.statistics().isTileByTile() ? nullptr : traversal.databaseView();
    if (!view || !visitor.validNodeMask(node) || !family.culls(node, visitor, *view)) return false;
    notes.add(&node, 4);
    notes.add(&family, 5);
    notes.add(family._block, 2);
    if (family._block->size() > 0) notes.add(&family._block->partFrom(0), 3);
    notes.add(family._nodes.data(), 1);
    notes.add(family._members.data(), 16);
    osg::StateSet* const state = node.getStateSet();
    visitor.pushOntoNodePath(&node);
    if (state) visitor.pushStateSet(state);
    family.cullChildren(*node.asGroup(), visitor, visitor, *view, traversal);
    if (state) visitor.popStateSet();
    visitor.popFromNodePath();
    return true;
}

void TileFamily::test(const osg::Group& group, unsigned int first, const core::PlaneSet& planes,
                      core::PlaneMask undecided, const core::HorizonEye* eye, Verdicts& verdicts) const {
    verdicts.beyond = verdicts.members = verdicts.tested = verdicts.hidden = verdicts.separated = verdicts.occluded = 0;
    verdicts.lacksTiles = false;
    if (first >= _block->size()) return;
    const TileBlock::Part& part = _block->partFrom(first);
    part.bins.classify(planes, undecided, verdicts.planes);
    verdicts.tested = part.bins.filled();
    verdicts.beyond = eye ? part.bins.hiddenFrom(*eye, verdicts.tested & ~verdicts.planes.outside) : 0;
    verdicts.hidden = hideable(first, verdicts.beyond & part.hideable);
    const std::size_t end =
        std::min<std::size_t>({first + TileBlock::Part::kMost, group.getNumChildren(), _nodes.size()});
    for (std::size_t i = first; i < end; ++i) {
        verdicts.members |= std::uint64_t{_nodes[i] == group.getChild(static_cast<unsigned int>(i))} << (i - first);
    }
    verdicts.lacksTiles = (part.members & ~verdicts.members) != 0;
    verdicts.members &= part.believed.load(std::memory_order_relaxed);
    findSeparated(first, verdicts.members & verdicts.tested & ~(verdicts.planes.outside | verdicts.hidden), planes,
                  verdicts);
}

void TileFamily::fetchKept(unsigned int first, const Verdicts& verdicts) const {
    forEachBit(verdicts.members & ~verdicts.outOfView(),
               [&](unsigned int number) { _members[first + number].entry.fetch(); });
}

// A state that the application has set since then is asked for.
std::uint64_t TileFamily::hideable(unsigned int first, std::uint64_t tiles) const {
    std::uint64_t hideable = tiles;
    forEachBit(tiles, [&](unsigned int number) {
        const osg::Node* const node = _nodes[first + number];
        if (node && !drawnStateOf(*node, {_trustsShaders}).obeysDepth) hideable &= ~(std::uint64_t{1} << number);
    });
    return hideable;
}

void TileFamily::findSeparated(unsigned int first, std::uint64_t candidates, const core::PlaneSet& planes,
                               Verdicts& verdicts) const {
    const core::BinFamily& bins = _block->partFrom(first).bins;
    forEachBit(candidates & ~verdicts.planes.insideAll, [&](unsigned int number) {
        const core::PlaneMask undecided = verdicts.planes.undecided[number];
        const bool isAcrossEdge = (undecided & (undecided - 1)) != 0;
        if (!isAcrossEdge || !_testsEdges) return;
        const bool isBeyond = hasBit(bins.exact(), number) || _ellipsoid->isPlane()
                                  ? bins.isSeparated(number, planes, undecided)
                                  : _members[first + number].tile->isBeyondAnEdge(planes, undecided);
        if (isBeyond) verdicts.separated |= std::uint64_t{1} << number;
    });
}

void TileFamily::lookUp(const osg::Group& group, unsigned int first, core::PlaneMask undecided,
                        const DatabaseView& view, Verdicts& verdicts) const {
    if (!view.plan || !view.plan->find(*this, first, undecided, verdicts)) {
        test(group, first, view.planes, undecided, view.eye, verdicts);
        fetchKept(first, verdicts);
    }
    if (verdicts.hidden == 0 || (view.eye && !view.sight)) return;
    // the plan does not look at borders, and may be that of an eye which came to nothing
    std::uint64_t seen = verdicts.hidden;
    if (view.eye) seen &= ~view.sight->heldIn(_block->partFrom(first).bins, seen);
    findSeparated(first, verdicts.members & seen, view.planes, verdicts);
    verdicts.hidden &= ~seen;
}

// Which of the tiles are culled, one bit each.
std::uint64_t TileFamily::culled(unsigned int first, const Verdicts& verdicts, const osg::NodeVisitor& nv,
                                 osg::CullStack& cullStack, CullTraversal& traversal) const {
    const std::uint64_t inside = verdicts.members & verdicts.tested & verdicts.planes.insideAll;
    std::uint64_t culled = verdicts.members & verdicts.outOfView();
    osg::CullingSet& cullingSet = cullStack.getCurrentCullingSet();
    if (cullingSet.getCullingMask() & osg::CullingSet::SMALL_FEATURE_CULLING) {
        forEachBit(verdicts.members & ~culled, [&](unsigned int number) {
            if (isSmall(cullingSet, (*_block)[first + number].bound)) culled |= std::uint64_t{1} << number;
        });
    }
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR) {
        BinCounts counts;
        counts.outside = countBits(culled);
        counts.inside = countBits(inside & ~culled);
        counts.straddling = countBits(verdicts.members & ~culled & ~inside);
        counts.hidden = countBits(verdicts.members & verdicts.hidden);
        counts.beyondEdge = countBits(verdicts.members & verdicts.separated);
        counts.occluded = countBits(verdicts.members & verdicts.occluded);
        counts.frame = nv.getTraversalNumber();
        traversal.statistics().add(counts);
    }
    if (first < _block->size()) {
        forEachBit(verdicts.members & ~culled & _block->partFrom(first).withSpheres, [&](unsigned int number) {
            const core::PlaneMask undecided = verdicts.planes.undecided[number];
            if (isSphereCulled(cullingSet, undecided, _nodes[first + number]->getBound()))
                culled |= std::uint64_t{1} << number;
        });
    }
    return culled;
}

bool TileFamily::isAlone(const osg::Node& tile, const Member& member) {
    const osg::Callback* const nested = member.tile->getNestedCallback();
    return tile.getCullCallback() == member.tile &&
           (!nested || (isSuspendedCluster(*nested) && !nested->getNestedCallback()));
}

void TileFamily::enterAlone(osg::Node& tile, const TileEntry& entry, osgUtil::CullVisitor& visitor,
                            CullTraversal& traversal) {
    Footprint::Notes notes(entry.footprint());
    const TileEntry::Level level = entry.enter(tile, visitor, notes);
    if (!level.node) return;
    if (!enterFamilyOf(*level.node, visitor, traversal, notes)) level.node->accept(visitor);
    TileEntry::leave(level, visitor);
}

// A plain tile is entered as osgUtil::CullVisitor does it, but for the test of its sphere and for the calls that lead
// to the tile's own callback, which would do nothing: its family has tested it.
void TileFamily::enter(osg::Node& child, const Member& member, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                       CullTraversal& traversal) {
    if (member.entry.isPossible() && child.getCullCallback() == member.tile &&
        typeid(nv) == typeid(osgUtil::CullVisitor)) {
        auto& visitor = static_cast<osgUtil::CullVisitor&>(nv);
        if (isAlone(child, member)) return enterAlone(child, member.entry, visitor, traversal);
        return enterWithoutTest(child, visitor, child.getCullCallback()->getNestedCallback());
    }
    // OSG does not test the sphere in this mask; the tile's callback sets the mask of what is below again
    const osg::CullingSet::Mask mask = cullStack.getCurrentCullingSet().getCullingMask();
    cullStack.getCurrentCullingSet().setCullingMask(osg::CullingSet::NO_CULLING);
    traversal.setKept(&child, mask);
    child.accept(nv);
    traversal.setKept(nullptr, mask);
    cullStack.getCurrentCullingSet().setCullingMask(mask);
}

void TileFamily::cullChildren(osg::Group& group, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                              const DatabaseView& view, CullTraversal& traversal) const {
    // OSG's stack of culling sets may move while a child is entered
    const auto setMask = [&cullStack](core::PlaneMask mask) {
        setUndecided(cullStack.getCurrentCullingSet().getFrustum(), mask);
    };
    const core::PlaneMask before = cullStack.getCurrentCullingSet().getFrustum().getCurrentMask();
    const unsigned int children = group.getNumChildren();
    bool isChanged = children != _nodes.size();
    Verdicts verdicts;
    for (unsigned int first = 0; first < children; first += TileBlock::Part::kMost) {
        lookUp(group, first, before, view, verdicts);
        const bool isAnyHidden = (verdicts.hidden | verdicts.occluded) != 0;
        if (isAnyHidden && !drawnStateAbove(nv, view.rules, view.states).obeysDepth)
            verdicts.hidden = verdicts.occluded = 0;
        isChanged = isChanged || verdicts.lacksTiles;
        const std::uint64_t culled = this->culled(first, verdicts, nv, cullStack, traversal);
        const unsigned int here = std::min<unsigned int>(TileBlock::Part::kMost, children - first);
        forEachBit(lowestBits(here) & ~culled, [&](unsigned int number) {
            if (first + number >= group.getNumChildren()) return;
            osg::Node& child = *group.getChild(first + number);
            if (!hasBit(verdicts.members, number)) return child.accept(nv);
            const core::PlaneMask undecided = verdicts.planes.undecided[number];
            setMask(undecided);
            const PlanesBelow planes(cullStack, undecided);
            enter(child, _members[first + number], nv, cullStack, traversal);
            setMask(before);
        });
    }
    if (isChanged) view.database->noteChanged(group);
}

}  // namespace osgAnalyticBin
