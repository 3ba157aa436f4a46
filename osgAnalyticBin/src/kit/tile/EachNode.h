// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../Classes.h"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/MatrixTransform>
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
            const bool isKnown = isExactly<osg::Group>(node) || isExactly<osg::Geode>(node) ||
                                 isExactly<osg::MatrixTransform>(node) || isExactly<osg::Geometry>(node);
            if (isKnown || !dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
        }

    private:
        const Action& _action;
    };
    Visitor visitor(action);
    root.accept(visitor);
}

}  // namespace osgAnalyticBin
