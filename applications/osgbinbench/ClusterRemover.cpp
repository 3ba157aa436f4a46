// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterRemover.h"

#include "Angles.h"
#include "GlmBridge.h"
#include "TileVertices.h"

#include <osgAnalyticBin/TileFrame.h>

#include <glm/geometric.hpp>
#include <osg/PagedLOD>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
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

using support::kPi;
// Tiles that reach farther from their middle than this get no callback; VirtualPlanetBuilder's number.
constexpr double kFarthestAngle = 0.5 * kPi - 0.1;

bool fill(const FoundTile& tile) {
    const auto cluster = clusterOf(verticesOf(tile), toCore(*tile.frame.ellipsoid));
    if (!cluster) return false;
    const osg::Matrixd ecefToLocal = osg::Matrixd::inverse(callbackFrame(tile));
    const glm::dvec3& p = cluster->controlPoint;
    const glm::dvec3& n = cluster->normal;
    const osg::Vec3d normal = osg::Matrixd::transform3x3(osg::Vec3d(n.x, n.y, n.z), ecefToLocal);
    tile.node->addCullCallback(
        new osg::ClusterCullingCallback(osg::Vec3(osg::Vec3d(p.x, p.y, p.z) * ecefToLocal), osg::Vec3(normal),
                                        static_cast<float>(cluster->deviation), static_cast<float>(cluster->radius)));
    return true;
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

std::optional<Cluster> clusterOf(const std::vector<glm::dvec3>& verticesEcef, const core::Ellipsoid& ellipsoid) {
    const auto surface = surfaceOf(verticesEcef, ellipsoid);
    if (!surface) return std::nullopt;
    const glm::dvec3 center = ellipsoid.toEcef(surface->middle);
    const double r = ellipsoid.polarRadius();
    double farthest = 0.0;
    for (const Vertex& v : surface->vertices) {
        const double chord = glm::distance(v.ecef, center);
        const double around = 2.0 * std::asin(std::min(1.0, 0.5 * chord / r));
        const double dip = std::acos(r / (r + std::abs(v.position.altitude)));
        farthest = std::max(farthest, around + dip);
    }
    if (!(farthest < kFarthestAngle)) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(center);
    return Cluster{center + normal * (r / std::cos(farthest) - r), normal, -std::sin(farthest), r * std::tan(farthest)};
}

std::size_t fillClusterCallbacks(osg::Node& graph, const osg::EllipsoidModel* pageOf) {
    if (countClusterCallbacks(graph) > 0) return 0;
    const std::vector<FoundTile> tiles = tilesOnGlobe(graph, pageOf);
    return static_cast<std::size_t>(std::count_if(tiles.begin(), tiles.end(), fill));
}

void ClusterRemover::setTreatment(Clusters treatment, const osg::EllipsoidModel* globe) {
    _treatment = treatment;
    _ellipsoid = globe;
}

ClusterRemover::Result ClusterRemover::readNode(const std::string& fileName, const osgDB::Options* options) {
    Result result = ReadInFront::readNode(fileName, options);
    if (!result.getNode()) return result;
    if (_treatment == Clusters::Remove) removeClusterCallbacks(*result.getNode());
    if (_treatment == Clusters::Fill) fill(*result.getNode());
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
