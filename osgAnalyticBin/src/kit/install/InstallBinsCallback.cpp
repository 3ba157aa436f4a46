// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/InstallBinsCallback.h>

#include <osg/Node>
#include <osg/NodeVisitor>

namespace osgAnalyticBin {

InstallBinsCallback::InstallBinsCallback(const InstallBinsCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), InstallRequest(other, copyop) {}

void InstallBinsCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    if (!isDone()) {
        installBins(*node, getCullOptions());
        setDone();
    }
    const osg::ref_ptr<osg::Callback> self(this);
    traverse(node, nv);
    // a clone of the node may share it
    constexpr int kOwn = 2;  // references: the node's and this one
    if (nv->getVisitorType() != osg::NodeVisitor::UPDATE_VISITOR || referenceCount() > kOwn) return;
    node->removeUpdateCallback(this);
    node->addEventCallback(this);
}

}  // namespace osgAnalyticBin
