// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/NodeVisitor>

namespace osgAnalyticBin::test {

/// Calls `visit(osg::Node&)` with a node and all below it, drawables too, a node before what it holds.
template <class Visit>
void visitNodes(osg::Node& scene, const Visit& visit) {
    class Visitor : public osg::NodeVisitor {
    public:
        explicit Visitor(const Visit& visit) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _visit(visit) {}
        void apply(osg::Node& node) override {
            _visit(node);
            traverse(node);
        }

    private:
        const Visit& _visit;
    };
    Visitor visitor(visit);
    scene.accept(visitor);
}

}  // namespace osgAnalyticBin::test
