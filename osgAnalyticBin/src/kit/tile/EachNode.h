// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin {

/// Visits all nodes of a subgraph, but nothing below osgTerrain tiles, the same way every time.
template <class Action>
void forEachNode(osg::Node& root, const Action& action) {
    class Visitor : public osg::NodeVisitor {
    public:
        explicit Visitor(const Action& each) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _action(each) {
            setNodeMaskOverride(~0u);
        }
        void apply(osg::Node& node) override {
            _action(node);
            if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
        }

    private:
        const Action& _action;
    };
    Visitor visitor(action);
    root.accept(visitor);
}

}  // namespace osgAnalyticBin
