// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SelectionWalk.h"

#include "../../core/Bits.h"
#include "../Classes.h"
#include "../GlmBridge.h"
#include "../PagedChildren.h"
#include "../Scoped.h"
#include "../tile/BoundWatch.h"
#include "../tile/InstalledTile.h"
#include "CullCallbacks.h"
#include "CullScopes.h"

#include <osg/LOD>
#include <osg/PagedLOD>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

TileFamily::Hiding hidingFrom(const DatabaseView& view, const core::HorizonEye* eye) {
    TileFamily::Hiding hiding{eye};
    if (!eye || !(eye->data().cosDip > 0.0)) return hiding;
    // In the space where the ellipsoid is the unit sphere, a length is at most that in metres over the smaller radius.
    const core::Ellipsoid& ellipsoid = view.ellipsoid;
    const double smaller = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    hiding.at = view.visitor.getViewPoint();
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

SelectionWalk::SelectionWalk(const DatabaseView& view, const core::HorizonEye* eye, const Search* search)
    : _view(view),
      _visitor(view.visitor),
      _selection(*view.selection),
      _hiding(hidingFrom(view, eye)),
      _search(search ? *search : Search()),
      _isPlainVisitor(isPlain(view.visitor)),
      _planes(testedPlanes(view.cullStack.getCurrentCullingSet())),
      _searches(search) {
    const osg::CullingSet& cullingSet = view.cullStack.getCurrentCullingSet();
    _testsSmallFeatures = (cullingSet.getCullingMask() & osg::CullingSet::SMALL_FEATURE_CULLING) != 0;
    if (!(cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING)) return;
    _undecided = cullingSet.getFrustum().getCurrentMask();
}

void SelectionWalk::select(osg::Group& root) {
    _selection.begin(TileSelection::Conditions::of(_visitor, _view.cullStack));
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
    const bool isPassed = _searches && family && !_toEcef && isPassedOver(group, *family);
    const Scoped searches(_searches, _searches && !isPassed);
    if (!_searches && !_keeps) return;
    const bool isFamily = family && !_toEcef && family->culls(group, _view);
    if (family && family->hasLost(group, isFamily)) doubt();
    if (isFamily && _keeps && _segment == TileSelection::kNone) return void(selectBelow(group, *family));
    if (isFamily) return selectFamily(group, *family);
    if (family && _keeps && family->hasChanged(group)) _view.database->noteChanged(group);
    int moved = 0;
    for (unsigned int i = 0; i < group.getNumChildren() && !_hasHole; ++i) {
        osg::Node& child = *group.getChild(i);
        if (!family || !family->isWithoutTiles(i, child, moved)) selectNode(child);
    }
}

// Whether all columns below a group are out of view, and none is about the eye.
bool SelectionWalk::isPassedOver(const osg::Group& group, const TileFamily& family) {
    const ColumnUnion* const columns = family.columnUnion(group);
    if (!columns || !columns->sphere().valid()) return false;
    // unions are expanded column by column
    constexpr double kRounding = 1e-9;
    const osg::Vec3d& center = columns->sphere().center();
    const double radius = columns->sphere().radius() + kRounding * (center.length() + columns->sphere().radius());
    if (!isBesideFrustum(center, radius) || (_search.place && isOverEye(center, radius))) return false;
    // without it children may have changed unnoticed
    return BoundWatch::isOn(group);
}

// Whether a sphere is about the eye or above it.
bool SelectionWalk::isOverEye(const osg::Vec3d& center, double radius) {
    if (!_up) _up = toOsg(_view.ellipsoid.up(_search.place->latitude, _search.place->longitude));
    const osg::Vec3d toCenter = center - _search.eye;
    return (toCenter - *_up * std::max(0.0, toCenter * *_up)).length() <= radius;
}

// As isAbout(), by what is at hand. Requires: a place.
bool SelectionWalk::mayBeAbout(const TileBlock::Slot& tile) const {
    constexpr double kRounding = 1e-6;  // of numbers in floats, and more
    const double altitude = _search.place->altitude;
    if (altitude > tile.altitude.upper) return false;
    // an eye below the bin is not in its sphere
    const bool isInSphere = altitude >= tile.altitude.lower && _view.shape.techniqueMargin == 0.0;
    if (!isInSphere || !tile.column.valid()) return true;
    const osg::Vec3d center = tile.column.center();
    const double radius = tile.column.radius();
    const double size = std::abs(center.x()) + std::abs(center.y()) + std::abs(center.z()) + radius;
    const double reach = radius + kRounding * size;
    return (_search.eye - center).length2() <= reach * reach;
}

// Does not read tiles that are neither kept nor searched.
void SelectionWalk::selectFamily(osg::Group& group, const TileFamily& family) {
    const unsigned int children = group.getNumChildren();
    if (children < family.size()) doubt();
    bool isChanged = children != family.size();
    int moved = 0;
    if (_keeps) _selection.addFamily(family);
    Siblings siblings{family};
    const TileFamily::Verdicts& verdicts = siblings.verdicts;
    for (unsigned int first = 0; first < children && !_hasHole; first += TileBlock::Part::kMost) {
        family.test(group, first, _view.planes, _undecided, _hiding, !_ignoresDepth, siblings.verdicts);
        if (verdicts.lacksTiles) doubt();
        isChanged = isChanged || verdicts.lacksTiles;
        siblings.kept = _keeps ? keptOf(family, first, verdicts) : 0;
        if (first < family.block().size()) describe(siblings, family.block().partFrom(first));
        forEachBit(_view.isCold ? siblings.kept : 0,
                   [&](unsigned int number) { family.tile(first + number).fetch(family.node(first + number)); });
        const unsigned int here = std::min<unsigned int>(TileBlock::Part::kMost, children - first);
        const std::uint64_t passedOver = verdicts.members & ~(siblings.kept | siblings.searched);
        forEachBit(lowestBits(here) & ~passedOver, [&](unsigned int number) {
            if (_hasHole || first + number >= group.getNumChildren()) return;
            osg::Node& child = *group.getChild(first + number);
            if (hasBit(verdicts.members, number)) return selectMember(child, siblings, first + number);
            isChanged = isChanged || !family.isKnown(first + number, child);
            if (!family.isWithoutTiles(first + number, child, moved)) return selectNode(child);
            osg::CullingSet& cullingSet = _view.cullStack.getCurrentCullingSet();
            if (!_keeps || (_isPlainVisitor && isLeftOutAtOnce(cullingSet, _undecided, child))) return;
            (void)keep(child, nullptr, Way::Plain);
        });
    }
    if (isChanged && _keeps) _view.database->noteChanged(group);
}

// Of the family's tiles, those that are neither out of view nor small. Counts them.
std::uint64_t SelectionWalk::keptOf(const TileFamily& family, unsigned int first,
                                    const TileFamily::Verdicts& verdicts) {
    const std::uint64_t inside = verdicts.members & verdicts.tested & verdicts.planes.insideAll;
    std::uint64_t culled = verdicts.members & verdicts.outOfView();
    osg::CullingSet& cullingSet = _view.cullStack.getCurrentCullingSet();
    if (_testsSmallFeatures) {
        forEachBit(verdicts.members & ~culled, [&](unsigned int number) {
            const unsigned int slot = first + number;
            if (isSmallTile(cullingSet, family.block()[slot].bound, family.node(slot)))
                culled |= std::uint64_t{1} << number;
        });
    }
    TileSelection::Segment& segment = _selection.segment(_segment);
    segment.counts.outside += countBits(culled);
    segment.counts.inside += countBits(inside & ~culled);
    segment.counts.straddling += countBits(verdicts.members & ~culled & ~inside);
    segment.counts.hidden += countBits(verdicts.members & verdicts.hidden);
    segment.counts.beyondEdge += countBits(verdicts.members & verdicts.separated);
    segment.hides = segment.hides || (verdicts.members & verdicts.hidden) != 0;
    if (first >= family.block().size()) return 0;
    forEachBit(verdicts.members & ~culled & family.block().partFrom(first).withSpheres, [&](unsigned int number) {
        core::PlaneMask undecided = verdicts.planes.undecided[number];
        if (isSphereCulled(cullingSet, undecided, family.node(first + number))) culled |= std::uint64_t{1} << number;
    });
    if (_view.gain) countGain(family, first, verdicts.members, culled);
    return verdicts.members & ~culled;
}

// What bins gain over OSG's tests of spheres.
void SelectionWalk::countGain(const TileFamily& family, unsigned int first, std::uint64_t members,
                              std::uint64_t culled) {
    Gain& gain = *_view.gain;
    forEachBit(members, [&](unsigned int number) {
        const osg::Node& node = family.node(first + number);
        core::PlaneMask undecided = _undecided;
        const bool isInView = !isSphereCulled(_view.cullStack.getCurrentCullingSet(), undecided, node);
        const bool isKept = !hasBit(culled, number);
        if (isKept || isInView) gain.count(isKept);
        if (isKept && !isInView) ++gain.mended;
    });
}

// Which of them are searched for evidence. Tiles out of view that are not about the eye, and whose column is the bin or
// reaches no deeper than the occluder, are passed over: lines of sight would meet the bin before the occluder.
void SelectionWalk::describe(Siblings& siblings, const TileBlock::Part& part) const {
    siblings.certain = part.certain.load(std::memory_order_relaxed);
    if (!_searches) return;
    const TileFamily::Verdicts& verdicts = siblings.verdicts;
    const std::uint64_t outOfView = verdicts.outOfView() | verdicts.beyond;
    siblings.inView = verdicts.tested & ~outOfView;
    siblings.mayHoldEye = _search.place && _search.place->altitude <= part.highest;
    siblings.withColumns = part.lowest < -_search.occluder ? part.withOwnColumns : 0;
    siblings.searched = siblings.mayHoldEye ? verdicts.members : verdicts.members & (~outOfView | siblings.withColumns);
}

// Whether lines of sight pass through the column of a tile out of view, above its surface.
bool SelectionWalk::isColumnSeen(const TileBlock::Slot& numbers, const TileBlock& block, unsigned int slot) const {
    if (numbers.altitude.lower >= -_search.occluder || isBesideFrustum(numbers.column)) return false;
    return !_hiding.eye || !block.isColumnHidden(slot, *_hiding.eye);
}

void SelectionWalk::selectMember(osg::Node& node, const Siblings& siblings, unsigned int slot) {
    const unsigned int number = slot % TileBlock::Part::kMost;
    const TileBlock& block = siblings.family.block();
    const FamilyTile& member = siblings.family.tile(slot);
    const TileBlock::Slot& numbers = block[slot];
    const bool isAboutEye = siblings.mayHoldEye && mayBeAbout(numbers) && isAbout(*member.callback());
    const bool isSearched = _searches && (hasBit(siblings.inView, number) || isAboutEye ||
                                          (hasBit(siblings.withColumns, number) && isColumnSeen(numbers, block, slot)));
    const Scoped searches(_searches, isSearched);
    const Scoped keeps(_keeps, hasBit(siblings.kept, number) && _visitor.validNodeMask(node));
    if (!_searches && !_keeps) return;
    const bool isAlone = member.isAlone(node, _view.cullStack);
    Tile tile{*member.callback(), numbers, true, &member, !_isPlainVisitor || !isAlone, isAboutEye};
    tile.isOutOfView = hasBit(siblings.verdicts.outOfView(), number);
    const DrawnState drawn = stateOf(node);
    const Scoped ignoresDepth(_ignoresDepth, _ignoresDepth || !drawn.obeysDepth);
    const Scoped undecided(_undecided, tile.isOutOfView ? _undecided : siblings.verdicts.planes.undecided[number]);
    // the spheres of those that are kept were tested
    const bool mayBeLeftOut = _searches && numbers.testsSphere && !hasBit(siblings.kept, number);
    const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || (mayBeLeftOut && isLeftOut(node)));
    const bool leavesOut = _searches && !isAlone && mayLeaveOut(CullCallbacks(node));
    tile.isCertain = hasBit(siblings.certain, number);
    const bool isSeeThrough = !tile.isCertain && member.callback()->getInstalledTile()->isSeeThrough();
    if (_isDoubtful || isSeeThrough || !drawn.hides || leavesOut || !_visitor.validNodeMask(node)) doubt();
    if (_hasHole || !(_searches || _keeps)) return;
    if (!_keeps) return searchTile(node, member.paged(), tile);
    const bool isDirect = _isPlainVisitor && member.isPossible() && member.isFirst(node);
    if (isDirect && isAlone && member.paged() && selectShownLevel(*member.paged(), tile)) return;
    const Way way = isAlone && member.isMesh(node) ? Way::Mesh : Way::Untested;
    if (way == Way::Mesh && _view.isCold) {
        Footprint::Notes notes(member.footprint());
        member.noteMesh(notes);
    }
    const bool waits = _view.fileEye && block.isHidden(slot, *_view.fileEye);
    tile.kept = keep(node, &member, isDirect ? way : Way::Tile, waits);
    tile.isEnteredByOsg = tile.isEnteredByOsg || member.paged();
    const Scoped segment(_segment, TileSelection::kNone), in(_in, TileSelection::kNone);
    if (_searches) searchTile(node, member.paged(), tile);
    _selection.endBelow(tile.kept);
}

TileSelection::Number SelectionWalk::keep(osg::Node& node, const FamilyTile* member, Way way, bool waits) {
    const auto end = static_cast<Number>(_selection.kept().size() + 1);
    return _selection.keep({&node, member, _in, end, _undecided, way, _searches, false, waits});
}

// As osg::PagedLOD::traverse() where one child is shown and no file is asked for. Returns: false where it is not so.
bool SelectionWalk::selectShownLevel(osg::PagedLOD& node, const Tile& tile) {
    const bool byDistance = node.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT;
    // evidence does not rely on sizes on screen
    if ((!byDistance && _searches) || node.getNumFileNames() == 0) return false;
    const float scale = _view.cullStack.getLODScale();
    if (!byDistance && !(scale > 0.0f)) return false;
    const osg::LOD::RangeList& ranges = node.getRangeList();
    const float range = byDistance ? _visitor.getDistanceToViewPoint(node.getCenter(), true)
                                   : _view.cullStack.clampedPixelSize(node.getBound()) / scale;
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
    const bool isFiner = !isMesh && isPaged(node, *shown);
    const TileFamily* const family = isFiner ? inlineFamily(level) : nullptr;
    if (_view.isCold) noteFootprint(node, *tile.member, level, family);
    if (isFiner) {
        doubtLevelsOf(tile);
        // OSG's test of the level's sphere is left out, because the tiles in it are tested
        family ? selectInside(*level.asGroup(), family) : selectNode(level);
        return true;
    }
    Tile here = tile;
    here.kept = keep(level, tile.member, isMesh ? Way::Mesh : Way::Plain);
    here.isEnteredByOsg = !isMesh || level.getCullCallback();
    if (_searches) show(here, level, true);
    return true;
}

// What was read of a tile on the way to the level that it shows. `family`: of the level; null: none.
void SelectionWalk::noteFootprint(const osg::PagedLOD& node, const FamilyTile& member, const osg::Node& level,
                                  const TileFamily* family) {
    const osg::LOD::RangeList& ranges = node.getRangeList();
    Footprint::Notes notes(member.footprint());
    notes.add(ranges.data(), ranges.size() * sizeof ranges[0]);
    notes.add(&node.getFileName(0), node.getNumFileNames() * sizeof(osg::PagedLOD::PerRangeData));
    notes.addChildren(node);
    if (member.isMesh(level)) member.noteMesh(notes);
    if (family) family->noteMemory(notes, *level.asGroup());
}

// The family of a plain group to which OSG's traversal would come next.
const TileFamily* SelectionWalk::inlineFamily(const osg::Node& node) const {
    const osg::Callback* const callback = node.getCullCallback();
    const bool isPossible = _keeps && _segment != TileSelection::kNone && _isPlainVisitor && callback &&
                            isExactly<TileFamily>(*callback) && isExactly<osg::Group>(node) &&
                            _visitor.validNodeMask(node);
    if (!isPossible) return nullptr;
    const auto* const family = static_cast<const TileFamily*>(callback->asNodeCallback());
    return family->culls(*node.asGroup(), _view) ? family : nullptr;
}

// The children of a plain group, which is entered.
void SelectionWalk::selectInside(osg::Group& group, const TileFamily* family) {
    const DrawnState drawn = stateOf(group);
    const Scoped doubtful(_isDoubtful, _isDoubtful || !drawn.hides);
    const Scoped ignoresDepth(_ignoresDepth, _ignoresDepth || !drawn.obeysDepth);
    const Scoped in(_in, _keeps ? _selection.enter(group, _in, _segment, nullptr, 0) : _in);
    if (family && family->hasLost(group, true)) doubt();
    if (family) return selectFamily(group, *family);
    for (unsigned int i = 0; i < group.getNumChildren() && !_hasHole; ++i) selectNode(*group.getChild(i));
}

void SelectionWalk::selectNode(osg::Node& node) {
    const bool isInSegment = _keeps && _segment != TileSelection::kNone;
    const TileFamily* const family = inlineFamily(node);
    const bool isPlainGroup = isInSegment && _isPlainVisitor && isExactly<osg::Group>(node) &&
                              (family || !node.getCullCallback()) && _visitor.validNodeMask(node) &&
                              !isPhotogrammetrySet(node);
    if (isPlainGroup) return selectGroup(node, family);
    if (!isInSegment) return searchNode(node);
    const Number kept = keep(node, nullptr, Way::Plain);
    const Scoped segment(_segment, TileSelection::kNone), in(_in, TileSelection::kNone);
    searchNode(node);
    _selection.endBelow(kept);
}

// A plain group, which OSG tests by its sphere.
void SelectionWalk::selectGroup(osg::Node& node, const TileFamily* family) {
    osg::Group& group = *node.asGroup();
    if (_searches && _view.gain) ++_view.gain->visits;
    // without evidence OSG's sphere is enough
    const Scoped searches(_searches, _searches && !(family && isPassedOver(group, *family)));
    const bool isTooSmall = _searches && !_isBelowOutOfView && isSmallFeature(node);
    const Scoped doubtful(_isDoubtful, _isDoubtful || isTooSmall);
    const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || (_searches && isLeftOut(node)));
    core::PlaneMask left = _undecided;
    const bool isCulled = isSphereCulled(_view.cullStack.getCurrentCullingSet(), left, node);
    const Scoped keeps(_keeps, _keeps && !isCulled);
    if (!_keeps && !_searches) return;
    const Scoped undecided(_undecided, left);
    selectInside(group, family);
}

}  // namespace osgAnalyticBin
