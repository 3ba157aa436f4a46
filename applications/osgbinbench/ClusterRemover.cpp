// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterRemover.h"

#include "ClusterFiller.h"
#include "CullMethod.h"

#include <osg/PagedLOD>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <functional>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

using Visit = std::function<void(osg::Node&)>;

/// Visits all nodes of a graph, masked ones too, but nothing below tiles of osgTerrain: one that is traversed before
/// its first update never finds its Terrain.
class NodeWalk final : public osg::NodeVisitor {
public:
    explicit NodeWalk(Visit visit) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _visit(std::move(visit)) {
        setNodeMaskOverride(~0U);
    }

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        _visit(node);
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

private:
    const Visit _visit;
};

void forAllNodes(osg::Node& graph, Visit visit) {
    NodeWalk walk(std::move(visit));
    graph.accept(walk);
}

osg::ref_ptr<osg::EllipsoidModel> ellipsoidOf(osg::Node& graph) {
    osg::ref_ptr<osg::EllipsoidModel> ellipsoid;
    forAllNodes(graph, [&](osg::Node& node) {
        auto* const globe = dynamic_cast<osg::CoordinateSystemNode*>(&node);
        if (!globe || ellipsoid) return;
        ellipsoid = globe->getEllipsoidModel() ? globe->getEllipsoidModel() : new osg::EllipsoidModel;
    });
    return ellipsoid;
}

}  // namespace

osg::ClusterCullingCallback* clusterCallbackOf(osg::Node& node) {
    for (osg::Callback* callback = node.getCullCallback(); callback; callback = callback->getNestedCallback()) {
        if (auto* const cluster = dynamic_cast<osg::ClusterCullingCallback*>(callback)) return cluster;
    }
    return nullptr;
}

std::size_t removeClusterCallbacks(osg::Node& graph) {
    std::size_t removed = 0;
    forAllNodes(graph, [&](osg::Node& node) {
        while (osg::ClusterCullingCallback* const cluster = clusterCallbackOf(node)) {
            node.removeCullCallback(cluster);
            ++removed;
        }
    });
    return removed;
}

std::size_t countClusterCallbacks(osg::Node& graph) {
    std::size_t count = 0;
    forAllNodes(graph, [&](osg::Node& node) { count += clusterCallbackOf(node) ? 1U : 0U; });
    return count;
}

void ClusterRemover::setTreatment(Clusters treatment, const osg::EllipsoidModel* globe) {
    _treatment = treatment;
    _ellipsoid = globe;
}

ClusterRemover::Result ClusterRemover::readNode(const std::string& fileName, const osgDB::Options* options) {
    Result result = ReadInFront::readNode(fileName, options);
    if (!result.getNode()) return result;
    if (_treatment == Clusters::Remove) removeClusterCallbacks(*result.getNode());
    if (_treatment == Clusters::Fill || _treatment == Clusters::FillForRaster) fill(*result.getNode());
    return result;
}

void ClusterRemover::fill(osg::Node& graph) {
    const osg::ref_ptr<osg::EllipsoidModel> own = ellipsoidOf(graph);
    osg::ref_ptr<const osg::EllipsoidModel> pageOf;
    {
        const std::lock_guard lock(_mutex);
        if (own)
            _ellipsoid = own;
        else
            pageOf = _ellipsoid;
    }
    fillClusterCallbacks(graph, pageOf.get());
    if (_treatment == Clusters::FillForRaster) peers().prepareTiles(graph, pageOf.get());
}

ExpiryRaiser::Result ExpiryRaiser::readNode(const std::string& fileName, const osgDB::Options* options) {
    Result result = ReadInFront::readNode(fileName, options);
    const double seconds = _seconds;
    if (!result.getNode() || !(seconds > 0.0)) return result;
    forAllNodes(*result.getNode(), [seconds](osg::Node& node) {
        auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i)
            if (!paged->getFileName(i).empty())
                paged->setMinimumExpiryTime(i, std::max(seconds, paged->getMinimumExpiryTime(i)));
    });
    return result;
}

}  // namespace osgAnalyticBin::bench
