// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../cull/CullScopes.h"

#include <osg/CullStack>
#include <osg/CullingSet>
#include <osg/NodeCallback>
#include <osg/NodeVisitor>

#include <optional>

namespace osgAnalyticBin {

/// The cull callback of Method::None: for the length of a cull traversal, OSG tests nothing below its node, which OSG
/// tests as always. Its class name is that of a plain osg::NodeCallback, so that nothing of it is saved with a scene.
/// Threads: run() changes nothing in the callback.
class NoCulling final : public osg::NodeCallback {
public:
    NoCulling() = default;
    NoCulling(const NoCulling& other, const osg::CopyOp& copyop)
        : osg::Object(other, copyop), osg::Callback(other, copyop), osg::NodeCallback(other, copyop) {}
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new NoCulling(*this, copyop); }

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override {
        std::optional<CullingMaskScope> mask;
        std::optional<WithoutClusterCulling> clusters;
        if (osg::CullStack* const cullStack = nv->asCullStack()) {
            mask.emplace(*cullStack, osg::CullingSet::NO_CULLING);
            clusters.emplace(*cullStack);
        }
        traverse(node, nv);
    }

protected:
    ~NoCulling() override = default;
};

}  // namespace osgAnalyticBin
