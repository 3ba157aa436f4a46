// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin::bench {

/// Visits all nodes of a graph, masked ones too, but nothing below tiles of osgTerrain: one that is traversed before
/// its first update never finds its Terrain.
class NodeWalk : public osg::NodeVisitor {
public:
    NodeWalk() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        visit(node);
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

protected:
    virtual void visit(osg::Node& node) = 0;
};

}  // namespace osgAnalyticBin::bench
