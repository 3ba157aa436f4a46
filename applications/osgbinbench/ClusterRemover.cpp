// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterRemover.h"

#include "ClusterFiller.h"
#include "CullMethod.h"

#include <osg/PagedLOD>
#include <osgTerrain/TerrainTile>

#include <algorithm>

namespace osgAnalyticBin::bench {

namespace {

/// Visits all nodes of a graph, masked ones too, but nothing below tiles of osgTerrain: one that is traversed before
/// its first update never finds its Terrain.
class NodeWalk : public osg::NodeVisitor {
public:
    NodeWalk() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        visit(node);
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }

protected:
    virtual void visit(osg::Node& node) = 0;
};

class Remover : public NodeWalk {
public:
    std::size_t removed = 0;

private:
    void visit(osg::Node& node) override {
        while (osg::ClusterCullingCallback* const cluster = clusterCallbackOf(node)) {
            node.removeCullCallback(cluster);
            ++removed;
        }
    }
};

class Counter : public NodeWalk {
public:
    std::size_t count = 0;

private:
    void visit(osg::Node& node) override { count += clusterCallbackOf(node) ? 1U : 0U; }
};

class GlobeFinder : public NodeWalk {
public:
    osg::ref_ptr<osg::EllipsoidModel> ellipsoid;

private:
    void visit(osg::Node& node) override {
        auto* const globe = dynamic_cast<osg::CoordinateSystemNode*>(&node);
        if (!globe || ellipsoid) return;
        ellipsoid = globe->getEllipsoidModel() ? globe->getEllipsoidModel() : new osg::EllipsoidModel;
    }
};

class ExpiryWalk : public NodeWalk {
public:
    explicit ExpiryWalk(double seconds) : _seconds(seconds) {}

private:
    void visit(osg::Node& node) override {
        auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i)
            if (!paged->getFileName(i).empty())
                paged->setMinimumExpiryTime(i, std::max(_seconds, paged->getMinimumExpiryTime(i)));
    }

    double _seconds;
};

}  // namespace

osg::ClusterCullingCallback* clusterCallbackOf(osg::Node& node) {
    for (osg::Callback* callback = node.getCullCallback(); callback; callback = callback->getNestedCallback()) {
        if (auto* const cluster = dynamic_cast<osg::ClusterCullingCallback*>(callback)) return cluster;
    }
    return nullptr;
}

std::size_t removeClusterCallbacks(osg::Node& graph) {
    Remover remover;
    graph.accept(remover);
    return remover.removed;
}

std::size_t countClusterCallbacks(osg::Node& graph) {
    Counter counter;
    graph.accept(counter);
    return counter.count;
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
    GlobeFinder finder;
    graph.accept(finder);
    osg::ref_ptr<const osg::EllipsoidModel> pageOf;
    {
        const std::lock_guard lock(_mutex);
        if (!finder.ellipsoid) pageOf = _ellipsoid;
        if (finder.ellipsoid) _ellipsoid = finder.ellipsoid;
    }
    fillClusterCallbacks(graph, pageOf.get());
    if (_treatment == Clusters::FillForRaster) peers().prepareTiles(graph, pageOf.get());
}

ExpiryRaiser::Result ExpiryRaiser::readNode(const std::string& fileName, const osgDB::Options* options) {
    Result result = ReadInFront::readNode(fileName, options);
    ExpiryWalk walk(_seconds);
    if (result.getNode() && _seconds > 0.0) result.getNode()->accept(walk);
    return result;
}

}  // namespace osgAnalyticBin::bench
