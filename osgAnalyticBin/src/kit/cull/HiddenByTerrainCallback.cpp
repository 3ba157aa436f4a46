// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Classes.h"
#include "../Inverse.h"
#include "../tile/BoundWatch.h"
#include "CullCallbacks.h"
#include "CullTraversal.h"
#include "DrawnState.h"
#include "ShownChildren.h"

#include <osgAnalyticBin/HiddenByTerrainCallback.h>

#include <osg/Billboard>
#include <osg/LOD>
#include <osg/Transform>
#include <osgTerrain/TerrainTile>
#include <osgUtil/CullVisitor>

#include <cmath>

namespace osgAnalyticBin {

namespace {

// Whether OSG's sphere about the transform holds what the sphere inside becomes: it follows the three axes alone.
bool keepsSpheres(const osg::Transform& transform) {
    osg::Matrixd m;
    if (transform.getReferenceFrame() != osg::Transform::RELATIVE_RF ||
        !transform.computeLocalToWorldMatrix(m, nullptr) || !isAffine(m))
        return false;
    const osg::Vec3d x(m(0, 0), m(0, 1), m(0, 2)), y(m(1, 0), m(1, 1), m(1, 2)), z(m(2, 0), m(2, 1), m(2, 2));
    const double tolerance = 1e-6 * (x * x + y * y + z * z);
    return std::abs(x * y) <= tolerance && std::abs(y * z) <= tolerance && std::abs(z * x) <= tolerance;
}

// The user's sphere may be smaller than what is below.
bool holdsLevels(const osg::LOD& lod) {
    if (lod.getCenterMode() != osg::LOD::USER_DEFINED_CENTER || lod.getRadius() < 0.0f) return true;
    const osg::BoundingSphere& sphere = lod.getBound();
    for (unsigned int i = 0; i < lod.getNumChildren(); ++i) {
        const osg::BoundingSphere& level = lod.getChild(i)->getBound();
        if (level.valid() && !((level.center() - sphere.center()).length() + level.radius() <= sphere.radius()))
            return false;
    }
    return true;
}

// Whether a node is drawn within its sphere if its children are in theirs.
bool drawsWithinSphere(const osg::Node& node) {
    if (node.getComputeBoundingSphereCallback() && BoundWatch::hasOwnBound(node)) return false;
    if (const osg::Drawable* const drawable = node.asDrawable())
        return !drawable->getComputeBoundingBoxCallback() && !mayChange(*drawable);
    if (const osg::Transform* const transform = node.asTransform()) return keepsSpheres(*transform);
    if (isExactly<osg::Group>(node) || isExactly<osg::Geode>(node)) return true;
    if (isOneOf<osg::Billboard, osgTerrain::TerrainTile>(node)) return false;
    const auto* const lod = dynamic_cast<const osg::LOD*>(&node);
    return !lod || holdsLevels(*lod);
}

// Whether all that may be drawn of a node is within its sphere and nowhere in front of what is nearer. `toEye`: from
// inside the node.
bool staysBehind(osg::Node& node, const StateRules& rules, osgUtil::CullVisitor& visitor, const osg::Matrixd& toEye) {
    const DrawnState drawn = drawnStateAt(node, rules);
    if (!drawn.obeysDepth || !node.isCullingActive() || !drawsWithinSphere(node)) return false;
    osg::Group* const group = node.asGroup();
    return !group || forEachShown(*group, toEye, visitor, [&](osg::Node& child) {
        if (!visitor.validNodeMask(child)) return true;
        const osg::Transform* const transform = child.asTransform();
        if (!transform) return staysBehind(child, rules, visitor, toEye);
        osg::Matrixd inside = toEye;
        transform->computeLocalToWorldMatrix(inside, nullptr);
        return staysBehind(child, rules, visitor, inside);
    });
}

// What is below a transform has its sphere in the transform's own frame, where it is rounded less.
osg::BoundingSphere sphereBelow(const osg::Node& node) {
    const osg::Group* const group = node.asTransform() ? node.asGroup() : nullptr;
    return group ? group->osg::Group::computeBound() : node.getBound();
}

bool isHidden(osg::Node& node, osgUtil::CullVisitor& visitor) {
    HidingView& hiding = CullTraversal::of(visitor).hiding;
    if (!hiding.hides(visitor, sphereBelow(node), *visitor.getModelViewMatrix())) return false;
    const StateRules rules{false, false, visitor.getViewport()};
    const DrawnState above = hiding.stateAbove(visitor, rules);
    return above.obeysDepth && staysBehind(node, rules, visitor, *visitor.getModelViewMatrix());
}

}  // namespace

bool asksForTerrain(const osg::Callback& callback) {
    return isExactly<HiddenByTerrainCallback>(callback);
}

HiddenByTerrainCallback::HiddenByTerrainCallback(const HiddenByTerrainCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}

void HiddenByTerrainCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osgUtil::CullVisitor* const visitor = nv->asCullVisitor();
    if (!visitor || !isHidden(*node, *visitor)) traverse(node, nv);
}

}  // namespace osgAnalyticBin
