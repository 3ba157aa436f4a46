// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Callbacks.h"

#include <osg/FrameStamp>
#include <osg/MatrixTransform>

namespace osgAnalyticBin::test {

Mover::Mover(const Mover& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _start(other._start),
      _step(other._step),
      _frame(other._frame) {}

void Mover::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    auto* transform = dynamic_cast<osg::MatrixTransform*>(node);
    if (transform && nv->getFrameStamp()) {
        const int frames = static_cast<int>(nv->getFrameStamp()->getFrameNumber()) - _frame;
        transform->setMatrix(osg::Matrixd::translate(_step * frames) * _start);
    }
    traverse(node, nv);
}

Passer::Passer(const Passer& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _skipsOddFrames(other._skipsOddFrames) {}

void Passer::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    const bool isCull = nv->getVisitorType() == osg::NodeVisitor::CULL_VISITOR;
    if (isCull && _skipsOddFrames && nv->getTraversalNumber() % 2 == 1) return;
    traverse(node, nv);
}

}  // namespace osgAnalyticBin::test
