// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Evidence that something is drawn as its vertices say. Only what is known to be harmless counts: unknown attributes,
// modes, classes and callbacks do not.

#pragma once

#include <osg/Node>
#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osg/Viewport>
#include <osgTerrain/TerrainTile>

namespace osgUtil {
class CullVisitor;
class StateGraph;
}  // namespace osgUtil

namespace osgAnalyticBin {

/// What is known of the way in which something is drawn and culled.
struct DrawnState {
    /// Front faces are drawn whole and opaque, back faces too or not, at the depths of their vertices.
    bool hides = true;
    /// Nothing is drawn where something nearer is, and nothing beside the triangles of the vertices, as lines and
    /// points are: what hides the triangles hides all.
    bool obeysDepth = true;
    /// OSG may cull it: osg::Node::setCullingActive() has not switched that off, as it is for light sources and
    /// absolute transforms.
    bool isCulled = true;

    DrawnState& operator&=(const DrawnState& other) {
        hides = hides && other.hides;
        obeysDepth = obeysDepth && other.obeysDepth;
        isCulled = isCulled && other.isCulled;
        return *this;
    }
};

/// The reasons, of InstalledTile::Reason, that something gives for all tiles above it.
[[nodiscard]] unsigned int reasonsAbove(const DrawnState& drawn);

/// What else is known. By itself: in a frame that does not mirror, whatever the camera.
struct StateRules {
    /// In the present frame of a visitor.
    [[nodiscard]] static StateRules of(osg::NodeVisitor& visitor, bool trustsShaders);

    /// All programs draw all of each triangle where its vertices are: CullOptions::plainShaders.
    bool trustsShaders = false;
    /// The winding of front faces: clockwise where the matrices mirror.
    bool isClockwise = false;
    /// Where the camera draws; a state may set this one. Null: none.
    const osg::Viewport* viewport = nullptr;
};

/// Of a state by itself, whatever stands above or below it: combinations of states that are each harmless are harmless.
[[nodiscard]] DrawnState drawnState(const osg::StateSet& state, const StateRules& rules);

/// The same for a node that may have no state.
[[nodiscard]] inline DrawnState drawnStateOf(const osg::Node& node, const StateRules& rules) {
    return node.getStateSet() ? drawnState(*node.getStateSet(), rules) : DrawnState();
}

/// Of a node by its state and its class, whatever its callbacks, its primitives and what is below it.
[[nodiscard]] DrawnState drawnStateByClass(const osg::Node& node, const StateRules& rules);

/// Whether a callback may change a node between cull traversals.
[[nodiscard]] inline bool mayChange(const osg::Node& node) {
    return node.getUpdateCallback() || node.getEventCallback();
}

/// Whether a node draws no lines and no points, which are drawn wider than their vertices reach.
[[nodiscard]] bool drawsFaces(const osg::Node& node);

/// Of the states of a graph and of those above it, without `end` and those above that.
[[nodiscard]] DrawnState drawnStates(const osgUtil::StateGraph* graph, const osgUtil::StateGraph* end,
                                     const StateRules& rules);

/// Whether a state of a visitor's graph, or of those above it, says whether depth is tested. True for what is drawn
/// without an osg::View: there an application may have told OpenGL by itself.
[[nodiscard]] bool saysDepthTest(osgUtil::CullVisitor& visitor, const osgUtil::StateGraph* graph);

/// Of the states from the camera to the visitor's present node, or from below `end` where it is among them. Returns:
/// all is known for visitors that collect no state.
[[nodiscard]] DrawnState drawnStateAbove(osg::NodeVisitor& visitor, const StateRules& rules,
                                         const osgUtil::StateGraph* end = nullptr);

/// Whether a traversal has come to a terrain tile, which makes its technique then.
[[nodiscard]] bool hasBeenTraversed(const osgTerrain::TerrainTile& tile);

/// Whether a node is known to draw all of its children: switches, levels of detail, sequences and classes of others may
/// leave some out.
[[nodiscard]] bool drawsAllChildren(const osg::Node& node);

}  // namespace osgAnalyticBin
