// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osg/NodeCallback>

namespace osgAnalyticBin {

/// The cull callback of Method::None: for the length of a cull traversal, OSG tests nothing below its node, which OSG
/// tests as always. Its class name is that of a plain osg::NodeCallback, so that nothing of it is saved with a scene.
/// Threads: run() changes nothing in the callback.
class NoCulling final : public osg::NodeCallback {
public:
    NoCulling() = default;
    NoCulling(const NoCulling& other, const osg::CopyOp& copyop);
    osg::Object* clone(const osg::CopyOp& copyop) const override { return new NoCulling(*this, copyop); }

    /// Adds the callback to the node, in front of its others.
    static void place(osg::Node& node);
    /// Removes it.
    static void remove(osg::Node& node);

    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~NoCulling() override = default;
};

}  // namespace osgAnalyticBin
