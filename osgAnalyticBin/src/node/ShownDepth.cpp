// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ShownDepth.h"

#include "../core/EarthScale.h"
#include "Scoped.h"

#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <typeinfo>

namespace osgAnalyticBin {

namespace {

constexpr double kUnknownDepth = std::numeric_limits<double>::infinity();

// The installer puts its callback first, others may have put theirs before it. A dynamic_cast across OSG's virtual
// bases would be most of the search's cost.
const AnalyticBinCullCallback* binCallback(const osg::Node& node) {
    for (const osg::Callback* at = node.getCullCallback(); at; at = at->getNestedCallback()) {
        const osg::NodeCallback* callback = at->asNodeCallback();
        const bool isBin = callback && typeid(*callback) == typeid(AnalyticBinCullCallback);
        if (isBin) return static_cast<const AnalyticBinCullCallback*>(callback);
    }
    return nullptr;
}

osg::PagedLOD* pagedLod(osg::Node& node) {
    if (typeid(node) == typeid(osg::PagedLOD)) return static_cast<osg::PagedLOD*>(&node);
    return dynamic_cast<osg::PagedLOD*>(&node);
}

// Looks for the lowest surface among the tiles that an eye sees over its horizon.
class LowestShown {
public:
    LowestShown(osg::NodeVisitor& visitor, const osg::CullStack& cullStack, const core::HorizonEye& eye,
                const TerrainShape& shape, double deepest)
        : _visitor(visitor), _eye(eye), _shape(shape), _deepest(deepest) {
        const osg::CullingSet& cullingSet = cullStack.getCurrentCullingSet();
        if (!(cullingSet.getCullingMask() & osg::CullingSet::VIEW_FRUSTUM_CULLING)) return;
        _planes = cullingSet.getFrustum().getPlaneList();
    }

    void search(osg::Group& group) {
        for (unsigned int i = 0; i < group.getNumChildren(); ++i) searchNode(*group.getChild(i));
    }

    [[nodiscard]] double depth() const { return _depth; }

private:
    void searchNode(osg::Node& node) {
        const AnalyticBinCullCallback* tile = binCallback(node);
        if (tile && (isAbove(*tile) || isBesideFrustum(*tile) || tile->isColumnHiddenFrom(_eye))) return;
        osg::PagedLOD* paged = tile ? pagedLod(node) : nullptr;
        if (paged) return searchPaged(*paged, *tile);
        if (tile) return show(*tile);
        // another database is on a globe of its own
        if (dynamic_cast<osg::CoordinateSystemNode*>(&node)) return;
        const Scoped moved(_isMoved, _isMoved || node.asTransform());
        if (osg::Group* group = node.asGroup()) search(*group);
    }

    [[nodiscard]] bool isFitted(const AnalyticBinCullCallback& tile) const {
        return !tile.terrainShape() || *tile.terrainShape() == _shape;
    }

    // Whether the tile and its descendants cannot change the result.
    [[nodiscard]] bool isAbove(const AnalyticBinCullCallback& tile) const {
        return isFitted(tile) && tile.binLow() >= -_depth;
    }

    // Rays that are seen do not enter the occluder there: it lies below the ellipsoid, but it may lie above the tile.
    [[nodiscard]] bool isBesideFrustum(const AnalyticBinCullCallback& tile) const {
        const osg::BoundingSphere* sphere = tile.ecefColumnSphere();
        if (!sphere || !isFitted(tile)) return false;
        const osg::Vec3d center = sphere->center();
        return std::any_of(_planes.begin(), _planes.end(), [&](const osg::Plane& plane) {
            return plane.distance(center) < -static_cast<double>(sphere->radius());
        });
    }

    void show(const AnalyticBinCullCallback& tile) {
        const double own = isFitted(tile) ? -tile.surfaceLow() : kUnknownDepth;
        _depth = std::max(_depth, std::min(own, _deepest));
    }

    // As osg::PagedLOD chooses; where that is not certain all that it may show counts.
    void searchPaged(osg::PagedLOD& node, const AnalyticBinCullCallback& tile) {
        const bool byDistance = node.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT && !_isMoved;
        const float range = byDistance ? _visitor.getDistanceToViewPoint(node.getCenter(), true) : 0.0f;
        const unsigned int children = node.getNumChildren();
        bool isOneAwaited = !byDistance;
        for (unsigned int i = 0; i < node.getNumRanges(); ++i) {
            if (byDistance && (range < node.getMinRange(i) || range >= node.getMaxRange(i))) continue;
            if (i < children) searchChild(node, i, tile);
            isOneAwaited = isOneAwaited || i >= children;
        }
        // the last child stands in for one that is awaited
        if (isOneAwaited && children > 0) searchChild(node, children - 1, tile);
    }

    void searchChild(osg::PagedLOD& node, unsigned int i, const AnalyticBinCullCallback& tile) {
        const bool isPaged = i < node.getNumFileNames() && !node.getFileName(i).empty();
        if (!isPaged) return show(tile);
        searchNode(*node.getChild(i));
    }

    osg::NodeVisitor& _visitor;
    const core::HorizonEye& _eye;
    const TerrainShape _shape;
    const double _deepest;
    osg::Polytope::PlaneList _planes;
    bool _isMoved = false;  // below a transform, where OSG measures distances in another frame
    double _depth = -kUnknownDepth;
};

}  // namespace

std::optional<core::HorizonEye> eyeAboveWhatIsShown(osg::Group& database, osg::NodeVisitor& visitor,
                                                    const osg::CullStack& cullStack, const Viewpoint& viewpoint,
                                                    const core::Ellipsoid& ellipsoid, const TerrainShape& shape,
                                                    double deepest, double& depth) {
    // A deeper occluder has a wider horizon, over which more may be seen that is deeper still. Raised from zero to what
    // is found until nothing deeper is, the depth is the least that will do.
    constexpr int kMostRounds = 16;
    constexpr int kExactRounds = 12;
    constexpr double kRoom = 1.05;
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
        LowestShown lowest(visitor, cullStack, *eye, shape, deepest);
        lowest.search(database);
        if (lowest.depth() <= depth) {
            depth = std::max(lowest.depth(), 0.0);
            return eye;
        }
        if (lowest.depth() > 0.25 * ellipsoid.polarRadius()) break;
        depth = std::min((round < kExactRounds ? 1.0 : kRoom) * lowest.depth(), deepest);
    }
    depth = 0.0;
    return std::isfinite(deepest) ? viewpoint.above(ellipsoid, deepest) : std::nullopt;
}

}  // namespace osgAnalyticBin
