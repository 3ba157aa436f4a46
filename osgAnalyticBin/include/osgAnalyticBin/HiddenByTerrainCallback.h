// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/Export.h>

#include <osg/NodeCallback>

namespace osg {
class CullStack;
}

namespace osgAnalyticBin {

/// A cull callback for aircraft, buildings, trees: leaves out its node while the terrain of a database with bins hides
/// it, behind hills or behind the horizon. OSG tests the node's bounding sphere against the view before. The node may
/// be beside the database or in it, and may move: it is asked for where it is in this frame. Put it on a node that
/// stands in one place of the scene; on a drawable it does nothing.
/// The node is drawn in doubt: where the visitor comes to it before it comes to the database, and where the database
/// hides nothing in this view (doc/architecture.md says when). It is also drawn where what is below it may be drawn
/// outside of its sphere, or in front of what is nearer: with states, callbacks and classes that are not known to be
/// harmless (osgText is one of these), wide lines and points, billboards, bounds computed by the application, culling
/// that is switched off. Nested callbacks run when the node is drawn.
/// Guarantee: a node is left out only if each line of sight to its sphere meets drawn terrain before; tests:
/// HiddenByTerrain.*.
/// Threads: run() changes nothing in the callback; it may be shared by nodes.
/// Cost: some ten nanoseconds for a node that is not hidden. For one that is, what is below it is looked through: some
/// ten nanoseconds for each node there.
class OSGANALYTICBIN_EXPORT HiddenByTerrainCallback : public osg::NodeCallback {
public:
    HiddenByTerrainCallback() = default;
    /// Copies nested callbacks; the callback has no state of its own.
    HiddenByTerrainCallback(const HiddenByTerrainCallback& other,
                            const osg::CopyOp& copyop = osg::CopyOp::SHALLOW_COPY);

    META_Object(osgAnalyticBin, HiddenByTerrainCallback);

    /// Called by OSG's cull traversal: goes on below the node unless it is hidden.
    void operator()(osg::Node* node, osg::NodeVisitor* nv) override;

protected:
    ~HiddenByTerrainCallback() override = default;
};

}  // namespace osgAnalyticBin
