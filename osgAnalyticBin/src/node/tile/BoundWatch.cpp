// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoundWatch.h"

namespace osgAnalyticBin {

namespace {

const BoundWatch* watchOn(const osg::Node& node) {
    return dynamic_cast<const BoundWatch*>(node.getComputeBoundingSphereCallback());
}

}  // namespace

BoundWatch::BoundWatch(const BoundWatch& other, const osg::CopyOp& copyop)
    : osg::Node::ComputeBoundingSphereCallback(other, copyop) {}

bool BoundWatch::isOn(const osg::Node& node) {
    return watchOn(node) != nullptr;
}

osg::BoundingSphere BoundWatch::boundOf(const osg::Node& node) const {
    return _previous ? _previous->computeBound(node) : node.computeBound();
}

bool BoundWatch::hasOwnBound(const osg::Node& node) {
    const BoundWatch* const watch = watchOn(node);
    return watch ? watch->_previous.valid() : node.getComputeBoundingSphereCallback() != nullptr;
}

}  // namespace osgAnalyticBin
