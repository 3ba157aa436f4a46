// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "EachNode.h"

#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

#include <utility>

namespace osgAnalyticBin {

namespace {

class ForEachNode : public osg::NodeVisitor {
public:
    explicit ForEachNode(std::function<void(osg::Node&)> action)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _action(std::move(action)) {
        setNodeMaskOverride(~0u);
    }
    void apply(osg::Node& node) override {
        _action(node);
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

private:
    const std::function<void(osg::Node&)> _action;
};

}  // namespace

void forEachNode(osg::Node& root, std::function<void(osg::Node&)> action) {
    ForEachNode visitor(std::move(action));
    root.accept(visitor);
}

}  // namespace osgAnalyticBin
