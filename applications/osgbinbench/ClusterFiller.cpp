// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterFiller.h"

#include "Angles.h"
#include "ClusterRemover.h"
#include "GlmBridge.h"
#include "TileVertices.h"

#include <osgAnalyticBin/TileFinder.h>

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
    if (verticesEcef.empty()) return std::nullopt;
    const std::vector<Vertex> vertices = placed(verticesEcef, ellipsoid);
    const core::Geodetic middle = middleOf(vertices);
    const glm::dvec3 center = ellipsoid.toEcef(middle);
    const double r = ellipsoid.polarRadius();
    const auto isAround = [&](const Vertex& v) { return !(glm::dot(upAt(v.position), upAt(middle)) > 0.0); };
    if (std::any_of(vertices.begin(), vertices.end(), isAround)) return std::nullopt;
    double farthest = 0.0;
    for (const Vertex& v : withoutSkirts(vertices, middle)) {
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
    TileFrame frame;
    frame.ellipsoid = pageOf;
    frame.isBelowTile = pageOf != nullptr;
    std::size_t filled = 0;
    for (const FoundTile& tile : findTiles(graph, frame)) {
        const bool isOnGlobe = tile.frame.ellipsoid && !isMapPlane(*tile.frame.ellipsoid);
        if (isOnGlobe && fill(tile)) ++filled;
    }
    return filled;
}

}  // namespace osgAnalyticBin::bench
