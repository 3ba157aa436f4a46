// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ClusterCallbacks.h"

#include "GlmBridge.h"
#include "Nodes.h"

#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/TileFrame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>
#include <osg/ClusterCullingCallback>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Transform>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace osgAnalyticBin::bench {

namespace {

using support::forAllNodes;
// Tiles that reach farther from their middle than this get no callback; VirtualPlanetBuilder's number.
constexpr double kFarthestAngle = glm::half_pi<double>() - 0.1;

osg::ClusterCullingCallback* clusterCallbackOf(osg::Node& node) {
    return support::findCallback<osg::ClusterCullingCallback>(node.getCullCallback());
}

/// A vertex of a tile on a globe.
struct Vertex {
    glm::dvec3 ecef{0.0};
    core::Geodetic position;
    glm::dvec3 up{0.0};
};

// The middle of the vertices' latitudes and longitudes, on the ellipsoid. Requires: a vertex.
core::Geodetic middleOf(const std::vector<Vertex>& vertices) {
    constexpr double kAtPole = 1e-7;  // radians; nearer to a pole a longitude says nothing
    glm::dvec3 sum(0.0);
    for (const Vertex& v : vertices) sum += v.ecef;
    const double about = std::atan2(sum.y, sum.x);
    core::Interval latitude = core::Interval::none(), longitude = latitude;
    for (const Vertex& v : vertices) {
        latitude.expandBy(v.position.latitude);
        if (std::abs(v.position.latitude) < glm::half_pi<double>() - kAtPole)
            longitude.expandBy(std::remainder(v.position.longitude - about, glm::two_pi<double>()));
    }
    return {latitude.middle(), about + longitude.middle(), 0.0};
}

/// Finds which vertices stand below another one, in columns about the verticals of a tile's ellipsoid, narrow beside
/// the spacing of its vertices.
class Columns {
public:
    // Requires: no vertex a quarter turn from the middle or farther.
    Columns(const std::vector<Vertex>& vertices, double middleLongitude, const glm::dvec3& middleUp)
        : _east(-std::sin(middleLongitude), std::cos(middleLongitude), 0.0),
          _north(glm::cross(middleUp, _east)),
          _width(1e-12) {
        for (const Vertex& v : vertices) _width = std::max(_width, 2.0 * glm::length(placeOf(v)) / kColumns);
        for (const Vertex& v : vertices) {
            const Vertex*& highest = _highest[key(placeOf(v) / _width)];
            if (!highest || highest->position.altitude < v.position.altitude) highest = &v;
        }
    }

    [[nodiscard]] bool isBelowAnother(const Vertex& v) const {
        const glm::dvec2 place = placeOf(v) / _width;
        for (const glm::dvec2& aside : {glm::dvec2(-kNear, -kNear), {-kNear, kNear}, {kNear, -kNear}, {kNear, kNear}}) {
            const auto found = _highest.find(key(place + aside));
            if (found == _highest.end() || found->second->position.altitude <= v.position.altitude) continue;
            if (glm::distance(placeOf(*found->second) / _width, place) < kNear) return true;
        }
        return false;
    }

private:
    static constexpr double kColumns = 1024.0;  // along a tile
    static constexpr double kNear = 0.25;       // of a column's width

    // The vertical's components across the vertical of the middle: equal for vertices above each other.
    [[nodiscard]] glm::dvec2 placeOf(const Vertex& v) const { return {glm::dot(v.up, _east), glm::dot(v.up, _north)}; }

    [[nodiscard]] static std::int64_t key(const glm::dvec2& place) {
        const auto whole = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
        return whole(place.x) * 4 * static_cast<std::int64_t>(kColumns) + whole(place.y);
    }

    glm::dvec3 _east, _north;
    double _width;
    std::unordered_map<std::int64_t, const Vertex*> _highest;
};

void addVertices(osg::Node& mesh, const osg::Matrixd& localToEcef, std::vector<glm::dvec3>& vertices) {
    support::visitNodes(mesh, [&](osg::Node& node, osg::NodeVisitor& visitor) {
        const osg::Geometry* const geometry = node.asGeometry();
        const auto* const array = geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
        const osg::Matrixd toEcef = osg::computeLocalToWorld(visitor.getNodePath()) * localToEcef;
        for (std::size_t i = 0; array && i < array->size(); ++i)
            vertices.push_back(toGlm(osg::Vec3d((*array)[i]) * toEcef));
        return true;
    });
}

bool fill(const FoundTile& tile) {
    // a cull callback of a transform sees the eye in the transform's own frame
    const osg::Transform* const transform = tile.node->asTransform();
    const osg::Matrixd inside = transform ? frameInside(*transform, tile.frame) : tile.frame.localToEcef;
    std::vector<glm::dvec3> vertices;
    for (const osg::ref_ptr<osg::Node>& mesh : tile.meshes)
        addVertices(*mesh, mesh == tile.node ? tile.frame.localToEcef : inside, vertices);
    const auto cluster = clusterOf(vertices, toCore(*tile.frame.ellipsoid));
    if (!cluster) return false;
    const osg::Matrixd ecefToLocal = osg::Matrixd::inverse(inside);
    const glm::dvec3& p = cluster->controlPoint;
    const glm::dvec3& n = cluster->normal;
    const osg::Vec3d normal = osg::Matrixd::transform3x3(osg::Vec3d(n.x, n.y, n.z), ecefToLocal);
    tile.node->addCullCallback(
        new osg::ClusterCullingCallback(osg::Vec3(osg::Vec3d(p.x, p.y, p.z) * ecefToLocal), osg::Vec3(normal),
                                        static_cast<float>(cluster->deviation), static_cast<float>(cluster->radius)));
    return true;
}

}  // namespace

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

std::optional<Cluster> clusterOf(const std::vector<glm::dvec3>& verticesEcef, const core::Ellipsoid& ellipsoid) {
    std::vector<Vertex> vertices;
    for (const glm::dvec3& ecef : verticesEcef) {
        const core::Geodetic position = ellipsoid.toGeodetic(ecef);
        vertices.push_back({ecef, position, ellipsoid.up(position.latitude, position.longitude)});
    }
    if (vertices.empty()) return std::nullopt;
    const core::Geodetic middle = middleOf(vertices);
    const glm::dvec3 up = ellipsoid.up(middle.latitude, middle.longitude);
    const auto isNear = [&](const Vertex& v) { return glm::dot(v.up, up) > 0.0; };
    if (!std::all_of(vertices.begin(), vertices.end(), isNear)) return std::nullopt;
    const Columns columns(vertices, middle.longitude, up);
    const glm::dvec3 center = ellipsoid.toEcef(middle);
    const double r = ellipsoid.polarRadius();
    double farthest = 0.0;
    for (const Vertex& v : vertices) {
        if (columns.isBelowAnother(v)) continue;
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
    bool hasOwn = false;
    forAllNodes(graph, [&](osg::Node& node) { hasOwn = hasOwn || clusterCallbackOf(node); });
    if (hasOwn) return 0;
    TileFrame frame;
    frame.ellipsoid = pageOf;
    frame.isBelowTile = pageOf != nullptr;
    const std::vector<FoundTile> tiles = findTiles(graph, frame);
    return static_cast<std::size_t>(std::count_if(tiles.begin(), tiles.end(), [](const FoundTile& tile) {
        return tile.frame.ellipsoid && !isMapPlane(*tile.frame.ellipsoid) && fill(tile);
    }));
}

}  // namespace osgAnalyticBin::bench
