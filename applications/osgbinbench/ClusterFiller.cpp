// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterFiller.h"

#include "Angles.h"
#include "ClusterRemover.h"
#include "GlmBridge.h"
#include "TileVertices.h"

#include <osgAnalyticBin/TileFrame.h>

#include <glm/geometric.hpp>
#include <osg/ClusterCullingCallback>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::bench {

namespace {

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

}  // namespace osgAnalyticBin::bench
