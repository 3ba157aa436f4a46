// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Instances.h"

#include "../Inverse.h"

#include <osg/CoordinateSystemNode>
#include <osg/Transform>

namespace osgAnalyticBin {

namespace {

// The most ways from a node up to its globe that are looked at.
constexpr int kMostPaths = 64;

// Whether a way from the node up to a globe leads through other transforms than those of `localToEcef`. Ways that end
// without a globe have no horizon, and do not matter. `nodeToHere`: from the node's frame to that of this ancestor.
bool hasOtherFrame(const osg::Node& ancestor, const osg::Matrixd& nodeToHere, const osg::Matrixd& localToEcef,
                   int& paths) {
    if (dynamic_cast<const osg::CoordinateSystemNode*>(&ancestor)) {
        const double reach = nodeToHere.getTrans().length() + localToEcef.getTrans().length();
        return !areNearlyEqual(nodeToHere, localToEcef, reach) || --paths < 0;
    }
    for (const osg::Group* const parent : ancestor.getParents()) {
        osg::Matrixd matrix;
        const osg::Transform* const transform = parent->asTransform();
        const bool isGlobe = dynamic_cast<const osg::CoordinateSystemNode*>(parent) != nullptr;
        if (transform && !isGlobe) transform->computeLocalToWorldMatrix(matrix, nullptr);
        if (hasOtherFrame(*parent, nodeToHere * matrix, localToEcef, paths)) return true;
    }
    return false;
}

}  // namespace

bool isInstanced(const osg::Node& node, const TileFrame& frame) {
    if (!frame.isKnown()) return false;
    const osg::Node* shared = &node;
    while (shared->getNumParents() == 1) shared = shared->getParent(0);
    if (shared->getNumParents() == 0) return false;
    int paths = kMostPaths;
    return hasOtherFrame(node, osg::Matrixd(), frame.localToEcef, paths);
}

}  // namespace osgAnalyticBin
