// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileFamily.h"

#include "../../core/Bits.h"
#include "../CallbackChain.h"
#include "../Classes.h"
#include "../tile/Carrier.h"
#include "../tile/InstalledTile.h"
#include "CullScopes.h"
#include "CullTraversal.h"
#include "DrawnState.h"
#include "ForeignCallbacks.h"
#include "InstalledBin.h"

#include <osg/CoordinateSystemNode>
#include <osgTerrain/Terrain>

#include <algorithm>
#include <cstdint>
#include <unordered_set>

namespace osgAnalyticBin {

namespace {

const TileFamily* familyOf(const osg::Node& node) {
    return findCallback<const TileFamily>(node.getCullCallback());
}

// Whether a node enters all of its children and does nothing else.
bool isPlain(const osg::Node& node) {
    return isOneOf<osg::Group, osg::CoordinateSystemNode, osgTerrain::Terrain>(node);
}

// Whether a subgraph holds tiles that are missed when they are taken away. Requires: its groups have their families.
bool holdsTiles(const osg::Node& node) {
    if (installedTileOf(node) || familyOf(node)) return true;
    const osg::Group* const group = TileFamily::isPossibleOn(node) ? nullptr : node.asGroup();
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        if (holdsTiles(*group->getChild(i))) return true;
    }
    return false;
}

// Whether all nodes but null are children of a group, which may have many.
bool holdsAll(const osg::Group& group, const std::vector<osg::ref_ptr<osg::Node>>& nodes) {
    std::unordered_set<const osg::Node*> children;
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) children.insert(group.getChild(i));
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](const auto& node) { return !node || children.count(node.get()) > 0; });
}

// The first tile of a subgraph, whether it is missed or not. Returns: nullptr where there is none.
const AnalyticBinCullCallback* firstTile(const osg::Node& node) {
    const auto* tile = findCallback<const AnalyticBinCullCallback>(node.getCullCallback());
    const osg::Group* const group = node.asGroup();
    for (unsigned int i = 0; group && !tile && i < group->getNumChildren(); ++i) tile = firstTile(*group->getChild(i));
    return tile;
}

}  // namespace

TileFamily::TileFamily(const TileFamily& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}

TileFamily::~TileFamily() = default;

bool TileFamily::isPossibleOn(const osg::Node& node) {
    return node.asGroup() && drawsAllChildren(node) && !isExactly<Carrier>(node);
}

TileFamily::TileFamily(osg::Group& group, const TileFamily* old)
    : _group(&group),
      _block(new TileBlock(group.getNumChildren())),
      _nodes(group.getNumChildren()),
      _tiles(group.getNumChildren()) {
    const unsigned int children = isPlain(group) ? group.getNumChildren() : 0;
    for (unsigned int i = 0; i < children; ++i) _hasTiles = add(*group.getChild(i), i) || _hasTiles;
    for (unsigned int i = 0; i < children; ++i) _hasGroups = addFamilyOf(*group.getChild(i), i) || _hasGroups;
    addOthers(group, old);
    bool areAllKnown = !_hasOthers;
    for (std::size_t i = 0; i < _nodes.size(); ++i) areAllKnown = areAllKnown && (_nodes[i] || _isWithoutTiles[i]);
    if (!areAllKnown) _block->columnUnion().addDoubts(1);
}

bool TileFamily::place(osg::Node& node, bool isAdded) {
    remove(node);
    if (!isPossibleOn(node)) return false;
    const osg::ref_ptr<TileFamily> family = new TileFamily(*node.asGroup(), nullptr);
    const bool isUsed = family->_hasTiles || family->_hasGroups || (family->_hasOthers && !isAdded);
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

void TileFamily::expectTilesBelow(osg::Node& node) {
    for (osg::Group* const parent : node.getParents()) {
        const osg::ref_ptr<TileFamily> family = findCallback<TileFamily>(parent->getCullCallback());
        for (std::size_t i = 0; family && i < family->_children.size(); ++i) {
            if (family->_children[i] != &node || !family->_isWithoutTiles[i]) continue;
            family->_isWithoutTiles[i] = false;
            family->_block->columnUnion().addDoubts(1);
        }
        expectTilesBelow(*parent);
    }
}

void TileFamily::renew(osg::Node& node) {
    expectTilesBelow(node);
    const osg::ref_ptr<TileFamily> old = findCallback<TileFamily>(node.getCullCallback());
    if (!old) (void)place(node, true);
    if (!old || old->_group != &node || old->renewInPlace(*node.asGroup())) return;
    const osg::ref_ptr<ColumnUnion> above = old->_block->columnUnion().above();
    old->_block->columnUnion().setAbove(nullptr);
    remove(node);
    osg::Group& group = *node.asGroup();
    const osg::ref_ptr<TileFamily> family = new TileFamily(group, old);
    family->_hasLostTiles = old->_hasLostTiles || !holdsAll(group, old->_nodes);
    if (!family->_ellipsoid) family->_ellipsoid = old->_ellipsoid;
    if (above) family->_block->columnUnion().setAbove(above);
    if (family->_hasTiles || family->_hasGroups || family->_hasOthers || family->_hasLostTiles)
        node.addCullCallback(family);
}

bool TileFamily::renewInPlace(osg::Group& group) {
    const unsigned int count = group.getNumChildren();
    std::vector<bool> areModels(count);
    int moved = 0;
    for (unsigned int i = 0; i < count || i < _nodes.size(); ++i) {
        const osg::Node* const child = i < count ? group.getChild(i) : nullptr;
        const osg::Node* const node = i < _nodes.size() ? _nodes[i].get() : nullptr;
        const auto* const tile = node ? _tiles[i].callback() : nullptr;
        if (node && (node != child || !(tile ? tile == installedBinOf(*child) : holdsTiles(*child)))) return false;
        if (!child || node) continue;
        if (!isWithoutTiles(i, *child, moved) && firstTile(*child)) return false;
        areModels[i] = true;
    }
    _isWithoutTiles = std::move(areModels);
    _nodes.resize(count);
    _tiles.resize(count);
    _children.resize(count);
    for (unsigned int i = 0; i < count; ++i) {
        _children[i] = group.getChild(i);
        const auto* const tile = _tiles[i].callback();
        if (tile && tile->getInstalledTile()->has(InstalledTile::MeshUnread)) _tiles[i] = FamilyTile(*_nodes[i], *tile);
    }
    if (_isDoubted.exchange(false)) _block->columnUnion().addDoubts(-1);
    return true;
}

// Children move where those before them come and go.
bool TileFamily::isWithoutTiles(unsigned int slot, const osg::Node& child, int& moved) const {
    for (const int more : {0, 1, -1, 2, -2, 3, -3}) {
        const auto stood = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(slot) + moved + more);
        if (!isKnown(stood, child)) continue;
        moved += more;
        return _isWithoutTiles[stood];
    }
    return false;
}

bool TileFamily::addFamilyOf(osg::Node& child, std::size_t slot) {
    const TileFamily* const below = familyOf(child);
    const bool isBelow = below && !_nodes[slot] && below->_group == &child && below->_ellipsoid &&
                         child.getNumParents() == 1 && isExactly<osg::Group>(child) &&
                         !(_ellipsoid && *_ellipsoid != *below->_ellipsoid);
    if (!isBelow) return false;
    _nodes[slot] = &child;
    _ellipsoid = below->_ellipsoid;
    below->_block->columnUnion().setAbove(&_block->columnUnion());
    return true;
}

// Children that are neither tiles nor groups with families. A child that came after bins were installed is not missed,
// whatever it holds: tiles that the application adds cover nothing.
void TileFamily::addOthers(osg::Group& group, const TileFamily* old) {
    std::unordered_set<const osg::Node*> above, without;
    if (old) {
        above.insert(old->_nodes.begin(), old->_nodes.end());
        for (std::size_t i = 0; i < old->_children.size(); ++i)
            if (old->_isWithoutTiles[i]) without.insert(old->_children[i]);
    }
    _isWithoutTiles.resize(_nodes.size());
    for (unsigned int i = 0; i < group.getNumChildren(); ++i) _children.push_back(group.getChild(i));
    bool hasModels = false;
    for (unsigned int i = 0; i < _nodes.size(); ++i) {
        osg::Node* const child = group.getChild(i);
        if (_nodes[i]) continue;
        if ((!old || above.count(child) != 0) && holdsTiles(*child)) {
            _nodes[i] = child;
            _hasOthers = true;
        } else if (without.count(child) != 0 || !firstTile(*child)) {
            _isWithoutTiles[i] = true;
            hasModels = true;
        }
    }
    // with models among the children it selects even without tiles to test, so that walks skip the models
    for (std::size_t i = 0; hasModels && isPlain(group) && !_ellipsoid && i < _nodes.size(); ++i) {
        const AnalyticBinCullCallback* const tile = _nodes[i] ? firstTile(*_nodes[i]) : nullptr;
        if (tile) _ellipsoid = tile->ellipsoid();
    }
}

bool TileFamily::hasChanged(const osg::Group& group) const {
    bool isSame = group.getNumChildren() == _children.size();
    for (unsigned int i = 0; isSame && i < group.getNumChildren(); ++i) isSame = group.getChild(i) == _children[i];
    return !isSame;
}

bool TileFamily::hasLost(const osg::Group& group, bool areTilesTested) const {
    const bool isLookedFor = _hasGroups || _hasOthers || !areTilesTested;
    return _hasLostTiles || (isLookedFor && hasChanged(group) && !holdsAll(group, _nodes));
}

bool TileFamily::needsWatch(const osg::Node& group) {
    const TileFamily* const family = familyOf(group);
    return family && (family->_hasTiles || family->_hasGroups);
}

const TileFamily* TileFamily::of(const osg::Node& group) {
    const TileFamily* const family = familyOf(group);
    return family && family->_group == &group ? family : nullptr;
}

void TileFamily::look(const osg::Node& node) {
    const TileFamily* const family = of(node);
    if (!family || !family->hasChanged(*node.asGroup())) return;
    if (!family->_isDoubted.exchange(true)) family->_block->columnUnion().addDoubts(1);
}

const ColumnUnion* TileFamily::columnUnion(const osg::Group& group) const {
    if (_group != &group) return nullptr;
    const ColumnUnion& columns = _block->columnUnion();
    const bool isInTree = _hasGroups || columns.above();
    return isInTree && columns.isSure() ? &columns : nullptr;
}

const ColumnUnion* TileFamily::columnUnionOf(osg::Group& group) {
    const TileFamily* const family = familyOf(group);
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
    _tiles[slot] = FamilyTile(child, *tile);
    tile->getInstalledTile()->joinFamily(*_block, slot);
    tile->fillSlot();
    return true;
}

// The same conditions as in AnalyticBinCullCallback::isCulled() and viewOn(), for all tiles together.
bool TileFamily::culls(const osg::Node& group, const DatabaseView& view) const {
    osg::CullStack& cullStack = view.cullStack;
    const osg::CullingSet::Mask mask = cullStack.getCurrentCullingSet().getCullingMask();
    return &group == _group && !getNestedCallback() && (mask & osg::CullingSet::VIEW_FRUSTUM_CULLING) &&
           view.modelView == cullStack.getModelViewMatrix() && view.projection == cullStack.getProjectionMatrix() &&
           _ellipsoid && view.ellipsoid == *_ellipsoid && (!_shape || *_shape == view.shape) &&
           !hasActiveOccluders(cullStack);
}

void TileFamily::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    CullTraversal* const traversal = nv->asCullStack() ? &CullTraversal::of(*nv) : nullptr;
    const DatabaseView* const view =
        traversal && !traversal->statistics().isTileByTile() ? traversal->databaseView() : nullptr;
    if (!view || !culls(*node, *view)) {
        traverse(node, nv);
        return;
    }
    draw(*node->asGroup(), *view);
}

void TileFamily::test(const osg::Group& group, unsigned int first, const core::PlaneSet& planes,
                      core::PlaneMask undecided, const Hiding& hiding, bool obeyDepth, Verdicts& verdicts) const {
    verdicts.beyond = verdicts.members = verdicts.tested = verdicts.hidden = verdicts.separated = 0;
    verdicts.lacksTiles = false;
    if (first >= _block->size()) return;
    const TileBlock::Part& part = _block->partFrom(first);
    // models may come in thousands
    if (part.members == 0) return;
    part.bins.classify(planes, undecided, verdicts.planes);
    verdicts.tested = part.bins.filled();
    const bool isNear = (part.columns.center() - hiding.at).length() + part.columns.radius() < hiding.tangent;
    verdicts.beyond =
        hiding.eye && !isNear ? part.bins.hiddenFrom(*hiding.eye, verdicts.tested & ~verdicts.planes.outside) : 0;
    verdicts.hidden = obeyDepth ? hideable(first, verdicts.beyond & part.hideable) : 0;
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

void TileFamily::noteMemory(Footprint::Notes& notes, const osg::Group& level) const {
    notes.add(&level, sizeof level);
    notes.addChildren(level);
    notes.add(this, sizeof *this);
    notes.add(_block.get(), sizeof *_block);
    notes.add(_nodes.data(), _nodes.size() * sizeof _nodes[0]);
    if (_nodes.empty()) return;
    const TileBlock::Part& part = _block->partFrom(0);
    notes.add(&part, sizeof part);
    notes.add(part.bins.numbers(), part.bins.bytes());
    notes.add(&(*_block)[0], _block->size() * sizeof(TileBlock::Slot));
    notes.add(_tiles.data(), _tiles.size() * sizeof _tiles[0]);
}

// A state or a callback that the application has set since then is asked for.
std::uint64_t TileFamily::hideable(unsigned int first, std::uint64_t tiles) const {
    std::uint64_t hideable = tiles;
    forEachBit(tiles, [&](unsigned int number) {
        const osg::Node* const node = _nodes[first + number];
        const bool obeysDepth = !node || (drawnStateOf(*node, {_trustsShaders}).obeysDepth &&
                                          !hasForeignCallback<AnalyticBinCullCallback>(*node));
        if (!obeysDepth) hideable &= ~(std::uint64_t{1} << number);
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
                                  : _tiles[first + number].callback()->isBeyondAnEdge(planes, undecided);
        if (isBeyond) verdicts.separated |= std::uint64_t{1} << number;
    });
}

}  // namespace osgAnalyticBin
