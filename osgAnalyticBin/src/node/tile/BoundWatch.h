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
    BoundWatch(const BoundWatch& other, const osg::CopyOp& copyop);

    /// Whether the node has a watch.
    [[nodiscard]] static bool isOn(const osg::Node& node);
    /// Whether the application has the node's bound computed by a callback of its own.
    [[nodiscard]] static bool hasOwnBound(const osg::Node& node);

protected:
    ~BoundWatch() override = default;

    /// The bound as it is without the watch.
    [[nodiscard]] osg::BoundingSphere boundOf(const osg::Node& node) const;

    osg::ref_ptr<osg::Node::ComputeBoundingSphereCallback> _previous;
};

}  // namespace osgAnalyticBin
