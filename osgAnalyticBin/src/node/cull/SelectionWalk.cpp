// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SelectionWalk.h"

#include "../../core/Bits.h"
#include "../Classes.h"
#include "../GlmBridge.h"
#include "../Inverse.h"
#include "../PagedChildren.h"
#include "../Scoped.h"
#include "../Spheres.h"
#include "../tile/BoundWatch.h"
#include "../tile/InstalledTile.h"
#include "BinCulling.h"
#include "CullCallbacks.h"
#include "GroundBelow.h"

#include <osgAnalyticBin/PhotogrammetrySet.h>

#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

osg::PagedLOD* pagedLod(osg::Node& node) {
    if (isExactly<osg::PagedLOD>(node)) return static_cast<osg::PagedLOD*>(&node);
    return dynamic_cast<osg::PagedLOD*>(&node);
}

// Whether a callback may change a part of a mesh after the search.
bool mayChange(const osg::Node& part) {
    return part.getUpdateCallback() || part.getEventCallback();
}

// Whether a node is no osgTerrain tile that has lost its technique.
bool isDrawnByTechnique(const osg::Node& node) {
    if (!isOneOf<osgTerrain::TerrainTile>(node)) return true;
    const auto& tile = static_cast<const osgTerrain::TerrainTile&>(node);
    return tile.getTerrainTechnique() || !hasBeenTraversed(tile);
}

TileFamily::Hiding hidingFrom(const SelectedView& selected, const core::HorizonEye* eye, const SightOverRegion* sight) {
    TileFamily::Hiding hiding{eye, sight};
    if (!eye || !(eye->data().cosDip > 0.0)) return hiding;
    // in the space where the occluder is a sphere; lengths are at most those on the ellipsoid over its smaller radius
    const core::Ellipsoid& ellipsoid = selected.view.ellipsoid;
    const double smaller = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    hiding.at = selected.visitor.getViewPoint();
    hiding.tangent = smaller * eye->data().scale * eye->data().sinDip / eye->data().cosDip;
    return hiding;
}

const osg::Polytope::PlaneList& testedPlanes(osg::CullingSet& cullingSet) {
    static const osg::Polytope::PlaneList none;
    const bool areTested = cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING;
    return areTested ? cullingSet.getFrustum().getPlaneList() : none;
}

// Whether OSG's traversal may be anticipated, where it goes through plain groups and levels of detail.
bool isPlain(const osg::NodeVisitor& visitor) {
    return isExactly<osgUtil::CullVisitor>(visitor) && visitor.getFrameStamp() &&
           visitor.getTraversalMode() == osg::NodeVisitor::TRAVERSE_ACTIVE_CHILDREN;
}

}  // namespace

// A tile that the walk has come to.
struct SelectionWalk::Tile {
    const AnalyticBinCullCallback& callback;
    const TileBlock::Slot& numbers;
    bool isFitted;             // to the shape in which the terrain is shown
    const FamilyTile* member;  // null: of no family
    bool isEnteredByOsg;       // which tests spheres within the tile
    bool isAboutEye;
    bool isOutOfView = false;
    bool isCertain = false;  // see InstalledTile; in doubt that has to be asked
    Number kept = TileSelection::kNone;
};

// While it exists, the walk is below a node that OSG enters by itself.
class SelectionWalk::Below {
public:
    Below(SelectionWalk& walk, Number kept)
        : _selection(walk._selection),
          _kept(kept),
          _segment(walk._segment, TileSelection::kNone),
          _in(walk._in, TileSelection::kNone) {}
    ~Below() { _selection.endBelow(_kept); }
    Below(const Below&) = delete;
    Below& operator=(const Below&) = delete;

private:
    TileSelection& _selection;
    const Number _kept;
    const Scoped<Number> _segment, _in;
};

SelectionWalk::SelectionWalk(const SelectedView& selected, const core::HorizonEye* eye, const SightOverRegion* sight)
    : SelectionWalk(selected, eye, sight, {std::nullopt, 0.0, 0.0, false}) {
    _searches = false;
}

SelectionWalk::SelectionWalk(const SelectedView& selected, const core::HorizonEye* eye, const SightOverRegion* sight,
                             const Search& search)
    : _selected(selected),
      _visitor(selected.visitor),
      _selection(*selected.view.selection),
      _hiding(hidingFrom(selected, eye, sight)),
      _place(search.place),
      _occluder(search.occluder),
      _deepest(search.deepest),
      _isEager(search.isEager),
      _isPlainVisitor(isPlain(selected.visitor)),
      _planes(testedPlanes(selected.cullStack.getCurrentCullingSet())),
      _searches(true) {
    const osg::CullingSet& cullingSet = selected.cullStack.getCurrentCullingSet();
    _testsSmallFeatures = (cullingSet.getCullingMask() & osg::CullingSet::SMALL_FEATURE_CULLING) != 0;
    if (!(cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING)) return;
    _undecided = cullingSet.getFrustum().getCurrentMask();
}

void SelectionWalk::select(osg::Group& root) {
    _selection.begin(TileSelection::Conditions::of(_visitor, _selected.cullStack));
    selectChildren(root, CullCallbacks(root).family);
}

TileSelection::Number SelectionWalk::selectBelow(osg::Group& group, const TileFamily& family) {
    const Number segment = _selection.beginSegment(family, _undecided);
    const Scoped inSegment(_segment, segment);
    selectFamily(group, family);
    _selection.endSegment(segment);
    return segment;
}

void SelectionWalk::selectChildren(osg::Group& group, const TileFamily* family) {
    if (family && !_toEcef && isPassedOver(group, *family)) return;
    if (family && family->hasLost(group)) doubt();
    const bool isFamily = family && !_toEcef && family->culls(group, _selected.cullStack, _selected.view);
    if (isFamily && _keeps && _segment == TileSelection::kNone) return void(selectBelow(group, *family));
    if (isFamily) return selectFamily(group, *family);
    for (unsigned int i = 0; i < group.getNumChildren() && !_hasHole; ++i) selectNode(*group.getChild(i));
}

// Whether all columns below a group are out of view, and none is about the eye.
bool SelectionWalk::isPassedOver(const osg::Group& group, const TileFamily& family) {
    const ColumnUnion* const columns = family.columnUnion(group);
    if (!columns || !columns->sphere().valid()) return false;
    // unions are expanded column by column
    constexpr double kRounding = 1e-9;
    const osg::Vec3d& center = columns->sphere().center();
    const double radius = columns->sphere().radius() + kRounding * (center.length() + columns->sphere().radius());
    if (!isBesideFrustum(center, radius) || (_place && isOverEye(center, radius))) return false;
    // without it children may have changed unnoticed
    return BoundWatch::isOn(group);
}

// Whether a sphere is about the eye or above it.
bool SelectionWalk::isOverEye(const osg::Vec3d& center, double radius) {
    const core::Ellipsoid& ellipsoid = _selected.view.ellipsoid;
    if (!_standing)
        _standing = {toOsg(ellipsoid.toEcef(*_place)), toOsg(ellipsoid.up(_place->latitude, _place->longitude))};
    const osg::Vec3d toCenter = center - _standing->at;
    return (toCenter - _standing->up * std::max(0.0, toCenter * _standing->up)).length() <= radius;
}

// Does not read tiles that are neither kept nor searched.
void SelectionWalk::selectFamily(osg::Group& group, const TileFamily& family) {
    const unsigned int children = group.getNumChildren();
    if (children < family.size()) doubt();
    bool isChanged = children != family.size();
    if (_keeps) _selection.addFamily(family);
    TileFamily::Verdicts verdicts;
    for (unsigned int first = 0; first < children && !_hasHole; first += TileBlock::Part::kMost) {
        family.test(group, first, _selected.view.planes, _undecided, _hiding, !_ignoresDepth, verdicts);
        if (verdicts.lacksTiles) doubt();
        isChanged = isChanged || verdicts.lacksTiles;
        const std::uint64_t kept = _keeps ? keptOf(family, first, verdicts) : 0;
        const std::uint64_t notSearched = _searches && first < family.size()
                                              ? notSearchedIn(verdicts, family.block().partFrom(first))
                                              : verdicts.members;
        constexpr unsigned int kLinesOfTile = 5;
        forEachBit(kept, [&](unsigned int number) { prefetchNode(family.node(first + number), kLinesOfTile); });
        const unsigned int here = std::min<unsigned int>(TileBlock::Part::kMost, children - first);
        forEachBit(lowestBits(here) & ~(notSearched & ~kept), [&](unsigned int number) {
            if (_hasHole || first + number >= group.getNumChildren()) return;
            osg::Node& child = *group.getChild(first + number);
            if (!hasBit(verdicts.members, number)) return selectNode(child);
            selectMember(child, family, verdicts, first + number, hasBit(kept, number));
        });
    }
    if (isChanged && _keeps) _selected.view.database->noteChanged(group);
}

// Of the family's tiles, those that are neither out of view nor small. Counts them.
std::uint64_t SelectionWalk::keptOf(const TileFamily& family, unsigned int first,
                                    const TileFamily::Verdicts& verdicts) {
    const std::uint64_t inside = verdicts.members & verdicts.tested & verdicts.planes.insideAll;
    std::uint64_t culled = verdicts.members & verdicts.outOfView();
    osg::CullingSet& cullingSet = _selected.cullStack.getCurrentCullingSet();
    if (_testsSmallFeatures) {
        forEachBit(verdicts.members & ~culled, [&](unsigned int number) {
            if (isSmall(cullingSet, family.block()[first + number].bound)) culled |= std::uint64_t{1} << number;
        });
    }
    TileSelection::Segment& segment = _selection.segment(_segment);
    segment.counts.outside += countBits(culled);
    segment.counts.inside += countBits(inside & ~culled);
    segment.counts.straddling += countBits(verdicts.members & ~culled & ~inside);
    segment.counts.hidden += countBits(verdicts.members & verdicts.hidden);
    segment.counts.beyondEdge += countBits(verdicts.members & verdicts.separated);
    segment.hides = segment.hides || (verdicts.members & verdicts.hidden) != 0;
    if (first >= family.size()) return 0;
    forEachBit(verdicts.members & ~culled & family.block().partFrom(first).withSpheres, [&](unsigned int number) {
        core::PlaneMask undecided = verdicts.planes.undecided[number];
        if (isSphereCulled(cullingSet, undecided, family.node(first + number).getBound()))
            culled |= std::uint64_t{1} << number;
    });
    return verdicts.members & ~culled;
}

// Tiles out of view that are not about the eye, and whose column is the bin or reaches no deeper than the occluder:
// lines of sight would meet the bin before the occluder.
std::uint64_t SelectionWalk::notSearchedIn(const TileFamily::Verdicts& verdicts, const TileBlock::Part& part) const {
    if (_place && _place->altitude <= part.highest) return 0;
    const std::uint64_t withColumns = part.lowest < -_occluder ? part.withOwnColumns : 0;
    return verdicts.members & (verdicts.outOfView() | verdicts.beyond) & ~withColumns;
}

bool SelectionWalk::isSearched(const Tile& tile, const TileFamily& family, const TileFamily::Verdicts& verdicts,
                               unsigned int slot) const {
    const unsigned int number = slot % TileBlock::Part::kMost;
    const bool isInView = hasBit(verdicts.tested, number) && !hasBit(verdicts.outOfView() | verdicts.beyond, number);
    if (isInView || tile.isAboutEye) return true;
    const bool isBin = !hasBit(family.block().partFrom(slot).withOwnColumns, number);
    if (isBin || tile.numbers.binLow >= -_occluder || isBesideFrustum(tile.numbers.column)) return false;
    return !_hiding.eye || !family.block().isColumnHidden(slot, *_hiding.eye);
}

void SelectionWalk::selectMember(osg::Node& node, const TileFamily& family, const TileFamily::Verdicts& verdicts,
                                 unsigned int slot, bool isKept) {
    const unsigned int number = slot % TileBlock::Part::kMost;
    const FamilyTile& member = family.tile(slot);
    const TileBlock::Slot& numbers = family.block()[slot];
    const bool isAboutEye = _searches && _place && _place->altitude <= numbers.binHigh && isAbout(*member.callback());
    const bool isAlone = member.isAlone(node);
    Tile tile{*member.callback(), numbers, true, &member, !_isPlainVisitor || !isAlone, isAboutEye};
    tile.isOutOfView = hasBit(verdicts.outOfView(), number);
    const Scoped searches(_searches, _searches && isSearched(tile, family, verdicts, slot));
    const Scoped keeps(_keeps, isKept && _visitor.validNodeMask(node));
    if (!_searches && !_keeps) return;
    const DrawnState drawn = drawnStateOf(node, _selected.view.rules);
    const Scoped ignoresDepth(_ignoresDepth, _ignoresDepth || !drawn.obeysDepth);
    const Scoped undecided(_undecided, tile.isOutOfView ? _undecided : verdicts.planes.undecided[number]);
    const Scoped outOfView(_isBelowOutOfView,
                           _isBelowOutOfView || (_searches && numbers.testsSphere && isLeftOut(node)));
    const bool mayLeaveOut = _searches && !isAlone && CullCallbacks(node).mayLeaveOut;
    tile.isCertain = hasBit(family.block().partFrom(slot).certain.load(std::memory_order_relaxed), number);
    const bool isSeeThrough = !tile.isCertain && member.callback()->getInstalledTile()->isSeeThrough();
    if (_isDoubtful || isSeeThrough || !drawn.hides || mayLeaveOut || !_visitor.validNodeMask(node)) doubt();
    if (_hasHole) return;
    if (!_keeps) return searchTile(node, member.paged(), tile);
    const bool isDirect = _isPlainVisitor && member.isPossible() && member.isFirst(node);
    if (isDirect && isAlone && member.paged() && selectShownLevel(*member.paged(), tile)) return;
    const Way way = isAlone && member.isMesh(node) ? Way::Mesh : Way::Untested;
    tile.kept = keep(node, &member, isDirect ? way : Way::Tile);
    const Below below(*this, tile.kept);
    tile.isEnteredByOsg = tile.isEnteredByOsg || member.paged();
    if (_searches) searchTile(node, member.paged(), tile);
}

TileSelection::Number SelectionWalk::keep(osg::Node& node, const FamilyTile* member, Way way) {
    const auto end = static_cast<Number>(_selection.kept().size() + 1);
    const bool isLevel = way == Way::Mesh && member->paged();
    return _selection.keep({&node, member, _in, end, _undecided, way, isLevel, false});
}

// As osg::PagedLOD::traverse() where one child is shown and no file is asked for. Returns: false where it is not so.
bool SelectionWalk::selectShownLevel(osg::PagedLOD& node, const Tile& tile) {
    const bool byDistance = node.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT;
    // evidence does not rely on sizes on screen
    if ((!byDistance && _searches) || node.getNumFileNames() == 0) return false;
    const float scale = _selected.cullStack.getLODScale();
    if (!byDistance && !(scale > 0.0f)) return false;
    const osg::LOD::RangeList& ranges = node.getRangeList();
    const float range = byDistance ? _visitor.getDistanceToViewPoint(node.getCenter(), true)
                                   : _selected.cullStack.clampedPixelSize(node.getBound()) / scale;
    std::optional<unsigned int> shown;
    for (unsigned int i = 0; i < ranges.size(); ++i) {
        if (!(ranges[i].first <= range && range < ranges[i].second)) continue;
        if (shown || i >= node.getNumChildren()) return false;
        shown = i;
    }
    if (!shown) return false;
    osg::Node& level = *node.getChild(*shown);
    const Scoped in(_in, _selection.enter(node, _in, _segment, &node, *shown));
    const bool isMesh = tile.member->isMesh(level);
    if (!isMesh && isPaged(node, *shown)) {
        if (!tile.isCertain && tile.callback.getInstalledTile()->hasGapBelow()) doubt();
        selectLevel(level);
        return true;
    }
    Tile here = tile;
    here.kept = keep(level, tile.member, isMesh ? Way::Mesh : Way::Plain);
    here.isEnteredByOsg = !isMesh || level.getCullCallback();
    if (_searches) show(here, level, true);
    return true;
}

// The family of a plain group to which OSG's traversal would come next.
const TileFamily* SelectionWalk::inlineFamily(const osg::Node& node) const {
    const osg::Callback* const callback = node.getCullCallback();
    const bool isPossible = _keeps && _segment != TileSelection::kNone && _isPlainVisitor && callback &&
                            isExactly<TileFamily>(*callback) && isExactly<osg::Group>(node) &&
                            _visitor.validNodeMask(node);
    if (!isPossible) return nullptr;
    const auto* const family = static_cast<const TileFamily*>(callback->asNodeCallback());
    return family->culls(*node.asGroup(), _selected.cullStack, _selected.view) ? family : nullptr;
}

// A level from a file. OSG's test of its sphere is left out, because the tiles in it are tested.
void SelectionWalk::selectLevel(osg::Node& level) {
    const TileFamily* const family = inlineFamily(level);
    if (!family) return selectNode(level);
    const DrawnState drawn = drawnStateOf(level, _selected.view.rules);
    const Scoped doubtful(_isDoubtful, _isDoubtful || !drawn.hides);
    const Scoped ignoresDepth(_ignoresDepth, _ignoresDepth || !drawn.obeysDepth);
    const Scoped in(_in, _selection.enter(level, _in, _segment, nullptr, 0));
    if (family->hasLost(*level.asGroup())) doubt();
    selectFamily(*level.asGroup(), *family);
}

void SelectionWalk::selectNode(osg::Node& node) {
    const bool isInSegment = _keeps && _segment != TileSelection::kNone;
    const TileFamily* const family = inlineFamily(node);
    const bool isPlainGroup = isInSegment && _isPlainVisitor && isExactly<osg::Group>(node) &&
                              (family || !node.getCullCallback()) && _visitor.validNodeMask(node) &&
                              !isPhotogrammetrySet(node);
    if (isPlainGroup) return selectGroup(node, family);
    if (!isInSegment) return searchNode(node);
    const Below below(*this, keep(node, nullptr, Way::Plain));
    searchNode(node);
}

// A plain group, which OSG tests by its sphere.
void SelectionWalk::selectGroup(osg::Node& node, const TileFamily* family) {
    osg::Group& group = *node.asGroup();
    if (family && isPassedOver(group, *family)) return;
    const DrawnState drawn = drawnStateOf(node, _selected.view.rules);
    const bool isTooSmall = _searches && !_isBelowOutOfView && isSmallFeature(node);
    const Scoped doubtful(_isDoubtful, _isDoubtful || !drawn.hides || isTooSmall);
    const Scoped ignoresDepth(_ignoresDepth, _ignoresDepth || !drawn.obeysDepth);
    const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || (_searches && isLeftOut(node)));
    core::PlaneMask left = _undecided;
    const bool isCulled =
        node.isCullingActive() && isSphereCulled(_selected.cullStack.getCurrentCullingSet(), left, node.getBound());
    const Scoped keeps(_keeps, _keeps && !isCulled);
    if (!_keeps && !_searches) return;
    const Scoped undecided(_undecided, left);
    const Scoped in(_in, _keeps ? _selection.enter(node, _in, _segment, nullptr, 0) : _in);
    if (family && family->hasLost(group)) doubt();
    if (family) return selectFamily(group, *family);
    for (unsigned int i = 0; i < group.getNumChildren() && !_hasHole; ++i) selectNode(*group.getChild(i));
}

// For evidence, below what OSG enters by itself. The families there begin segments.
void SelectionWalk::searchNode(osg::Node& node) {
    if (!_searches) return;
    // most nodes that are no tiles are roots of files: plain groups
    const bool isGroup = isExactly<osg::Group>(node);
    const CullCallbacks callbacks(node);
    if (callbacks.bin) return searchTileWithoutFamily(node, *callbacks.bin, callbacks.mayLeaveOut);
    // another database is on a globe of its own, or in a map
    if (isPhotogrammetrySet(node) || (!isGroup && dynamic_cast<osg::CoordinateSystemNode*>(&node))) return;
    const osg::Transform* const transform = isGroup ? nullptr : node.asTransform();
    const bool isDrawn = isSurelyDrawn(node, callbacks.mayLeaveOut) && (isGroup || drawsAllChildren(node)) &&
                         !(transform && transform->getReferenceFrame() != osg::Transform::RELATIVE_RF);
    const Scoped ignoresDepth(_ignoresDepth, _ignoresDepth || !drawnStateOf(node, _selected.view.rules).obeysDepth);
    const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || isLeftOut(node));
    const bool isTooSmall = !_isBelowOutOfView && isSmallFeature(node);
    const Scoped doubtful(_isDoubtful, _isDoubtful || !isDrawn || isTooSmall);
    osg::Group* const group = node.asGroup();
    if (!group) return;
    if (!transform) return selectChildren(*group, callbacks.family);
    const osg::Matrixd toEcef = frameInside(node);
    const Scoped frame(_toEcef, &toEcef);
    selectChildren(*group, callbacks.family);
}

void SelectionWalk::searchTileWithoutFamily(osg::Node& node, const AnalyticBinCullCallback& bin, bool mayLeaveOut) {
    // the next update fits its bin to what its mesh has become
    const InstalledTile* const installed = bin.getInstalledTile();
    if (installed && installed->isMeshChanged() && installed->isKeptVisible()) doubt();
    TileBlock::Slot numbers;
    if (const osg::BoundingSphere* const column = bin.ecefColumnSphere()) numbers.column = *column;
    numbers.binLow = bin.getBinLow();
    numbers.binHigh = bin.getBinHigh();
    numbers.surfaceLow = bin.getSurfaceLow();
    numbers.surfaceHigh = bin.getSurfaceHigh();
    const bool isFitted = !bin.getTerrainShape() || *bin.getTerrainShape() == _selected.view.shape;
    const Tile tile{bin, numbers, isFitted, nullptr, true, isAbout(bin)};
    const bool isHidden = _hiding.eye && bin.isColumnHiddenFrom(*_hiding.eye);
    if (!tile.isAboutEye && (isBeside(tile) || isHidden)) return;
    // its place may be empty
    const bool isSeeThrough = installed && installed->isSeeThrough();
    if (_isDoubtful || isSeeThrough || !isSurelyDrawn(node, mayLeaveOut) || !standsAsInstalled(node, bin)) doubt();
    if (_hasHole) return;
    const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || isLeftOut(node));
    searchTile(node, pagedLod(node), tile);
}

void SelectionWalk::searchTile(osg::Node& node, osg::PagedLOD* paged, const Tile& tile) {
    paged ? searchPaged(*paged, tile) : show(tile, node, true);
}

// As osg::PagedLOD chooses; where that is not certain all that it may show counts.
void SelectionWalk::searchPaged(osg::PagedLOD& node, const Tile& tile) {
    const bool byDistance = node.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT && !_toEcef;
    const Scoped unknown(_isChoiceUnknown, _isChoiceUnknown || !byDistance);
    const float range = byDistance ? _visitor.getDistanceToViewPoint(node.getCenter(), true) : 0.0f;
    const unsigned int children = node.getNumChildren();
    const auto isDue = [&](unsigned int i) {
        return !byDistance || (range >= node.getMinRange(i) && range < node.getMaxRange(i));
    };
    unsigned int due = 0;
    bool isOwnShown = false;  // whatever else is shown then adds to it, and need not cover anything
    for (unsigned int i = 0; i < node.getNumRanges(); ++i) {
        if (!isDue(i)) continue;
        ++due;
        isOwnShown = isOwnShown || (byDistance && i < children && !isPaged(node, i));
    }
    bool isOneAwaited = !byDistance;
    for (unsigned int i = 0; i < node.getNumRanges(); ++i) {
        if (!isDue(i)) continue;
        const bool hadHole = _hasHole;
        if (i < children) searchChild(node, i, tile, byDistance && due == 1);
        if (isOwnShown && isPaged(node, i)) _hasHole = hadHole;
        isOneAwaited = isOneAwaited || i >= children;
    }
    // the last child stands in for one that is awaited
    if (isOneAwaited && children > 0 && !isOwnShown) searchChild(node, children - 1, tile, false);
    if (((byDistance && due == 0) || children == 0) && !isBeside(tile)) doubt();
}

void SelectionWalk::searchChild(osg::PagedLOD& node, unsigned int i, const Tile& tile, bool isOnlyLevel) {
    if (!isPaged(node, i)) return show(tile, *node.getChild(i), isOnlyLevel);
    const InstalledTile* const installed = tile.callback.getInstalledTile();
    if (installed && installed->hasGapBelow()) doubt();
    searchNode(*node.getChild(i));
}

// The altitudes of what a tile draws by itself. Its bin alone follows changes of the mesh.
core::Interval SelectionWalk::surfaceOf(const Tile& tile) {
    const InstalledTile* const installed = tile.isCertain ? nullptr : tile.callback.getInstalledTile();
    if (installed && installed->isMeshChanged()) return {tile.numbers.binLow, tile.numbers.binHigh};
    return {tile.numbers.surfaceLow, tile.numbers.surfaceHigh};
}

void SelectionWalk::show(const Tile& tile, osg::Node& mesh, bool isOnlyLevel) {
    if (tile.isAboutEye && _place->altitude <= surfaceOf(tile).upper) _nearGround.push_back({&tile.callback, &mesh});
    // tiles about the eye are searched even beside the frustum, for the ground alone
    if (tile.isAboutEye && isBeside(tile)) return;
    const InstalledTile* const installed = tile.isCertain ? nullptr : tile.callback.getInstalledTile();
    // the application's own tiles are not counted in what covers the globe
    if (installed && !installed->isFilled()) doubt();
    if (isLeftOutInView(tile, mesh)) doubt();
    if (_isEager && !isDrawnWhole(mesh, tile.callback, tile.member)) doubt();
    const bool isSure = !_isChoiceUnknown && tile.isFitted;
    _selection.addShown(
        {&tile.callback, &mesh, tile.member, isSure, isOnlyLevel, tile.isOutOfView, tile.kept, _segment});
    // what a tile draws by itself is in its bin
    if (tile.isFitted && tile.numbers.binLow >= -_depth) return;
    const double own = tile.isFitted ? -surfaceOf(tile).lower : std::numeric_limits<double>::infinity();
    _depth = std::max(_depth, std::min(own, _deepest));
}

bool SelectionWalk::areMeshesDrawn() const {
    constexpr std::size_t kAhead = 4;
    const std::vector<TileSelection::ShownTile>& shown = _selection.shown();
    for (std::size_t i = 0; i < shown.size() && !_isEager; ++i) {
        const FamilyTile* const next = i + kAhead < shown.size() ? shown[i + kAhead].member : nullptr;
        if (next) next->prefetchMesh();
        if (!isDrawnWhole(*shown[i].mesh, *shown[i].tile, shown[i].member)) return false;
    }
    return true;
}

// In ECEF.
osg::BoundingSphere SelectionWalk::sphereOf(const osg::Node& node) const {
    return _toEcef ? movedSphere(node.getBound(), *_toEcef) : node.getBound();
}

// Whether OSG finds the sphere of a node out of view. The sphere may be an application's own.
bool SelectionWalk::isLeftOut(const osg::Node& node) const {
    // OSG tests the planes that are left; below transforms, which are rare, all are taken
    const core::PlaneMask planes = _toEcef ? ~core::PlaneMask{0} : _undecided;
    if (planes == 0 || !node.isCullingActive()) return false;
    const osg::BoundingSphere sphere = sphereOf(node);
    if (!sphere.valid()) return false;
    const osg::Vec3d center(sphere.center());
    for (std::uint64_t left = planes & lowestBits(static_cast<unsigned int>(_planes.size())); left != 0;
         left &= left - 1) {
        if (_planes[firstBit(left)].distance(center) < -static_cast<double>(sphere.radius())) return true;
    }
    return false;
}

bool SelectionWalk::isSmallFeature(const osg::Node& node) const {
    return _testsSmallFeatures && node.isCullingActive() &&
           isSmall(_selected.cullStack.getCurrentCullingSet(), sphereOf(node));
}

// From the frame of what a node draws.
osg::Matrixd SelectionWalk::frameInside(const osg::Node& node) const {
    osg::Matrixd toEcef = _toEcef ? *_toEcef : osg::Matrixd();
    if (const osg::Transform* const transform = node.asTransform())
        transform->computeLocalToWorldMatrix(toEcef, nullptr);
    return toEcef;
}

// A tile may have several parents, and transforms above it may have changed.
bool SelectionWalk::standsAsInstalled(const osg::Node& node, const AnalyticBinCullCallback& tile) const {
    if (!_toEcef && !node.asTransform()) return tile.getLocalToEcef().isIdentity();
    const osg::Matrixd toEcef = frameInside(node);
    const double reach = _selected.view.ellipsoid.equatorialRadius() + toEcef.getTrans().length();
    return areNearlyEqual(toEcef, tile.getLocalToEcef(), reach);
}

bool SelectionWalk::isSurelyDrawn(const osg::Node& node, bool mayLeaveOut) const {
    const StateRules& rules = _selected.view.rules;
    // other classes, and their parts, were asked for when bins were installed
    const DrawnState drawn = node.asDrawable() ? drawnStateAt(node, rules) : drawnStateOf(node, rules);
    return _visitor.validNodeMask(node) && !mayLeaveOut && drawn.hides;
}

// Whether all of a tile's own mesh is drawn.
bool SelectionWalk::isDrawnWhole(const osg::Node& mesh, const AnalyticBinCullCallback& tile,
                                 const FamilyTile* member) const {
    if (!member || !member->isMesh(mesh)) {
        const InstalledTile* const installed = tile.getInstalledTile();
        const bool isMeshDoubted = !member && installed && installed->isMeshDoubted();
        bool hasDrawable = false;
        return isDrawnWhole(mesh, hasDrawable) && (hasDrawable || !isMeshDoubted);
    }
    if (member->isBareMesh(_visitor)) return true;
    for (std::size_t i = 0; const osg::Node* const part = member->part(i); ++i) {
        const bool mayLeaveOut = part->getCullCallback() && CullCallbacks(*part).mayLeaveOut;
        if (mayChange(*part) || !isSurelyDrawn(*part, mayLeaveOut)) return false;
        if (member->isTerrain(i) && !isDrawnByTechnique(*part)) return false;
    }
    return true;
}

bool SelectionWalk::isDrawnWhole(const osg::Node& part, bool& hasDrawable) const {
    if (mayChange(part) || !isSurelyDrawn(part, CullCallbacks(part).mayLeaveOut)) return false;
    const bool isTerrain = typeid(part) == typeid(osgTerrain::TerrainTile);
    hasDrawable = hasDrawable || isTerrain || part.asDrawable();
    if (isTerrain) return isDrawnByTechnique(part);
    if (!drawsAllChildren(part)) return false;
    const osg::Group* const group = part.asGroup();
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        if (!isDrawnWhole(*group->getChild(i), hasDrawable)) return false;
    }
    return true;
}

// Whether the eye may be within or below what the tile or its descendants draw.
bool SelectionWalk::isAbout(const AnalyticBinCullCallback& tile) const {
    if (!_place || _place->altitude > tile.getBinHigh()) return false;
    return isInColumn(*_place, tile, _selected.view.ellipsoid);
}

// Rays that are seen do not enter the occluder there: it lies below the ellipsoid, but it may lie above the tile.
bool SelectionWalk::isBeside(const Tile& tile) const {
    return tile.isFitted && isBesideFrustum(tile.numbers.column);
}

bool SelectionWalk::isBesideFrustum(const osg::Vec3d& center, double radius) const {
    return std::any_of(_planes.begin(), _planes.end(),
                       [&](const osg::Plane& plane) { return plane.distance(center) < -radius; });
}

// Whether OSG does not draw a mesh that may be in view, because of a sphere that does not hold it.
bool SelectionWalk::isLeftOutInView(const Tile& tile, const osg::Node& mesh) const {
    if (tile.isOutOfView && !_isBelowOutOfView) return false;
    // OSG may enter the mesh also where it is to be drawn directly
    const bool hasOwnBound = BoundWatch::hasOwnBound(mesh), isScaled = _selected.view.shape.verticalScale != 1.0;
    if ((hasOwnBound || (isScaled && tile.isEnteredByOsg)) && isLeftOut(mesh)) return true;
    return _isBelowOutOfView && (hasOwnBound || isScaled || !isBesideFrustum(sphereOf(mesh)));
}

}  // namespace osgAnalyticBin
