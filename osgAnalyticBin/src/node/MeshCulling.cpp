// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshCulling.h"

#include <osg/ClusterCullingCallback>
#include <osg/Drawable>
#include <osg/NodeVisitor>
#include <osg/UserDataContainer>
#include <osg/ValueObject>
#include <osgTerrain/TerrainTile>

#include <functional>
#include <utility>

namespace osgAnalyticBin {

namespace {

// A user value of nodes whose culling is suspended.
constexpr const char* kWasCulling = "osgAnalyticBin culling";

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

void forEachNode(osg::Node& root, std::function<void(osg::Node&)> action) {
    ForEachNode visitor(std::move(action));
    root.accept(visitor);
}

// Says of itself that it is an osg::ClusterCullingCallback, and holds what the original held: it is saved as that.
class SuspendedCluster final : public osg::ClusterCullingCallback {
public:
    explicit SuspendedCluster(const osg::ClusterCullingCallback& original)
        : osg::Object(original),
          osg::Callback(original),
          osg::ClusterCullingCallback(original, osg::CopyOp::SHALLOW_COPY) {}

    bool cull(osg::NodeVisitor*, osg::Drawable*, osg::State*) const override { return false; }

protected:
    ~SuspendedCluster() override = default;
};

// Puts one callback of a node in the place of another.
void exchange(osg::Node& node, osg::Callback* old, osg::Callback* fresh) {
    osg::Callback* nested = old->getNestedCallback();
    fresh->setNestedCallback(nested);
    old->setNestedCallback(nullptr);
    if (node.getCullCallback() == old) {
        node.setCullCallback(fresh);
        return;
    }
    for (osg::Callback* before = node.getCullCallback(); before; before = before->getNestedCallback()) {
        if (before->getNestedCallback() == old) return before->setNestedCallback(fresh);
    }
}

std::vector<osg::ref_ptr<osg::Callback>> cullCallbacks(osg::Node& node) {
    std::vector<osg::ref_ptr<osg::Callback>> callbacks;
    for (osg::Callback* c = node.getCullCallback(); c; c = c->getNestedCallback()) callbacks.emplace_back(c);
    return callbacks;
}

}  // namespace

void setSphereCulling(osg::Node& mesh, bool active) {
    forEachNode(mesh, [active](osg::Node& node) {
        if (!node.asDrawable()) node.setCullingActive(active);
    });
}

void suspendCullingOf(osg::Node& node) {
    if (!node.getCullingActive()) return;
    node.setCullingActive(false);
    node.setUserValue(kWasCulling, true);
}

void resumeCullingOf(osg::Node& node) {
    osg::UserDataContainer* values = node.getUserDataContainer();
    const unsigned int index = values ? values->getUserObjectIndex(kWasCulling) : 0;
    if (!values || index >= values->getNumUserObjects()) return;
    values->removeUserObject(index);
    node.setCullingActive(true);
}

void suspendCulling(osg::Node& mesh) {
    forEachNode(mesh, suspendCullingOf);
}

void resumeCulling(osg::Node& mesh) {
    forEachNode(mesh, resumeCullingOf);
}

void suspendClusterCullingOf(osg::Node& node) {
    for (const auto& callback : cullCallbacks(node)) {
        auto* cluster = dynamic_cast<osg::ClusterCullingCallback*>(callback.get());
        if (cluster && !dynamic_cast<SuspendedCluster*>(cluster)) {
            const osg::ref_ptr<osg::Callback> suspended = new SuspendedCluster(*cluster);
            exchange(node, cluster, suspended.get());
        }
    }
}

void resumeClusterCullingOf(osg::Node& node) {
    for (const auto& callback : cullCallbacks(node)) {
        if (auto* suspended = dynamic_cast<SuspendedCluster*>(callback.get())) {
            const osg::ref_ptr<osg::Callback> cluster =
                new osg::ClusterCullingCallback(*suspended, osg::CopyOp::SHALLOW_COPY);
            exchange(node, suspended, cluster.get());
        }
    }
}

void suspendClusterCulling(osg::Node& mesh) {
    forEachNode(mesh, suspendClusterCullingOf);
}

void resumeClusterCulling(osg::Node& mesh) {
    forEachNode(mesh, resumeClusterCullingOf);
}

}  // namespace osgAnalyticBin
