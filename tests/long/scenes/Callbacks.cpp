// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Callbacks.h"

#include <osg/FrameStamp>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/Sequence>
#include <osg/Switch>
#include <osgDB/DatabasePager>
#include <osgTerrain/TerrainTile>
#include <osgUtil/CullVisitor>

#include <utility>

namespace osgAnalyticBin::test {

namespace {

std::string complaint;

// Whether all children are traversed.
bool isPlainGroup(const osg::Node& node) {
    return node.asGroup() && !node.asSwitch() && !dynamic_cast<const osg::LOD*>(&node) &&
           !dynamic_cast<const osg::Sequence*>(&node) && !dynamic_cast<const osgTerrain::TerrainTile*>(&node);
}

}  // namespace

void Mover::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    auto* transform = dynamic_cast<osg::MatrixTransform*>(node);
    if (transform && nv->getFrameStamp()) {
        const int frames = static_cast<int>(nv->getFrameStamp()->getFrameNumber()) - _frame;
        transform->setMatrix(osg::Matrixd::translate(_step * frames) * _start);
    }
    traverse(node, nv);
}

void Passer::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    const bool isCull = nv->getVisitorType() == osg::NodeVisitor::CULL_VISITOR;
    if (isCull && _skipsOddFrames && nv->getTraversalNumber() % 2 == 1) return;
    traverse(node, nv);
}

void LeaverOut::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    if (nv->getVisitorType() != osg::NodeVisitor::CULL_VISITOR) {
        traverse(node, nv);
        return;
    }
    osg::Group* const group = isPlainGroup(*node) ? node->asGroup() : nullptr;
    for (unsigned int i = 0; group && i < group->getNumChildren(); ++i) {
        if (i != _number % group->getNumChildren()) group->getChild(i)->accept(*nv);
    }
}

void StatePusher::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osgUtil::CullVisitor* const visitor = _states ? nv->asCullVisitor() : nullptr;
    if (visitor) visitor->pushStateSet(_states);
    traverse(node, nv);
    if (visitor) visitor->popStateSet();
}

void Masker::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    const osg::Node::NodeMask before = nv->getTraversalMask();
    if (nv->getVisitorType() == osg::NodeVisitor::CULL_VISITOR) nv->setTraversalMask(before & _mask);
    traverse(node, nv);
    nv->setTraversalMask(before);
}

void OneShotCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    const osg::ref_ptr<OneShotCallback> keep(this);
    traverse(node, nv);
    node->removeUpdateCallback(this);
}

bool DrawableLeaverOut::cull(osg::NodeVisitor* /*nv*/, osg::Drawable* /*drawable*/, osg::RenderInfo* /*info*/) const {
    return _leavesOut;
}

void OwnDrawing::drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const {
    if (_draws) drawable->drawImplementation(info);
}

CastingGroup::CastingGroup(const CastingGroup& other, const osg::CopyOp& copyop) : osg::Group(other, copyop) {}

void CastingGroup::traverse(osg::NodeVisitor& nv) {
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR) {
        osg::NodeVisitor::DatabaseRequestHandler* const handler = nv.getDatabaseRequestHandler();
        if (!dynamic_cast<osgUtil::CullVisitor*>(&nv))
            complaint = "a visitor of type CULL_VISITOR is no CullVisitor";
        else if (handler && !dynamic_cast<osgDB::DatabasePager*>(handler))
            complaint = "the handler of requests is no DatabasePager";
    }
    osg::Group::traverse(nv);
}

std::string takeComplaint() {
    return std::exchange(complaint, {});
}

}  // namespace osgAnalyticBin::test
