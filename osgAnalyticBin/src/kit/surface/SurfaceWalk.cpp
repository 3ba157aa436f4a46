// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SurfaceWalk.h"

#include "../Classes.h"
#include "../Inverse.h"

#include <osg/Billboard>
#include <osg/CoordinateSystemNode>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/PositionAttitudeTransform>
#include <osg/ProxyNode>
#include <osg/Sequence>
#include <osg/Switch>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin {

bool hasFixedPlace(const osg::Transform& node) {
    return isOneOf<osg::MatrixTransform, osg::PositionAttitudeTransform>(node) &&
           node.getReferenceFrame() == osg::Transform::RELATIVE_RF && !node.getUpdateCallback() &&
           node.getDataVariance() != osg::Object::DYNAMIC;
}

bool drawsBesideChildren(const osg::Node& node) {
    const osg::Group* const group = node.asGroup();
    const bool isKnown = !group || node.asTransform() ||
                         isOneOf<osg::Group, osg::Geode, osg::PagedLOD, osg::LOD, osg::Switch, osg::Sequence,
                                 osg::Billboard, osg::CoordinateSystemNode, osgTerrain::Terrain>(node);
    // these classes compute bounds of their own
    if (isKnown || dynamic_cast<const osg::LOD*>(&node) || dynamic_cast<const osg::ProxyNode*>(&node) ||
        dynamic_cast<const osgTerrain::TerrainTile*>(&node))
        return false;
    const osg::BoundingSphere own = node.getBound(), below = group->osg::Group::computeBound();
    return own.valid() && !(own == below);
}

bool drawsByItself(const osg::Node& node) {
    return node.asGroup() ? drawsBesideChildren(node) : !isExactly<osg::Node>(node);
}

SurfaceWalk::SurfaceWalk(const osg::Matrixd& localToEcef)
    : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _localToEcef(localToEcef), _isKnown(isAffine(localToEcef)) {
    setNodeMaskOverride(~0u);
}

void SurfaceWalk::apply(osg::Node& node) {
    if (!_isKnown) return;
    // Traversed before it has its Terrain, a tile never finds it afterwards; children it does not draw.
    if (auto* tile = dynamic_cast<osgTerrain::TerrainTile*>(&node)) return visit(*tile);
    if (drawsByItself(node)) visitUnknown(node);
    traverse(node);
}

void SurfaceWalk::apply(osg::Billboard& node) {
    if (_isKnown) visitBillboard(node);
}

void SurfaceWalk::visitBillboard(osg::Billboard&) {
    giveUp();
}

void SurfaceWalk::visitUnknown(osg::Node&) {
    giveUp();
}

void SurfaceWalk::apply(osg::ProxyNode& node) {
    node.getNumFileNames() > 0 ? giveUp() : traverse(node);
}

void SurfaceWalk::apply(osg::PagedLOD&) {
    giveUp();
}

void SurfaceWalk::apply(osg::Transform& node) {
    if (!_isKnown) return;
    if (!hasFixedPlace(node)) return giveUp();
    const osg::Matrixd outer = _localToEcef;
    node.computeLocalToWorldMatrix(_localToEcef, this);
    if (!isAffine(_localToEcef)) giveUp();
    traverse(node);
    _localToEcef = outer;
}

void SurfaceWalk::apply(osg::Drawable& drawable) {
    if (_isKnown) visit(drawable);
}

}  // namespace osgAnalyticBin
