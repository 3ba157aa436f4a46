// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Callback>
#include <osg/Node>
#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin::support {

/// The first callback of a class in a chain; nullptr where there is none.
template <class Callback>
[[nodiscard]] Callback* findCallback(osg::Callback* chain) {
    for (; chain; chain = chain->getNestedCallback())
        if (auto* const found = dynamic_cast<Callback*>(chain)) return found;
    return nullptr;
}

/// Visits the nodes of a graph, drawables and masked ones too, a node before what it holds, but nothing below tiles of
/// osgTerrain: one that is traversed before its first update never finds its Terrain.
/// `visit(node, visitor)` returns whether to go below the node.
template <class Visit>
void visitNodes(osg::Node& graph, const Visit& visit) {
    class Visitor final : public osg::NodeVisitor {
    public:
        explicit Visitor(const Visit& visit) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _visit(visit) {
            setNodeMaskOverride(~0U);
        }

        using osg::NodeVisitor::apply;
        void apply(osg::Node& node) override {
            if (_visit(node, *this) && !dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
        }

    private:
        const Visit& _visit;
    };
    Visitor visitor(visit);
    graph.accept(visitor);
}

/// The same with `visit(node)`, of all nodes.
template <class Visit>
void forAllNodes(osg::Node& graph, const Visit& visit) {
    visitNodes(graph, [&](osg::Node& node, osg::NodeVisitor&) {
        visit(node);
        return true;
    });
}

}  // namespace osgAnalyticBin::support
