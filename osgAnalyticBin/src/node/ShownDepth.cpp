// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShownDepth.h"

#include "../core/EarthScale.h"
#include "CullTraversal.h"
#include "InstalledTile.h"
#include "MeshCulling.h"
#include "Scoped.h"
#include "SeeThrough.h"
#include "TileCallback.h"
#include "TileFamily.h"
#include "TilePlan.h"

#include <osgAnalyticBin/BinInstaller.h>

#include <osg/CoordinateSystemNode>
#include <osg/Geode>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/PositionAttitudeTransform>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <typeinfo>
#include <vector>

namespace osgAnalyticBin {

namespace {

constexpr double kUnknownDepth = std::numeric_limits<double>::infinity();

// Whether an object is of this class, and not of one derived from it. By address: comparing names takes longer.
template <class Class, class Object>
bool isExactly(const Object& object) {
    return &typeid(object) == &typeid(Class);
}

// The cull callbacks of a node: the bin's, and whether others may leave out what is below them.
struct CullCallbacks {
    CullCallbacks() = default;
    explicit CullCallbacks(const osg::Node& node) {
        // A dynamic_cast across OSG's virtual bases would be most of the search's cost.
        for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
            if (!bin && isExactly<AnalyticBinCullCallback>(*at)) {
                bin = static_cast<const AnalyticBinCullCallback*>(at->asNodeCallback());
            } else if (isExactly<TileFamily>(*at)) {
                family = static_cast<const TileFamily*>(at->asNodeCallback());
            } else if (!isClusterCulling(*at) && !traversesAlways(*at)) {
                mayLeaveOut = true;
            }
        }
    }

    const AnalyticBinCullCallback* bin = nullptr;
    const TileFamily* family = nullptr;
    bool mayLeaveOut = false;
};

osg::PagedLOD* pagedLod(osg::Node& node) {
    if (isExactly<osg::PagedLOD>(node)) return static_cast<osg::PagedLOD*>(&node);
    return dynamic_cast<osg::PagedLOD*>(&node);
}

// What the search reads of a tile. For members of a family it stands in the family's block.
struct SearchedTile {
    SearchedTile(const AnalyticBinCullCallback& tile, bool hasShownShape)
        : callback(tile),
          columnSphere(tile.ecefColumnSphere()),
          binLow(tile.binLow()),
          surfaceHigh(tile.surfaceHigh()),
          surfaceLow(tile.surfaceLow()),
          isFitted(hasShownShape),
          isSeenThrough(tile.installedTile() && tile.installedTile()->isSeeThrough()),
          isMeshDoubted(tile.installedTile() && tile.installedTile()->isMeshDoubted()) {}
    SearchedTile(const TileFamily::Member& member, const TileBlock::Slot& slot)
        : callback(*member.tile),
          columnSphere(&slot.column),
          binLow(slot.binLow),
          surfaceHigh(slot.surfaceHigh),
          surfaceLow(slot.surfaceLow),
          isFitted(true),
          isSeenThrough(member.isSeeThrough),
          meshParts(&member.meshParts) {}

    const AnalyticBinCullCallback& callback;
    const osg::BoundingSphere* columnSphere;
    double binLow, surfaceHigh, surfaceLow;
    bool isFitted;  // to the shape in which the terrain is shown
    bool isSeenThrough;
    bool isMeshDoubted = false;
    bool isAboutEye = false;
    const std::vector<osg::ref_ptr<const osg::Node>>* meshParts = nullptr;  // null: not known
};

// A surface that is shown about the place of the eye, no lower than the eye by its bounds.
struct NearGround {
    const AnalyticBinCullCallback* tile;
    osg::Node* mesh;
};

// Looks for the lowest surface among the tiles that an eye sees over its horizon.
class LowestShown {
public:
    LowestShown(const ShownDatabase& database, const core::HorizonEye& eye, const std::optional<core::Geodetic>& place,
                double deepest)
        : _database(database), _visitor(database.visitor), _eye(eye), _place(place), _deepest(deepest) {
        if (database.view.plan) database.view.plan->clear();
        const osg::CullingSet& cullingSet = database.cullStack.getCurrentCullingSet();
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
        const bool isFamily = family && family->culls(group, _database.cullStack, _database.view) && !_isMoved;
        if (isFamily) return searchFamily(group, *family);
        for (unsigned int i = 0; i < group.getNumChildren() && !_hasHole; ++i) searchNode(*group.getChild(i));
    }

    // Reads nothing of tiles that are passed over.
    void searchFamily(osg::Group& group, const TileFamily& family) {
        if (group.getNumChildren() < family.size() || family.hasLostTiles()) _hasHole = true;
        TileFamily::Verdicts verdicts;
        std::uint64_t passedOver = 0;
        for (unsigned int i = 0; i < group.getNumChildren() && !_hasHole; ++i) {
            const unsigned int number = i % TileBlock::Part::kMost;
            if (number == 0) {
                test(group, family, i, verdicts);
                passedOver = passedOverIn(verdicts, i < family.size() ? &family.block().partFrom(i) : nullptr);
            }
            if (passedOver >> number & 1) continue;
            if (verdicts.members >> number & 1) {
                searchMember(*group.getChild(i), family, verdicts, i);
            } else {
                searchNode(*group.getChild(i));
            }
        }
    }

    void test(const osg::Group& group, const TileFamily& family, unsigned int first, TileFamily::Verdicts& verdicts) {
        const DatabaseView& view = _database.view;
        family.test(group, first, view.planes, _undecided, &_eye, verdicts);
        if (view.plan) view.plan->add(family, first, _undecided, verdicts, group.getNumChildren() - first);
        if (verdicts.lacksTiles) _hasHole = true;
    }

    // Tiles that are outside the frustum or hidden, whose column is the bin, and that are not about the eye.
    [[nodiscard]] std::uint64_t passedOverIn(const TileFamily::Verdicts& verdicts, const TileBlock::Part* part) const {
        if (!part || (_place && _place->altitude <= part->highest)) return 0;
        return verdicts.members & ~part->withOwnColumns & (verdicts.planes.outside | verdicts.hidden);
    }

    void searchMember(osg::Node& node, const TileFamily& family, const TileFamily::Verdicts& verdicts,
                      unsigned int slot) {
        const TileBlock& block = family.block();
        const unsigned int i = slot % TileBlock::Part::kMost;
        const bool hasOwnColumn = (block.partFrom(slot).withOwnColumns >> i & 1) != 0;
        const bool isBinCulled = ((verdicts.planes.outside | verdicts.hidden) >> i & 1) != 0;
        const TileFamily::Member& member = family.member(slot);
        SearchedTile tile(member, block[slot]);
        tile.isAboutEye = _place && _place->altitude <= block[slot].binHigh && isAbout(*member.tile);
        const bool isCulled =
            hasOwnColumn ? isBesideFrustum(tile.columnSphere) || block.isColumnHidden(slot, _eye) : isBinCulled;
        if (isCulled && !tile.isAboutEye) return;
        const Scoped undecided(_undecided, hasOwnColumn ? _undecided : verdicts.planes.undecided[i]);
        const bool isAlone = node.getCullCallback() == member.tile && !member.tile->getNestedCallback();
        CullCallbacks callbacks = isAlone ? CullCallbacks() : CullCallbacks(node);
        callbacks.bin = member.tile;
        searchTile(node, member.paged, tile, callbacks);
    }

    void searchNode(osg::Node& node) {
        // most nodes that are no tiles are roots of files: plain groups
        const bool isGroup = isExactly<osg::Group>(node);
        const CullCallbacks callbacks(node);
        if (callbacks.bin) {
            const AnalyticBinCullCallback& bin = *callbacks.bin;
            const bool isFitted = !bin.terrainShape() || *bin.terrainShape() == _database.view.shape;
            SearchedTile tile(bin, isFitted);
            tile.isAboutEye = isAbout(bin);
            if (!tile.isAboutEye && (isBeside(tile) || bin.isColumnHiddenFrom(_eye))) return;
            return searchTile(node, pagedLod(node), tile, callbacks);
        }
        // another database is on a globe of its own
        if (!isGroup && dynamic_cast<osg::CoordinateSystemNode*>(&node)) return;
        const Scoped doubtful(_isDoubtful, _isDoubtful || !isSurelyDrawn(node, callbacks));
        const Scoped moved(_isMoved, _isMoved || node.asTransform());
        if (osg::Group* group = node.asGroup()) searchChildren(*group, callbacks.family);
    }

    void searchTile(osg::Node& node, osg::PagedLOD* paged, const SearchedTile& tile, const CullCallbacks& callbacks) {
        const Scoped doubtful(_isDoubtful, _isDoubtful || !isSurelyDrawn(node, callbacks));
        if (_isDoubtful || tile.isSeenThrough) _hasHole = true;
        if (paged) return searchPaged(*paged, tile);
        show(tile, node);
    }

    [[nodiscard]] bool isSurelyDrawn(const osg::Node& node, const CullCallbacks& callbacks) const {
        const osg::StateSet* const state = node.getStateSet();
        return _visitor.validNodeMask(node) && !callbacks.mayLeaveOut && !(state && isSeeThrough(*state)) &&
               (callbacks.bin || drawsAllChildren(node));
    }

    // Whether all of a tile's own mesh is drawn. Its state was asked for when bins were installed.
    [[nodiscard]] bool isDrawnWhole(const osg::Node& mesh, const SearchedTile& tile) const {
        const bool isKnown = tile.meshParts && !tile.meshParts->empty() && tile.meshParts->front() == &mesh;
        bool hasDrawable = false;
        if (!isKnown) return isDrawnWhole(mesh, hasDrawable) && (hasDrawable || !tile.isMeshDoubted);
        return std::all_of(tile.meshParts->begin(), tile.meshParts->end(), [this](const auto& part) {
            return _visitor.validNodeMask(*part) && !(part->getCullCallback() && CullCallbacks(*part).mayLeaveOut);
        });
    }

    [[nodiscard]] bool isDrawnWhole(const osg::Node& part, bool& hasDrawable) const {
        if (!_visitor.validNodeMask(part) || CullCallbacks(part).mayLeaveOut) return false;
        const bool isTerrain = typeid(part) == typeid(osgTerrain::TerrainTile);
        hasDrawable = hasDrawable || isTerrain || part.asDrawable();
        if (isTerrain) return true;
        if (!drawsAllChildren(part)) return false;
        const osg::Group* const group = part.asGroup();
        for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
            if (!isDrawnWhole(*group->getChild(i), hasDrawable)) return false;
        }
        return true;
    }

    // Whether the eye may be within or below what the tile or its descendants draw.
    [[nodiscard]] bool isAbout(const AnalyticBinCullCallback& tile) const {
        if (!_place || _place->altitude > tile.binHigh()) return false;
        const core::GeodeticBin& bin = tile.bin().bin();
        if (bin.empty()) return true;
        if (_place->latitude < bin.latitude().lower || _place->latitude > bin.latitude().upper) return false;
        return bin.contains({_place->latitude, _place->longitude, bin.altitude().middle()});
    }

    // Rays that are seen do not enter the occluder there: it lies below the ellipsoid, but it may lie above the tile.
    [[nodiscard]] bool isBeside(const SearchedTile& tile) const {
        return tile.isFitted && isBesideFrustum(tile.columnSphere);
    }

    [[nodiscard]] bool isBesideFrustum(const osg::BoundingSphere* sphere) const {
        if (!sphere) return false;
        const osg::Vec3d center = sphere->center();
        return std::any_of(_planes.begin(), _planes.end(), [&](const osg::Plane& plane) {
            return plane.distance(center) < -static_cast<double>(sphere->radius());
        });
    }

    void show(const SearchedTile& tile, osg::Node& mesh) {
        if (tile.isAboutEye && _place->altitude <= tile.surfaceHigh) _nearGround.push_back({&tile.callback, &mesh});
        // tiles about the eye are searched even beside the frustum, for the ground alone
        if (tile.isAboutEye && isBeside(tile)) return;
        if (!isDrawnWhole(mesh, tile)) _hasHole = true;
        // what a tile draws by itself is in its bin
        if (tile.isFitted && tile.binLow >= -_depth) return;
        const double own = tile.isFitted ? -tile.surfaceLow : kUnknownDepth;
        _depth = std::max(_depth, std::min(own, _deepest));
    }

    // As osg::PagedLOD chooses; where that is not certain all that it may show counts.
    void searchPaged(osg::PagedLOD& node, const SearchedTile& tile) {
        const bool byDistance = node.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT && !_isMoved;
        const float range = byDistance ? _visitor.getDistanceToViewPoint(node.getCenter(), true) : 0.0f;
        const unsigned int children = node.getNumChildren();
        bool isOneAwaited = !byDistance;
        bool isShown = isOneAwaited;
        for (unsigned int i = 0; i < node.getNumRanges(); ++i) {
            if (byDistance && (range < node.getMinRange(i) || range >= node.getMaxRange(i))) continue;
            isShown = true;
            if (i < children) searchChild(node, i, tile);
            isOneAwaited = isOneAwaited || i >= children;
        }
        // the last child stands in for one that is awaited
        if (isOneAwaited && children > 0) searchChild(node, children - 1, tile);
        if ((!isShown || children == 0) && !isBeside(tile)) _hasHole = true;
    }

    void searchChild(osg::PagedLOD& node, unsigned int i, const SearchedTile& tile) {
        const bool isPaged = i < node.getNumFileNames() && !node.getFileName(i).empty();
        if (!isPaged) return show(tile, *node.getChild(i));
        searchNode(*node.getChild(i));
    }

    const ShownDatabase& _database;
    osg::NodeVisitor& _visitor;
    const core::HorizonEye& _eye;
    const std::optional<core::Geodetic> _place;  // of the eye
    const double _deepest;
    osg::Polytope::PlaneList _planes;
    core::PlaneMask _undecided = 0;  // of the view's planes, for families
    bool _isMoved = false;           // below a transform, where OSG measures distances in another frame
    bool _isDoubtful = false;        // below something that may not be drawn
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
    return !lowest.hasHole() && std::all_of(ground.begin(), ground.end(), [&](const NearGround& near) {
        return CullTraversal::of(database.visitor)
            .ground()
            .isBelow(*place, *near.mesh, *near.tile, database.view.ellipsoid);
    });
}

}  // namespace

bool drawsAllChildren(const osg::Node& node) {
    static const std::array<const std::type_info*, 7> known{
        &typeid(osg::Group),           &typeid(Carrier),
        &typeid(osg::MatrixTransform), &typeid(osg::PositionAttitudeTransform),
        &typeid(osg::Geode),           &typeid(osg::CoordinateSystemNode),
        &typeid(osgTerrain::Terrain)};
    const std::type_info& type = typeid(node);
    // by address first: comparing names takes longer
    return !node.asGroup() || std::find(known.begin(), known.end(), &type) != known.end() ||
           std::any_of(known.begin(), known.end(), [&type](const std::type_info* one) { return *one == type; });
}

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
        LowestShown lowest(database, *eye, place, deepest);
        lowest.search(database.root);
        if (lowest.hasHole()) return std::nullopt;
        if (lowest.depth() <= depth) {
            depth = std::max(lowest.depth(), 0.0);
            return isTrusted(database, lowest, place) ? eye : std::nullopt;
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
    LowestShown lowest(database, *eye, place, depth);
    lowest.search(database.root);
    return isTrusted(database, lowest, place) ? eye : std::nullopt;
}

}  // namespace osgAnalyticBin
