// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Parts that are put on, or happen to, a scene that is built already; copies of scenes.

#pragma once

#include "Description.h"

namespace osgAnalyticBin::test {

/// Calls `visit(node)` with all nodes, whatever is switched off; it returns whether to go on below the node. A terrain
/// tile that is traversed before it has its Terrain never finds it afterwards.
template <class Visit>
void walk(osg::Node& subgraph, const Visit& visit) {
    struct Walker : osg::NodeVisitor {
        explicit Walker(const Visit& what) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), visit(what) {
            setNodeMaskOverride(~0u);
        }
        void apply(osg::Node& node) override {
            if (visit(node) && !dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
        }
        const Visit& visit;
    } walker(visit);
    subgraph.accept(walker);
}

/// The first node of this name, whatever is switched off. Returns: nullptr when there is none.
[[nodiscard]] osg::Node* findNode(osg::Node& subgraph, const std::string& name);

/// From the frame of houses in a file of their own to that of their database.
[[nodiscard]] osg::Matrixd frameOfHouses(const Part& part, const Description& description);

/// Does to a subgraph what a part says, if the node that it is for is in there. Parts that are for the whole scene, or
/// built in, are left alone.
void applyPart(const Part& part, const Description& description, osg::Node& subgraph);

/// Takes a model out again.
void removePart(const Part& part, osg::Node& scene);

/// The scene as it comes back from a file, .osgt or .osgb.
[[nodiscard]] osg::ref_ptr<osg::Group> savedAndLoaded(const osg::Group& scene, bool asText);

/// `variant`: what is copied, and what is shared.
[[nodiscard]] osg::ref_ptr<osg::Group> clonedScene(const osg::Group& scene, int variant);

}  // namespace osgAnalyticBin::test
