// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterRemover.h"

#include <osg/ClusterCullingCallback>
#include <osg/NodeVisitor>
#include <osgDB/Registry>
#include <osgTerrain/TerrainTile>

namespace osgAnalyticBin::bench {

namespace {

osg::ClusterCullingCallback* clusterCallbackOf(osg::Node& node) {
    for (osg::Callback* callback = node.getCullCallback(); callback; callback = callback->getNestedCallback()) {
        if (auto* const cluster = dynamic_cast<osg::ClusterCullingCallback*>(callback)) return cluster;
    }
    return nullptr;
}

class Remover : public osg::NodeVisitor {
public:
    Remover() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        while (osg::ClusterCullingCallback* const cluster = clusterCallbackOf(node)) {
            node.removeCullCallback(cluster);
            ++removed;
        }
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

    std::size_t removed = 0;
};

}  // namespace

std::size_t removeClusterCallbacks(osg::Node& graph) {
    Remover remover;
    graph.accept(remover);
    return remover.removed;
}

osg::ref_ptr<ClusterRemover> ClusterRemover::install() {
    const osg::ref_ptr<ClusterRemover> remover = new ClusterRemover;
    osgDB::Registry& registry = *osgDB::Registry::instance();
    // A plain callback does what the Registry does by itself.
    remover->_next = registry.getReadFileCallback();
    if (!remover->_next) remover->_next = new osgDB::ReadFileCallback;
    registry.setReadFileCallback(remover);
    return remover;
}

osgDB::ReaderWriter::ReadResult ClusterRemover::readNode(const std::string& fileName, const osgDB::Options* options) {
    osgDB::ReaderWriter::ReadResult result = _next->readNode(fileName, options);
    if (_enabled && result.getNode()) removeClusterCallbacks(*result.getNode());
    return result;
}

}  // namespace osgAnalyticBin::bench
