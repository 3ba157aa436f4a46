// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The evidence of a walk: whether all that hides is drawn.

#include "../../core/Bits.h"
#include "../../core/EarthScale.h"
#include "../Classes.h"
#include "../Inverse.h"
#include "../PagedChildren.h"
#include "../Scoped.h"
#include "../Spheres.h"
#include "../tile/BoundWatch.h"
#include "../tile/InstalledTile.h"
#include "CullCallbacks.h"
#include "CullScopes.h"
#include "SelectionWalk.h"

#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
#include <limits>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

osg::PagedLOD* pagedLod(osg::Node& node) {
    if (isExactly<osg::PagedLOD>(node)) return static_cast<osg::PagedLOD*>(&node);
    return dynamic_cast<osg::PagedLOD*>(&node);
}

// Whether the frame inside a node depends on the frame of its parent.
bool standsBelowParent(const osg::Node& node) {
    const osg::Transform* const transform = node.asTransform();
    return !transform || transform->getReferenceFrame() == osg::Transform::RELATIVE_RF;
}

// Whether a node is no osgTerrain tile that has lost the technique by which it was read. `isAny`: the application
// vouches for every technique.
bool isDrawnByTechnique(const osg::Node& node, bool isAny) {
    if (!isOneOf<osgTerrain::TerrainTile>(node)) return true;
    const auto& tile = static_cast<const osgTerrain::TerrainTile&>(node);
    return !hasBeenTraversed(tile) || (isAny ? tile.getTerrainTechnique() != nullptr : isDrawnByGeometry(tile));
}

// Whether the application computes the bound of a mesh, or of a part of it, by a callback of its own.
bool hasOwnBounds(const osg::Node& mesh) {
    if (BoundWatch::hasOwnBound(mesh)) return true;
    const osg::Group* const group = mesh.asGroup();
    bool has = false;
    for (unsigned int i = 0; group && !has && i < group->getNumChildren(); ++i) has = hasOwnBounds(*group->getChild(i));
    return has;
}

}  // namespace

// Of a node by its state alone. It matters for evidence, and where something may be hidden.
DrawnState SelectionWalk::stateOf(const osg::Node& node) const {
    return _searches || _hiding.eye ? drawnStateOf(node, _view.rules) : DrawnState();
}

// Where the application keeps its callbacks for clusters, or in a map, they cull. Where bins replace them they are
// idle.
bool SelectionWalk::mayLeaveOut(const CullCallbacks& callbacks) const {
    return callbacks.mayLeaveOut || (callbacks.isForClusters && cullsClusters(_view.cullStack));
}

// For evidence, below what OSG enters by itself. The families there begin segments.
void SelectionWalk::searchNode(osg::Node& node) {
    if (!_searches) return;
    if (_view.gain) ++_view.gain->visits;
    // most nodes that are no tiles are roots of files: plain groups
    const bool isGroup = isExactly<osg::Group>(node);
    const CullCallbacks callbacks(node);
    if (callbacks.bin) return searchTileWithoutFamily(node, *callbacks.bin, mayLeaveOut(callbacks));
    // another database is on a globe of its own, or in a map
    if (isPhotogrammetrySet(node) || (!isGroup && dynamic_cast<osg::CoordinateSystemNode*>(&node))) return;
    const osg::Transform* const transform = isGroup ? nullptr : node.asTransform();
    const DrawnState drawn = stateOf(node);
    const bool isDrawn = _visitor.validNodeMask(node) && !mayLeaveOut(callbacks) && drawn.hides &&
                         (isGroup || drawsAllChildren(node)) && standsBelowParent(node);
    const Scoped ignoresDepth(_ignoresDepth, _ignoresDepth || !drawn.obeysDepth);
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

void SelectionWalk::searchTileWithoutFamily(osg::Node& node, const AnalyticBinCullCallback& bin, bool leavesOut) {
    // the next update fits its bin to what its mesh has become
    const InstalledTile* const installed = bin.getInstalledTile();
    if (installed && installed->has(InstalledTile::MeshChanged) && installed->has(InstalledTile::Outgrown)) doubt();
    TileBlock::Slot numbers;
    if (const osg::BoundingSphere* const column = bin.ecefColumnSphere()) numbers.column = *column;
    numbers.altitude = {bin.getBinLow(), bin.getBinHigh()};
    numbers.surface = {bin.getSurfaceLow(), bin.getSurfaceHigh()};
    const bool isFitted = !bin.getTerrainShape() || *bin.getTerrainShape() == _view.shape;
    const Tile tile{bin, numbers, isFitted, nullptr, true, isAbout(bin)};
    const bool isHidden = _hiding.eye && bin.isColumnHiddenFrom(*_hiding.eye);
    if (!tile.isAboutEye && (isBeside(tile) || isHidden)) return;
    // its place may be empty
    const bool isSeeThrough = installed && installed->isSeeThrough();
    if (_isDoubtful || isSeeThrough || !isSurelyDrawn(node, leavesOut) || !standsAsInstalled(node, bin)) doubt();
    if (_hasHole || !_searches) return;
    const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || isLeftOut(node));
    searchTile(node, pagedLod(node), tile);
}

void SelectionWalk::searchTile(osg::Node& node, osg::PagedLOD* paged, const Tile& tile) {
    paged ? searchPaged(*paged, tile) : show(tile, node, true);
}

// As osg::PagedLOD chooses; where that is not certain all that it may show counts.
void SelectionWalk::searchPaged(osg::PagedLOD& node, const Tile& tile) {
    const bool byDistance = !_toEcef && choosesByDistance(node, _visitor);
    const Scoped unknown(_isChoiceUnknown, _isChoiceUnknown || !byDistance);
    const float range = byDistance ? _visitor.getDistanceToViewPoint(node.getCenter(), true) : 0.0f;
    const unsigned int children = node.getNumChildren();
    const auto isDue = [&](unsigned int i) { return !byDistance || isInRange(node, i, range); };
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
        const Scoped searches(_searches, _searches), added(_isAdded, _isAdded || (isOwnShown && isPaged(node, i)));
        // a level that only adds something, such as models, covers nothing
        const bool isCover = !(_isAdded && hasGapBelow(tile));
        if (i < children && isCover) searchChild(node, i, tile, byDistance && due == 1);
        isOneAwaited = isOneAwaited || i >= children;
    }
    // the last child stands in for one that is awaited
    if (isOneAwaited && children > 0 && !isOwnShown) {
        const Scoped awaited(_isFinerAwaited, byDistance);
        searchChild(node, children - 1, tile, false);
    }
    const bool isNoneDue = byDistance ? due == 0 : !isAlwaysDue(node);
    if ((isNoneDue || children == 0) && !isBeside(tile)) doubt();
}

void SelectionWalk::searchChild(osg::PagedLOD& node, unsigned int i, const Tile& tile, bool isOnlyLevel) {
    if (!isPaged(node, i)) return show(tile, *node.getChild(i), isOnlyLevel);
    doubtLevelsOf(tile);
    searchNode(*node.getChild(i));
}

// Of a tile whose levels in files are shown.
void SelectionWalk::doubtLevelsOf(const Tile& tile) {
    if (!_isAdded && hasGapBelow(tile)) doubt();
}

bool SelectionWalk::hasGapBelow(const Tile& tile) {
    const InstalledTile* const installed = tile.isCertain ? nullptr : tile.callback.getInstalledTile();
    return installed && installed->has(InstalledTile::GapBelow);
}

// The altitudes of what a tile draws by itself. Its bin alone follows changes of the mesh.
core::Interval SelectionWalk::surfaceOf(const Tile& tile) {
    const InstalledTile* const installed = tile.isCertain ? nullptr : tile.callback.getInstalledTile();
    if (installed && installed->has(InstalledTile::MeshChanged)) return tile.numbers.altitude;
    return tile.numbers.surface;
}

void SelectionWalk::show(const Tile& tile, osg::Node& mesh, bool isOnlyLevel) {
    if (tile.isAboutEye && _search.place->altitude <= surfaceOf(tile).upper)
        _nearGround.push_back({&tile.callback, &mesh, _isFinerAwaited});
    // tiles about the eye are searched even beside the frustum, for the ground alone
    if (tile.isAboutEye && isBeside(tile)) return;
    const InstalledTile* const installed = tile.isCertain ? nullptr : tile.callback.getInstalledTile();
    // the application's own tiles are not counted in what covers the globe
    if (installed && installed->has(InstalledTile::NotFilled)) doubt();
    if (isLeftOutInView(tile, mesh)) doubt();
    if (_search.isEager && !isDrawnWhole(mesh, tile.callback, tile.member)) doubt();
    const bool isSure = _searches && !_isChoiceUnknown && tile.isFitted;
    const bool isAll = isOnlyLevel && !(installed && installed->has(InstalledTile::MoreThanMesh));
    _selection.addShown({&tile.callback, &mesh, tile.member, isSure, isAll, tile.isOutOfView, tile.kept, _segment});
    // what a tile draws by itself is in its bin
    if (tile.isFitted && tile.numbers.altitude.lower >= -_depth) return;
    const double own = tile.isFitted ? -surfaceOf(tile).lower : std::numeric_limits<double>::infinity();
    _depth = std::max(_depth, std::min(own, _search.deepest));
}

bool SelectionWalk::areMeshesDrawn() const {
    const std::vector<ShownTile>& shown = _selection.shown();
    return _search.isEager || std::all_of(shown.begin(), shown.end(), [this](const ShownTile& tile) {
               return isDrawnWhole(*tile.mesh, *tile.tile, tile.member);
           });
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
    return sphere.valid() && isBesideFrustum(sphere.center(), sphere.radius(), planes);
}

bool SelectionWalk::isSmallFeature(const osg::Node& node) const {
    return _testsSmallFeatures && node.isCullingActive() &&
           isSmall(_view.cullStack.getCurrentCullingSet(), sphereOf(node));
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
    const double reach = _view.ellipsoid.equatorialRadius() + toEcef.getTrans().length();
    return areNearlyEqual(toEcef, tile.getLocalToEcef(), reach);
}

bool SelectionWalk::isSurelyDrawn(const osg::Node& node, bool leavesOut) const {
    const StateRules& rules = _view.rules;
    // other classes, and their parts, were asked for when bins were installed
    const DrawnState drawn = node.asDrawable() ? drawnStateByClass(node, rules) : drawnStateOf(node, rules);
    return _visitor.validNodeMask(node) && !leavesOut && drawn.hides && standsBelowParent(node);
}

// Whether all of a tile's own mesh is drawn.
bool SelectionWalk::isDrawnWhole(const osg::Node& mesh, const AnalyticBinCullCallback& tile,
                                 const FamilyTile* member) const {
    if (member && member->isMesh(mesh) && member->isDrawnWhole(_visitor, _view.cullStack, _view.rules)) return true;
    const InstalledTile* const installed = tile.getInstalledTile();
    const bool isMeshDoubted = !member && installed && installed->has(InstalledTile::MeshUnread);
    const bool isAny = tile.getCullOptions().techniqueMargin.has_value();
    bool hasDrawable = false;
    return isDrawnWhole(mesh, isAny, hasDrawable) && (hasDrawable || !isMeshDoubted);
}

bool SelectionWalk::isDrawnWhole(const osg::Node& part, bool isAnyTechnique, bool& hasDrawable) const {
    if (mayChange(part) || !isSurelyDrawn(part, mayLeaveOut(CullCallbacks(part)))) return false;
    const bool isTerrain = typeid(part) == typeid(osgTerrain::TerrainTile);
    hasDrawable = hasDrawable || isTerrain || part.asDrawable();
    if (isTerrain) return isDrawnByTechnique(part, isAnyTechnique);
    if (!drawsAllChildren(part)) return false;
    const osg::Group* const group = part.asGroup();
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        if (!isDrawnWhole(*group->getChild(i), isAnyTechnique, hasDrawable)) return false;
    }
    return true;
}

// Whether the eye may be within or below what the tile or its descendants draw. Another technique may draw beyond the
// latitudes and longitudes of the bin, by the margin that the application vouches for. A bin that is not valid may be
// anywhere.
bool SelectionWalk::isAbout(const AnalyticBinCullCallback& tile) const {
    if (!_search.place || _search.place->altitude > tile.getBinHigh()) return false;
    const core::GeodeticBin& bin = tile.getBin().bin();
    if (bin.empty()) return true;
    constexpr double kCurved = 1.1;  // arcs are longer than chords
    const double overhang = tile.getTerrainShape() ? tile.getTerrainShape()->techniqueMargin : 0.0;
    const double north = kCurved * overhang / core::smallestCurvatureRadius(_view.ellipsoid);
    const core::Interval& latitude = bin.latitude();
    if (_search.place->latitude < latitude.lower - north || _search.place->latitude > latitude.upper + north)
        return false;
    if (north == 0.0) return bin.contains({_search.place->latitude, _search.place->longitude, bin.altitude().middle()});
    const double east = north / std::max(std::cos(std::abs(_search.place->latitude) + north), 1e-9);
    return std::abs(std::remainder(_search.place->longitude - bin.longitude().middle(), 2.0 * osg::PI)) <=
           0.5 * bin.longitude().width() + east;
}

// Rays that are seen do not enter the occluder there: it lies below the ellipsoid, but it may lie above the tile.
bool SelectionWalk::isBeside(const Tile& tile) const {
    return tile.isFitted && isBesideFrustum(tile.numbers.column);
}

bool SelectionWalk::isBesideFrustum(const osg::Vec3d& center, double radius, core::PlaneMask planes) const {
    for (std::size_t i = 0; planes != 0 && i < _planes.size(); ++i, planes >>= 1) {
        if ((planes & 1) != 0 && _planes[i].distance(center) < -radius) return true;
    }
    return false;
}

// Whether OSG does not draw a mesh that may be in view, because of a sphere that does not hold it.
bool SelectionWalk::isLeftOutInView(const Tile& tile, const osg::Node& mesh) const {
    if (tile.isOutOfView && !_isBelowOutOfView) return false;
    // OSG may enter the mesh also where it is to be drawn directly
    const bool isScaled = _view.shape.verticalScale != 1.0;
    if (isLeftOut(mesh) && ((isScaled && tile.isEnteredByOsg) || hasOwnBounds(mesh))) return true;
    return _isBelowOutOfView && (isScaled || !isBesideFrustum(sphereOf(mesh)) || hasOwnBounds(mesh));
}

}  // namespace osgAnalyticBin
