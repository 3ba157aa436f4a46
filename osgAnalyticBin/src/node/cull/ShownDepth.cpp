// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShownDepth.h"

#include "../../core/Bits.h"
#include "../../core/EarthScale.h"
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
#include "CullTraversal.h"
#include "SearchMemory.h"
#include "TileFamily.h"
#include "TilePlan.h"

#include <osgAnalyticBin/PhotogrammetrySet.h>

#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>
#include <limits>
#include <typeinfo>
#include <vector>

namespace osgAnalyticBin {

namespace {

constexpr double kUnknownDepth = std::numeric_limits<double>::infinity();

osg::PagedLOD* pagedLod(osg::Node& node) {
    if (isExactly<osg::PagedLOD>(node)) return static_cast<osg::PagedLOD*>(&node);
    return dynamic_cast<osg::PagedLOD*>(&node);
}

// A tile that the search has come to.
struct SearchedTile {
    const AnalyticBinCullCallback& callback;
    const TileBlock::Slot& numbers;
    bool isFitted;                     // to the shape in which the terrain is shown
    const TileFamily::Member* member;  // null: of no family
    bool isEnteredByOsg;               // which tests spheres within the tile
    bool isAboutEye;
    std::size_t result = TilePlan::kAlone;  // of the family, in the plan
    unsigned int slot = 0;                  // in that result
};

// A surface that is shown about the place of the eye, no lower than the eye by its bounds.
struct NearGround {
    const AnalyticBinCullCallback* tile;
    osg::Node* mesh;
};

// Looks for the lowest surface among the tiles that an eye sees over its horizon.
class LowestShown {
public:
    // `eye` null: nothing is behind the horizon.
    LowestShown(const ShownDatabase& database, const core::HorizonEye* eye, const std::optional<core::Geodetic>& place,
                double deepest)
        : _database(database),
          _visitor(database.visitor),
          _traversal(CullTraversal::of(database.visitor)),
          _eye(eye),
          _place(place),
          _deepest(deepest) {
        if (database.view.plan) database.view.plan->clear();
        const osg::CullingSet& cullingSet = database.cullStack.getCurrentCullingSet();
        _testsSmallFeatures = (cullingSet.getCullingMask() & osg::CullingSet::SMALL_FEATURE_CULLING) != 0;
        if (!(cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING)) return;
        _planes = cullingSet.getFrustum().getPlaneList();
        _undecided = cullingSet.getFrustum().getCurrentMask();
    }

    void search(osg::Group& group) {
        const CullCallbacks callbacks(group);
        searchChildren(group, callbacks.family);
    }

    [[nodiscard]] double depth() const { return _depth; }
    // Whether the terrain in view may be left out somewhere, or be seen through.
    [[nodiscard]] bool hasHole() const { return _hasHole; }
    [[nodiscard]] const std::vector<NearGround>& nearGround() const { return _nearGround; }

private:
    void searchChildren(osg::Group& group, const TileFamily* family) {
        if (family && !_toEcef && isPassedOver(group, *family)) return;
        if (family && family->hasLost(group)) _hasHole = true;
        const bool isFamily = family && !_toEcef && family->culls(group, _database.cullStack, _database.view);
        if (isFamily) return searchFamily(group, *family);
        for (unsigned int i = 0; i < group.getNumChildren() && !_hasHole; ++i) searchNode(*group.getChild(i));
    }

    // Whether all columns below a group are out of view, and none is about the eye.
    [[nodiscard]] bool isPassedOver(const osg::Group& group, const TileFamily& family) {
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
    [[nodiscard]] bool isOverEye(const osg::Vec3d& center, double radius) {
        const core::Ellipsoid& ellipsoid = _database.view.ellipsoid;
        if (!_standing)
            _standing =
                StandingEye{toOsg(ellipsoid.toEcef(*_place)), toOsg(ellipsoid.up(_place->latitude, _place->longitude))};
        const osg::Vec3d toCenter = center - _standing->at;
        return (toCenter - _standing->up * std::max(0.0, toCenter * _standing->up)).length() <= radius;
    }

    // Does not read tiles that are passed over.
    void searchFamily(osg::Group& group, const TileFamily& family) {
        const unsigned int children = group.getNumChildren();
        if (children < family.size()) _hasHole = true;
        TileFamily::Verdicts verdicts;
        for (unsigned int first = 0; first < children && !_hasHole; first += TileBlock::Part::kMost) {
            const std::size_t result = test(group, family, first, verdicts);
            const unsigned int here = std::min<unsigned int>(TileBlock::Part::kMost, children - first);
            const std::uint64_t passedOver =
                first < family.size() ? passedOverIn(verdicts, family.block().partFrom(first)) : 0;
            // what the search reads of these tiles OSG's traversal reads, too
            family.fetchKept(first, verdicts);
            forEachBit(lowestBits(here) & ~passedOver, [&](unsigned int number) {
                if (_hasHole) return;
                osg::Node& child = *group.getChild(first + number);
                if (!hasBit(verdicts.members, number)) return searchNode(child);
                searchMember(child, family, verdicts, result, first + number);
            });
        }
    }

    // Returns: the number of the result in the plan.
    std::size_t test(const osg::Group& group, const TileFamily& family, unsigned int first,
                     TileFamily::Verdicts& verdicts) {
        const DatabaseView& view = _database.view;
        family.test(group, first, view.planes, _undecided, _eye, verdicts);
        if (verdicts.lacksTiles) _hasHole = true;
        if (!view.plan) return TilePlan::kAlone;
        return view.plan->add(family, first, _undecided, verdicts, group.getNumChildren() - first);
    }

    // Tiles out of view whose column is the bin, and that are not about the eye.
    [[nodiscard]] std::uint64_t passedOverIn(const TileFamily::Verdicts& verdicts, const TileBlock::Part& part) const {
        if (_place && _place->altitude <= part.highest) return 0;
        return verdicts.members & (verdicts.outOfView() | verdicts.beyond) & ~part.withOwnColumns;
    }

    void searchMember(osg::Node& node, const TileFamily& family, const TileFamily::Verdicts& verdicts,
                      std::size_t result, unsigned int slot) {
        const TileBlock& block = family.block();
        const unsigned int number = slot % TileBlock::Part::kMost;
        const TileFamily::Member& member = family.member(slot);
        const TileBlock::Slot& numbers = block[slot];
        const bool isAboutEye = _place && _place->altitude <= numbers.binHigh && isAbout(*member.tile);
        const bool isOutOfView = hasBit(verdicts.outOfView() | verdicts.beyond, number);
        const bool mayBePassedOver = isOutOfView || !hasBit(verdicts.tested, number);
        if (mayBePassedOver && !isAboutEye) {
            const bool isBin = !hasBit(block.partFrom(slot).withOwnColumns, number);
            const bool isHidden = _eye && block.isColumnHidden(slot, *_eye);
            if (isBin || isBesideFrustum(numbers.column) || isHidden) return;
        }
        const Scoped undecided(_undecided, isOutOfView ? _undecided : verdicts.planes.undecided[number]);
        const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || (numbers.testsSphere && isLeftOut(node)));
        const bool isAlone = TileFamily::isAlone(node, member);
        const bool mayLeaveOut = !isAlone && CullCallbacks(node).mayLeaveOut;
        searchTile(node, member.paged,
                   {*member.tile, numbers, true, &member, !_isPlainVisitor || !isAlone, isAboutEye, result, number},
                   mayLeaveOut);
    }

    void searchNode(osg::Node& node) {
        // most nodes that are no tiles are roots of files: plain groups
        const bool isGroup = isExactly<osg::Group>(node);
        const CullCallbacks callbacks(node);
        if (callbacks.bin) return searchTileWithoutFamily(node, *callbacks.bin, callbacks.mayLeaveOut);
        // another database is on a globe of its own, or in a map
        if (isPhotogrammetrySet(node) || (!isGroup && dynamic_cast<osg::CoordinateSystemNode*>(&node))) return;
        const osg::Transform* const transform = isGroup ? nullptr : node.asTransform();
        const bool isDrawn = isSurelyDrawn(node, callbacks.mayLeaveOut) && (isGroup || drawsAllChildren(node)) &&
                             !(transform && transform->getReferenceFrame() != osg::Transform::RELATIVE_RF);
        const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || isLeftOut(node));
        const bool isTooSmall = !_isBelowOutOfView && isSmallFeature(node);
        const Scoped doubtful(_isDoubtful, _isDoubtful || !isDrawn || isTooSmall);
        osg::Group* const group = node.asGroup();
        if (!group) return;
        if (!transform) return searchChildren(*group, callbacks.family);
        const osg::Matrixd toEcef = frameInside(node);
        const Scoped frame(_toEcef, &toEcef);
        searchChildren(*group, callbacks.family);
    }

    // In ECEF.
    [[nodiscard]] osg::BoundingSphere sphereOf(const osg::Node& node) const {
        return _toEcef ? movedSphere(node.getBound(), *_toEcef) : node.getBound();
    }

    // Whether OSG finds the sphere of a node out of view. The sphere may be an application's own.
    [[nodiscard]] bool isLeftOut(const osg::Node& node) const {
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

    [[nodiscard]] bool isSmallFeature(const osg::Node& node) const {
        return _testsSmallFeatures && node.isCullingActive() &&
               isSmall(_database.cullStack.getCurrentCullingSet(), sphereOf(node));
    }

    // From the frame of what a node draws.
    [[nodiscard]] osg::Matrixd frameInside(const osg::Node& node) const {
        osg::Matrixd toEcef = _toEcef ? *_toEcef : osg::Matrixd();
        if (const osg::Transform* const transform = node.asTransform())
            transform->computeLocalToWorldMatrix(toEcef, nullptr);
        return toEcef;
    }

    // A tile may have several parents, and transforms above it may have changed.
    [[nodiscard]] bool standsAsInstalled(const osg::Node& node, const AnalyticBinCullCallback& tile) const {
        if (!_toEcef && !node.asTransform()) return tile.getLocalToEcef().isIdentity();
        const osg::Matrixd toEcef = frameInside(node);
        const double reach = _database.view.ellipsoid.equatorialRadius() + toEcef.getTrans().length();
        return areNearlyEqual(toEcef, tile.getLocalToEcef(), reach);
    }

    void searchTileWithoutFamily(osg::Node& node, const AnalyticBinCullCallback& bin, bool mayLeaveOut) {
        // the next update fits its bin to what its mesh has become
        const InstalledTile* const installed = bin.getInstalledTile();
        if (installed && installed->isMeshChanged() && installed->isKeptVisible()) _hasHole = true;
        TileBlock::Slot numbers;
        if (const osg::BoundingSphere* const column = bin.ecefColumnSphere()) numbers.column = *column;
        numbers.binLow = bin.getBinLow();
        numbers.binHigh = bin.getBinHigh();
        numbers.surfaceLow = bin.getSurfaceLow();
        numbers.surfaceHigh = bin.getSurfaceHigh();
        const bool isFitted = !bin.getTerrainShape() || *bin.getTerrainShape() == _database.view.shape;
        const SearchedTile tile{bin, numbers, isFitted, nullptr, true, isAbout(bin)};
        const bool isHidden = _eye && bin.isColumnHiddenFrom(*_eye);
        if (!tile.isAboutEye && (isBeside(tile) || isHidden)) return;
        // its place may be empty
        if (!standsAsInstalled(node, bin)) _hasHole = true;
        const Scoped outOfView(_isBelowOutOfView, _isBelowOutOfView || isLeftOut(node));
        searchTile(node, pagedLod(node), tile, mayLeaveOut);
    }

    void searchTile(osg::Node& node, osg::PagedLOD* paged, const SearchedTile& tile, bool mayLeaveOut) {
        const InstalledTile* const installed = tile.callback.getInstalledTile();
        if (_isDoubtful || (installed && installed->isSeeThrough()) || !isSurelyDrawn(node, mayLeaveOut)) {
            _hasHole = true;
        } else if (paged) {
            searchPaged(*paged, tile);
        } else {
            show(tile, node, true);
        }
    }

    [[nodiscard]] bool isSurelyDrawn(const osg::Node& node, bool mayLeaveOut) const {
        const StateRules& rules = _database.view.rules;
        // other classes, and their parts, were asked for when bins were installed
        const DrawnState drawn = node.asDrawable() ? drawnStateAt(node, rules) : drawnStateOf(node, rules);
        return _visitor.validNodeMask(node) && !mayLeaveOut && drawn.hides;
    }

    // Whether a callback may change a part of a mesh after the search.
    [[nodiscard]] static bool mayChange(const osg::Node& part) {
        return part.getUpdateCallback() || part.getEventCallback();
    }

    // Whether all of a tile's own mesh is drawn.
    [[nodiscard]] bool isDrawnWhole(const osg::Node& mesh, const SearchedTile& tile) const {
        const bool isKnown = tile.member && tile.member->meshParts.front() == &mesh;
        if (!isKnown) {
            const InstalledTile* const installed = tile.callback.getInstalledTile();
            const bool isMeshDoubted = !tile.member && installed && installed->isMeshDoubted();
            bool hasDrawable = false;
            return isDrawnWhole(mesh, hasDrawable) && (hasDrawable || !isMeshDoubted);
        }
        const TileFamily::Member& member = *tile.member;
        for (std::size_t i = 0; i < member.meshParts.size() && member.meshParts[i]; ++i) {
            const osg::Node& part = *member.meshParts[i];
            const bool isDrawn =
                member.entry.isBare(i)
                    ? _visitor.validNodeMask(part)
                    : !mayChange(part) &&
                          isSurelyDrawn(part, part.getCullCallback() && CullCallbacks(part).mayLeaveOut) &&
                          (!member.hasTerrain || isDrawnByTechnique(part));
            if (!isDrawn) return false;
        }
        return true;
    }

    [[nodiscard]] bool isDrawnWhole(const osg::Node& part, bool& hasDrawable) const {
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
    [[nodiscard]] bool isAbout(const AnalyticBinCullCallback& tile) const {
        if (!_place || _place->altitude > tile.getBinHigh()) return false;
        return isInColumn(*_place, tile, _database.view.ellipsoid);
    }

    // Rays that are seen do not enter the occluder there: it lies below the ellipsoid, but it may lie above the tile.
    [[nodiscard]] bool isBeside(const SearchedTile& tile) const {
        return tile.isFitted && isBesideFrustum(tile.numbers.column);
    }

    [[nodiscard]] bool isBesideFrustum(const osg::BoundingSphere& sphere) const {
        return sphere.valid() && isBesideFrustum(sphere.center(), sphere.radius());
    }

    [[nodiscard]] bool isBesideFrustum(const osg::Vec3d& center, double radius) const {
        return std::any_of(_planes.begin(), _planes.end(),
                           [&](const osg::Plane& plane) { return plane.distance(center) < -radius; });
    }

    // Whether OSG does not draw a mesh that may be in view, because of a sphere that does not hold it.
    [[nodiscard]] bool isLeftOutInView(const SearchedTile& tile, const osg::Node& mesh) const {
        if (!tile.isEnteredByOsg && !_isBelowOutOfView) return false;
        const bool mayBeFalse = _database.view.shape.verticalScale != 1.0 || BoundWatch::hasOwnBound(mesh);
        if (tile.isEnteredByOsg && mayBeFalse && isLeftOut(mesh)) return true;
        return _isBelowOutOfView && (mayBeFalse || !isBesideFrustum(sphereOf(mesh)));
    }

    void show(const SearchedTile& tile, osg::Node& mesh, bool isOnlyLevel) {
        if (tile.isAboutEye && _place->altitude <= surfaceOf(tile).upper)
            _nearGround.push_back({&tile.callback, &mesh});
        // tiles about the eye are searched even beside the frustum, for the ground alone
        if (tile.isAboutEye && isBeside(tile)) return;
        const InstalledTile* const installed = tile.callback.getInstalledTile();
        // the application's own tiles are not counted in what covers the globe
        if ((installed && !installed->isFilled()) || !isDrawnWhole(mesh, tile)) _hasHole = true;
        if (isLeftOutInView(tile, mesh)) _hasHole = true;
        if (_database.findsOccluded && _database.view.plan) {
            const bool isSure = !_isChoiceUnknown && tile.isFitted;
            _database.view.plan->addShown({&tile.callback, &mesh, isSure, isOnlyLevel, tile.result, tile.slot});
        }
        // what a tile draws by itself is in its bin
        if (tile.isFitted && tile.numbers.binLow >= -_depth) return;
        const double own = tile.isFitted ? -surfaceOf(tile).lower : kUnknownDepth;
        _depth = std::max(_depth, std::min(own, _deepest));
    }

    // The altitudes of what a tile draws by itself. Its bin alone follows changes of the mesh.
    [[nodiscard]] static core::Interval surfaceOf(const SearchedTile& tile) {
        const InstalledTile* const installed = tile.callback.getInstalledTile();
        if (installed && installed->isMeshChanged()) return {tile.numbers.binLow, tile.numbers.binHigh};
        return {tile.numbers.surfaceLow, tile.numbers.surfaceHigh};
    }

    // As osg::PagedLOD chooses; where that is not certain all that it may show counts.
    void searchPaged(osg::PagedLOD& node, const SearchedTile& tile) {
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
        if (((byDistance && due == 0) || children == 0) && !isBeside(tile)) _hasHole = true;
    }

    void searchChild(osg::PagedLOD& node, unsigned int i, const SearchedTile& tile, bool isOnlyLevel) {
        if (!isPaged(node, i)) return show(tile, *node.getChild(i), isOnlyLevel);
        const InstalledTile* const installed = tile.callback.getInstalledTile();
        if (installed && installed->hasGapBelow()) _hasHole = true;
        searchNode(*node.getChild(i));
    }

    // Whether a node is no osgTerrain tile that has lost its technique.
    [[nodiscard]] static bool isDrawnByTechnique(const osg::Node& node) {
        if (!isOneOf<osgTerrain::TerrainTile>(node)) return true;
        const auto& tile = static_cast<const osgTerrain::TerrainTile&>(node);
        return tile.getTerrainTechnique() || !hasBeenTraversed(tile);
    }

    const ShownDatabase& _database;
    osg::NodeVisitor& _visitor;
    CullTraversal& _traversal;
    const core::HorizonEye* const _eye;
    const bool _isPlainVisitor = typeid(_visitor) == typeid(osgUtil::CullVisitor);
    const std::optional<core::Geodetic> _place;  // of the eye
    const double _deepest;
    struct StandingEye {
        osg::Vec3d at, up;
    };
    std::optional<StandingEye> _standing;  // of the eye, once it is needed
    osg::Polytope::PlaneList _planes;
    bool _testsSmallFeatures = false;
    core::PlaneMask _undecided = 0;         // of the view's planes, for families
    const osg::Matrixd* _toEcef = nullptr;  // below a transform, where OSG measures distances in another frame
    bool _isDoubtful = false;               // below something that may not be drawn
    bool _isBelowOutOfView = false;         // below a sphere that is out of view
    bool _isChoiceUnknown = false;          // below a choice of levels that may turn out otherwise
    bool _hasHole = false;
    std::vector<NearGround> _nearGround;
    double _depth = -kUnknownDepth;
};

std::optional<core::Geodetic> placeOf(const Viewpoint& viewpoint, const core::Ellipsoid& ellipsoid) {
    if (!viewpoint.eye()) return std::nullopt;
    return ellipsoid.toGeodetic(*viewpoint.eye());
}

// Whether all that hides is drawn, and the eye is above it.
bool isTrusted(const ShownDatabase& database, const LowestShown& lowest, const std::optional<core::Geodetic>& place) {
    const std::vector<NearGround>& ground = lowest.nearGround();
    return !lowest.hasHole() && std::all_of(ground.begin(), ground.end(), [&](const NearGround& close) {
        return SearchMemory::of(database.visitor)
            .ground.isBelow(*place, *close.mesh, *close.tile, database.view.ellipsoid);
    });
}

}  // namespace

std::optional<core::HorizonEye> eyeAboveWhatIsShown(const ShownDatabase& database, const Viewpoint& viewpoint,
                                                    double deepest, double& depth) {
    // A deeper occluder has a wider horizon, over which more may be seen that is deeper still. Raised from zero to what
    // is found until nothing deeper is, the depth is the least that will do.
    constexpr int kMostRounds = 16;
    constexpr int kExactRounds = 12;
    constexpr double kRoom = 1.05;
    const core::Ellipsoid& ellipsoid = database.view.ellipsoid;
    const std::optional<core::Geodetic> place = placeOf(viewpoint, ellipsoid);
    const double step = 500.0 * core::earthScale(ellipsoid);
    depth = std::clamp(depth, 0.0, deepest);
    for (int round = 0; round < kMostRounds; ++round) {
        const auto eye = viewpoint.above(ellipsoid, depth);
        if (!eye && depth >= deepest) break;
        if (!eye) {
            // the eye may stand in a valley below the ellipsoid
            depth = std::min(2.0 * depth + step, deepest);
            continue;
        }
        LowestShown lowest(database, &*eye, place, deepest);
        lowest.search(database.root);
        if (lowest.hasHole()) return std::nullopt;
        if (lowest.depth() <= depth) {
            depth = std::max(lowest.depth(), 0.0);
            // a near plane that cuts the terrain shows the inside of the globe, so no deeper occluder may be used
            const double belowEye = place && place->altitude < 0.0 ? step - place->altitude : 0.0;
            const bool isCutOpen = !viewpoint.above(ellipsoid, std::max(depth, belowEye));
            return !isCutOpen && isTrusted(database, lowest, place) ? eye : std::nullopt;
        }
        if (lowest.depth() > 0.25 * ellipsoid.polarRadius()) break;
        depth = std::min((round < kExactRounds ? 1.0 : kRoom) * lowest.depth(), deepest);
    }
    depth = 0.0;
    return std::isfinite(deepest) ? eyeAboveDepth(database, viewpoint, deepest) : std::nullopt;
}

std::optional<core::HorizonEye> eyeAboveDepth(const ShownDatabase& database, const Viewpoint& viewpoint, double depth) {
    const auto eye = viewpoint.above(database.view.ellipsoid, depth);
    if (!eye) return std::nullopt;
    const std::optional<core::Geodetic> place = placeOf(viewpoint, database.view.ellipsoid);
    LowestShown lowest(database, &*eye, place, depth);
    lowest.search(database.root);
    return isTrusted(database, lowest, place) ? eye : std::nullopt;
}

bool planWithoutHorizon(const ShownDatabase& database, const Viewpoint& viewpoint) {
    const std::optional<core::Geodetic> place = placeOf(viewpoint, database.view.ellipsoid);
    LowestShown lowest(database, nullptr, place, kUnknownDepth);
    lowest.search(database.root);
    return isTrusted(database, lowest, place);
}

}  // namespace osgAnalyticBin
