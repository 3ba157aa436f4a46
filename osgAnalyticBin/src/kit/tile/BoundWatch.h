// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osg/Node>

namespace osgAnalyticBin {

/// A callback of the kit that is called when OSG computes the bound of a node, in front of an application's own.
class OSGANALYTICBIN_EXPORT BoundWatch : public osg::Node::ComputeBoundingSphereCallback {
public:
    BoundWatch() = default;
    /// A copy has no other callback behind it.
    BoundWatch(const BoundWatch& other, const osg::CopyOp& copyop)
        : osg::Node::ComputeBoundingSphereCallback(other, copyop) {}

    /// Whether the node has a watch.
    [[nodiscard]] static bool isOn(const osg::Node& node) { return on(node) != nullptr; }
    /// Whether the application has the node's bound computed by a callback of its own.
    [[nodiscard]] static bool hasOwnBound(const osg::Node& node) {
        const BoundWatch* const watch = on(node);
        return watch ? watch->_previous.valid() : node.getComputeBoundingSphereCallback() != nullptr;
    }

protected:
    ~BoundWatch() override = default;

    /// The bound as it is without the watch.
    [[nodiscard]] osg::BoundingSphere boundOf(const osg::Node& node) const {
        return _previous ? _previous->computeBound(node) : node.computeBound();
    }

    osg::ref_ptr<osg::Node::ComputeBoundingSphereCallback> _previous;

private:
    [[nodiscard]] static const BoundWatch* on(const osg::Node& node) {
        return dynamic_cast<const BoundWatch*>(node.getComputeBoundingSphereCallback());
    }
};

}  // namespace osgAnalyticBin
