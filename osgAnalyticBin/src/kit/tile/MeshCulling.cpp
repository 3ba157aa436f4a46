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
#include <typeinfo>
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

// Has the class name of an osg::ClusterCullingCallback and the values of the original: it is saved and cloned as one.
class SuspendedCluster final : public osg::ClusterCullingCallback {
public:
    explicit SuspendedCluster(osg::ClusterCullingCallback& original)
        : osg::Object(original),
          osg::Callback(original),
          osg::ClusterCullingCallback(original, osg::CopyOp::SHALLOW_COPY),
          _original(&original) {}

    [[nodiscard]] osg::ClusterCullingCallback* original() const { return _original.get(); }

    bool cull(osg::NodeVisitor*, osg::Drawable*, osg::State*) const override { return false; }

protected:
    ~SuspendedCluster() override = default;

private:
    const osg::ref_ptr<osg::ClusterCullingCallback> _original;
};

// Replaces a callback of a node. The old one keeps its nested callbacks, because several nodes may share it.
void exchange(osg::Node& node, osg::Callback* old, osg::Callback* fresh) {
    fresh->setNestedCallback(old->getNestedCallback());
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

void forEachNode(osg::Node& root, std::function<void(osg::Node&)> action) {
    ForEachNode visitor(std::move(action));
    root.accept(visitor);
}

// Clones share user data with their original: what is noted of one node is not to be noted of the other.
void ownValues(osg::Node& node) {
    const osg::UserDataContainer* const values = node.getUserDataContainer();
    if (!values || values->referenceCount() == 1) return;
    const osg::ref_ptr<osg::UserDataContainer> own = osg::clone(values, osg::CopyOp::SHALLOW_COPY);
    node.setUserDataContainer(own);
}

void forgetEmptyValues(osg::Node& node) {
    const osg::UserDataContainer* const values = node.getUserDataContainer();
    const bool isEmpty =
        values && values->getNumUserObjects() == 0 && !values->getUserData() && values->getNumDescriptions() == 0;
    if (isEmpty) node.setUserDataContainer(nullptr);
}

bool isClusterCulling(const osg::Callback& callback) {
    return typeid(callback) == typeid(SuspendedCluster) || typeid(callback) == typeid(osg::ClusterCullingCallback);
}

bool isSuspendedCluster(const osg::Callback& callback) {
    return &typeid(callback) == &typeid(SuspendedCluster);
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
            exchange(node, suspended, suspended->original());
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
