// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ComputedNear.h"

#include "../Classes.h"
#include "../Inverse.h"
#include "../Scoped.h"
#include "../tile/BoundWatch.h"
#include "CullCallbacks.h"
#include "CullScopes.h"
#include "DrawnState.h"
#include "FamilyTile.h"
#include "ShownChildren.h"
#include "Viewpoint.h"

#include <osgAnalyticBin/Declarations.h>

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/PagedLOD>
#include <osg/Projection>
#include <osg/ShapeDrawable>
#include <osg/Switch>

#include <algorithm>
#include <limits>

namespace osgAnalyticBin {

namespace {

constexpr double kNowhere = -std::numeric_limits<double>::infinity();

// Groups of which osgUtil::CullVisitor draws the children, all or some, and nothing else.
bool isPlainGroup(const osg::Node& node) {
    return node.asGroup() &&
           (isOneOf<osg::PagedLOD, osg::LOD, osg::Switch, osg::LightSource>(node) || drawsAllChildren(node));
}

// Whether OSG's sphere of a node holds those of its children: a plane that has it inside is not tested below.
bool isHeldBySphere(const osg::Node* node) {
    return drawsAllChildren(*node) && !BoundWatch::hasOwnBound(*node);
}

}  // namespace

// The farthest depth of nodes with all that is below them.
class ComputedNear::DepthSearch {
public:
    // `selection`: of nodes that are asked for by themselves; null: none.
    DepthSearch(osgUtil::CullVisitor& visitor, const TileSelection* selection)
        : _visitor(visitor), _selection(selection) {
        const osg::NodePath& path = visitor.getNodePath();
        _areSpheresTested = !selection && std::all_of(path.begin(), path.end(), isHeldBySphere);
    }

    [[nodiscard]] double farthest() const { return _farthest; }

    // Begins anew. `known`: a tile whose own mesh is left out, because its depth is known; null: none.
    void begin(const FamilyTile* known) {
        _known = known;
        _farthest = kNowhere;
    }

    // All children but one. `toEye`: from inside the group.
    [[nodiscard]] bool addChildren(osg::Group& group, const osg::Matrixd& toEye, const osg::Node* except) {
        for (unsigned int i = 0; i < group.getNumChildren(); ++i) {
            if (group.getChild(i) != except && !add(*group.getChild(i), toEye)) return false;
        }
        return true;
    }

    // Where its depth is not known; null: nowhere.
    [[nodiscard]] const osg::Node* unknown() const { return _unknown; }

    // `toEye`: from the node's parent. Returns: false where its depth is not known.
    [[nodiscard]] bool add(osg::Node& node, const osg::Matrixd& toEye) {
        if (!_visitor.validNodeMask(node) || (_known && _known->isMesh(node))) return true;
        if (_areSpheresTested && isLeftOut(node, toEye)) return true;
        const CullCallbacks callbacks(node);
        // kept nodes come one by one
        if (callbacks.family && _selection && _selection->hasSegment(*callbacks.family)) return true;
        // these have planes of their own
        const bool hasOwnPlanes = isOneOf<osg::Camera, osg::Projection>(node);
        const bool isDrawable = isOneOf<osg::Geometry, osg::ShapeDrawable>(node);
        // models that terrain may hide come in thousands
        const bool isCounted = !callbacks.mayLeaveOut && _isCounting;
        const Scoped counting(_isCounting, isCounted);
        if (callbacks.isUnknown || (isCounted && --_nodesLeft < 0) ||
            !(hasOwnPlanes || isDrawable || isPlainGroup(node))) {
            _unknown = &node;
            return false;
        }
        if (hasOwnPlanes) return true;
        if (isDrawable) {
            addBox(node.asDrawable()->getBoundingBox(), toEye);
            return true;
        }
        const Scoped spheres(_areSpheresTested, _areSpheresTested && isHeldBySphere(&node));
        osg::Matrixd inside = toEye;
        if (const osg::Transform* const transform = node.asTransform())
            transform->computeLocalToWorldMatrix(inside, &_visitor);
        return forEachShown(*node.asGroup(), inside, _visitor, [&](osg::Node& child) { return add(child, inside); });
    }

private:
    // In the visitor's own frame, where most models are.
    [[nodiscard]] bool isLeftOut(const osg::Node& node, const osg::Matrixd& toEye) const {
        return toEye == *_visitor.getModelViewMatrix() &&
               isLeftOutAtOnce(_visitor.getCurrentCullingSet(), ~core::PlaneMask{0}, node);
    }

    void addBox(const osg::BoundingBox& box, const osg::Matrixd& toEye) {
        if (box.valid()) _farthest = std::max(_farthest, farthestDepth(box, toEye));
    }

    osgUtil::CullVisitor& _visitor;
    const TileSelection* const _selection;
    bool _areSpheresTested = false;
    const FamilyTile* _known = nullptr;
    int _nodesLeft = 1024;
    bool _isCounting = true;
    double _farthest = kNowhere;
    const osg::Node* _unknown = nullptr;
};

namespace {

// The nodes from the one whose projection is the present one down to the visitor's node. Returns: empty where that
// begins with something unknown.
osg::NodePath pathBelowProjection(osgUtil::CullVisitor& visitor) {
    const osg::NodePath& path = visitor.getNodePath();
    const auto last = std::find_if(path.rbegin(), path.rend(),
                                   [](const osg::Node* node) { return isOneOf<osg::Camera, osg::Projection>(*node); });
    if (last != path.rend()) return {last.base() - 1, path.end()};
    // osgUtil::SceneView traverses the children of its camera
    osg::Camera* const camera = visitor.getRenderStage() ? visitor.getCurrentCamera() : nullptr;
    if (!camera || path.empty() || !camera->containsNode(path.front()) || CullCallbacks(*camera).mayLeaveOut) return {};
    osg::NodePath whole{camera};
    whole.insert(whole.end(), path.begin(), path.end());
    return whole;
}

}  // namespace

// What is drawn beside the nodes of a path. Returns: a node of unknown depth; nullptr: there is none.
const osg::Node* ComputedNear::addBeside(DepthSearch& search, const osg::NodePath& path,
                                         osgUtil::CullVisitor& visitor) {
    osg::Matrixd toEye = *visitor.getModelViewMatrix();
    for (std::size_t i = path.size() - 1; i-- > 0;) {
        osg::Group* const group = path[i]->asGroup();
        const bool isFirst = i == 0;
        if (!group || !(isFirst || isPlainGroup(*group))) return path[i];
        if (!search.addChildren(*group, toEye, path[i + 1])) return search.unknown();
        const osg::Transform* const transform = isFirst ? nullptr : group->asTransform();
        if (!transform) continue;
        osg::Matrixd toParent;
        if (transform->getReferenceFrame() != osg::Transform::RELATIVE_RF ||
            !transform->computeLocalToWorldMatrix(toParent, &visitor))
            return path[i];
        const auto fromParent = affineInverse(toParent);
        if (!fromParent) return path[i];
        toEye.preMult(*fromParent);
    }
    return nullptr;
}

bool ComputedNear::isPossible(osg::NodeVisitor& visitor, const osg::CullStack& cullStack) {
    const bool isCullVisitor =
        isExactly<osgUtil::CullVisitor>(visitor) || (visitor.asCullVisitor() && drawsAsCullVisitor(visitor));
    return isCullVisitor && !hasTiltedPlanes(*cullStack.getProjectionMatrix()) &&
           !cullStack.getClampProjectionMatrixCallback() &&
           cullStack.getComputeNearFarMode() == osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES;
}

std::optional<ComputedNear> ComputedNear::of(osgUtil::CullVisitor& visitor, const TileSelection& selection,
                                             const osg::Node*& unknown) {
    ComputedNear near(selection, visitor.getNearFarRatio());
    const osg::NodePath path = pathBelowProjection(visitor);
    DepthSearch beside(visitor, nullptr), within(visitor, &selection);
    unknown = nullptr;
    if (path.empty() || path.back()->asTransform()) return std::nullopt;
    unknown = addBeside(beside, path, visitor);
    if (unknown) return std::nullopt;
    // where the root's tiles are not tested together, OSG enters by itself what is there
    osg::Node& root = *path.back();
    const TileFamily* const family = CullCallbacks(root).family;
    const bool isSelected = family && selection.hasSegment(*family);
    bool areDepthsKnown = isSelected || within.addChildren(*root.asGroup(), *visitor.getModelViewMatrix(), nullptr);
    near._others = std::max({beside.farthest(), within.farthest(), visitor.getCalculatedFarPlane()});
    areDepthsKnown = areDepthsKnown && near.addKept(visitor, within);
    unknown = within.unknown();
    return areDepthsKnown ? std::optional(std::move(near)) : std::nullopt;
}

bool ComputedNear::addKept(osgUtil::CullVisitor& visitor, DepthSearch& search) {
    const osg::Matrixd& toEye = *visitor.getModelViewMatrix();
    const std::vector<TileSelection::Kept>& all = _selection->kept();
    // tiles whose own mesh is drawn, as far as is known, and those of which that is certain
    std::vector<bool> mayShow(all.size(), false), shows(all.size(), false);
    for (const ShownTile& tile : _selection->shown()) {
        if (tile.kept == TileSelection::kNone) continue;
        mayShow[tile.kept] = true;
        shows[tile.kept] = tile.isSure && tile.member && tile.member->isMesh(*tile.mesh);
    }
    _depths.reserve(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const TileSelection::Kept& kept = all[i];
        const auto mesh = kept.member ? kept.member->farthest(visitor, kept.undecided) : std::nullopt;
        search.begin(mesh ? kept.member : nullptr);
        const bool isAll = mesh && kept.way == TileSelection::Way::Mesh;
        if (!isAll && !search.add(*kept.node, toEye)) return false;
        const bool isMeshDrawn = mesh && (mayShow[i] || !kept.isSearched);
        _depths.push_back(isMeshDrawn ? std::max(mesh->all, search.farthest()) : search.farthest());
        if (mesh && shows[i]) _drawn = std::max(_drawn, mesh->drawn);
    }
    return true;
}

double ComputedNear::most(const std::vector<std::size_t>& hidden) const {
    constexpr double kRounding = 1.0001;
    std::vector<bool> isLeftOut(_depths.size(), false);
    for (const std::size_t i : hidden) {
        const ShownTile& tile = _selection->shown()[i];
        if (tile.kept != TileSelection::kNone) isLeftOut[tile.kept] = true;
    }
    double farthest = _others;
    for (std::size_t i = 0; i < _depths.size();) {
        // what is below a node comes behind it
        const std::size_t end = std::max<std::size_t>(i + 1, _selection->kept()[i].end);
        if (!isLeftOut[i]) farthest = std::max(farthest, _depths[i]);
        i = isLeftOut[i] ? end : i + 1;
    }
    return kRounding * _ratio * std::max(0.0, farthest);
}

}  // namespace osgAnalyticBin
