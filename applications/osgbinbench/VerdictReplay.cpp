// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "VerdictReplay.h"

#include "ClusterCallbacks.h"
#include "Nodes.h"
#include "TileCensus.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/CoordinateSystemNode>
#include <osg/Transform>
#include <osgTerrain/Terrain>

#include <set>
#include <typeinfo>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

using Nodes = std::set<osg::ref_ptr<osg::Node>>;

/// Records the nodes that a cull traversal goes into, and the drawables that it draws.
class Recorder final : public flight::CullWatcher {
public:
    [[nodiscard]] static Nodes keptNodes(osg::Camera& camera, osg::FrameStamp& frameStamp) {
        const osg::ref_ptr<Recorder> recorder = new Recorder;
        recorder->watch(camera, frameStamp);
        return std::move(recorder->_kept);
    }

private:
    void enter(osg::Node&) override {
        const osg::NodePath& path = getNodePath();
        if (path.size() > 1) _kept.insert(path[path.size() - 2]);
    }
    void leave(osg::Node&) override {}
    void draw(osg::Drawable&) override { _kept.insert(getNodePath().back()); }

    Nodes _kept;
};

/// Goes on to some of a node's children.
class AcceptKept : public osg::Callback {
public:
    explicit AcceptKept(osg::NodeList kept) : _kept(std::move(kept)) {}

    bool run(osg::Object*, osg::Object* data) override {
        osg::NodeVisitor& visitor = *data->asNodeVisitor();
        for (const auto& child : _kept) child->accept(visitor);
        return true;
    }

private:
    const osg::NodeList _kept;
};

// Whether a group goes on to each of its children, whatever the view.
bool acceptsAll(const osg::Node& node) {
    return typeid(node) == typeid(osg::Group) || typeid(node) == typeid(osg::CoordinateSystemNode) ||
           typeid(node) == typeid(osgTerrain::Terrain) || node.asTransform();
}

void filter(osg::Group& group, const Nodes& kept) {
    osg::NodeList children;
    for (unsigned int i = 0; i < group.getNumChildren(); ++i)
        if (kept.count(group.getChild(i)) != 0) children.emplace_back(group.getChild(i));
    if (children.size() < group.getNumChildren()) group.addCullCallback(new AcceptKept(std::move(children)));
}

}  // namespace

void replayVerdicts(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    const Nodes kept = Recorder::keptNodes(camera, frameStamp);
    osg::Node& scene = *camera.getChild(0);
    removeBins(scene);
    removeClusterCallbacks(scene);
    for (const auto& node : kept) node->setCullingActive(false);
    support::visitNodes(scene, [&](osg::Node& node, osg::NodeVisitor&) {
        const bool isKept = kept.count(&node) != 0;
        // LODs choose their children by themselves: the mask keeps them out of what was culled
        if (!isKept) node.setNodeMask(0);
        if (isKept && acceptsAll(node)) filter(*node.asGroup(), kept);
        return isKept;
    });
}

}  // namespace osgAnalyticBin::bench
