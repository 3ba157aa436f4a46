// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NoCulling.h"

#include "../CallbackChain.h"
#include "../cull/CullScopes.h"

#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/NodeVisitor>

namespace osgAnalyticBin {

NoCulling::NoCulling(const NoCulling& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}

void NoCulling::place(osg::Node& node) {
    remove(node);
    const osg::ref_ptr<NoCulling> callback = new NoCulling;
    putInFront(node, *callback);
}

void NoCulling::remove(osg::Node& node) {
    takeOffFirst<NoCulling>(node);
}

void NoCulling::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* const cullStack = nv->asCullStack();
    if (!cullStack) {
        traverse(node, nv);
        return;
    }
    const CullingMaskScope scope(*cullStack, osg::CullingSet::NO_CULLING);
    const WithoutClusterCulling clusters(*cullStack);
    traverse(node, nv);
}

}  // namespace osgAnalyticBin
