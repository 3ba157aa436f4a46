// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileVertices.h"

#include "Angles.h"
#include "GlmBridge.h"

#include <osgAnalyticBin/TileFinder.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <unordered_map>

namespace osgAnalyticBin::bench {

namespace {

using support::kPi;
// Columns along a tile, narrow beside the spacing of its vertices.
constexpr double kColumns = 1024.0;
// Nearer to a pole a longitude says nothing, in radians.
constexpr double kAtPole = 1e-7;

struct Range {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
    void expandBy(double value) {
        lower = std::min(lower, value);
        upper = std::max(upper, value);
    }
    [[nodiscard]] double middle() const { return 0.5 * (lower + upper); }
};

glm::dvec3 upAt(const core::Geodetic& p, const core::Ellipsoid& ellipsoid) {
    return ellipsoid.up(p.latitude, p.longitude);
}

// The middle of the vertices' latitudes and longitudes, on the ellipsoid. Requires: a vertex.
core::Geodetic middleOf(const std::vector<Vertex>& vertices) {
    glm::dvec3 sum(0.0);
    for (const Vertex& v : vertices) sum += v.ecef;
    const double about = std::atan2(sum.y, sum.x);
    Range latitude;
    Range longitude;
    for (const Vertex& v : vertices) {
        latitude.expandBy(v.position.latitude);
        if (std::abs(v.position.latitude) < 0.5 * kPi - kAtPole)
            longitude.expandBy(std::remainder(v.position.longitude - about, 2.0 * kPi));
    }
    return {latitude.middle(), about + longitude.middle(), 0.0};
}

// Finds which vertices stand below another one, in columns about the verticals of a tile's ellipsoid.
class Columns {
public:
    // Requires: no vertex a quarter turn from the middle or farther.
    Columns(const std::vector<Vertex>& vertices, const core::Geodetic& middle, const core::Ellipsoid& ellipsoid)
        : _ellipsoid(ellipsoid),
          _east(-std::sin(middle.longitude), std::cos(middle.longitude), 0.0),
          _north(glm::cross(upAt(middle, ellipsoid), _east)),
          _width(1e-12) {
        for (const Vertex& v : vertices) _width = std::max(_width, 2.0 * glm::length(placeOf(v)) / kColumns);
        for (const Vertex& v : vertices) {
            const glm::dvec2 place = placeOf(v) / _width;
            const Vertex*& highest = _highest[key(place)];
            if (!highest || highest->position.altitude < v.position.altitude) highest = &v;
        }
    }

    [[nodiscard]] bool isBelowAnother(const Vertex& v) const {
        const glm::dvec2 place = placeOf(v) / _width;
        for (const double x : {-kNear, kNear}) {
            for (const double y : {-kNear, kNear}) {
                const auto found = _highest.find(key(place + glm::dvec2(x, y)));
                if (found == _highest.end() || found->second->position.altitude <= v.position.altitude) continue;
                if (glm::distance(placeOf(*found->second) / _width, place) < kNear) return true;
            }
        }
        return false;
    }

private:
    // Of a column's width.
    static constexpr double kNear = 0.25;

    // The vertical's components across the vertical of the middle: equal for vertices above each other.
    [[nodiscard]] glm::dvec2 placeOf(const Vertex& v) const {
        const glm::dvec3 up = upAt(v.position, _ellipsoid);
        return {glm::dot(up, _east), glm::dot(up, _north)};
    }

    [[nodiscard]] static std::int64_t key(const glm::dvec2& place) {
        const auto whole = [](double x) { return static_cast<std::int64_t>(std::floor(x)); };
        return whole(place.x) * 4 * static_cast<std::int64_t>(kColumns) + whole(place.y);
    }

    const core::Ellipsoid& _ellipsoid;
    glm::dvec3 _east, _north;
    double _width;
    std::unordered_map<std::int64_t, const Vertex*> _highest;
};

class MeshVertices : public osg::NodeVisitor {
public:
    explicit MeshVertices(const osg::Matrixd& localToEcef)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _localToEcef(localToEcef) {
        setNodeMaskOverride(~0U);
    }

    using osg::NodeVisitor::apply;
    void apply(osg::Group& node) override {
        if (!dynamic_cast<osgTerrain::TerrainTile*>(&node)) traverse(node);
    }
    void apply(osg::Transform& node) override {
        const osg::Matrixd outer = _localToEcef;
        node.computeLocalToWorldMatrix(_localToEcef, this);
        traverse(node);
        _localToEcef = outer;
    }
    void apply(osg::Geometry& geometry) override {
        const auto* const array = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
        if (!array) return;
        for (const osg::Vec3& v : *array) vertices.push_back(toGlm(osg::Vec3d(v) * _localToEcef));
    }

    std::vector<glm::dvec3> vertices;

private:
    osg::Matrixd _localToEcef;
};

}  // namespace

osg::Matrixd callbackFrame(const FoundTile& tile) {
    const osg::Transform* const transform = tile.node->asTransform();
    return transform ? frameInside(*transform, tile.frame) : tile.frame.localToEcef;
}

std::vector<glm::dvec3> verticesOf(const FoundTile& tile) {
    std::vector<glm::dvec3> vertices;
    for (const osg::ref_ptr<osg::Node>& mesh : tile.meshes) {
        MeshVertices visitor(mesh == tile.node ? tile.frame.localToEcef : callbackFrame(tile));
        mesh->accept(visitor);
        vertices.insert(vertices.end(), visitor.vertices.begin(), visitor.vertices.end());
    }
    return vertices;
}

std::optional<TileSurface> surfaceOf(const std::vector<glm::dvec3>& verticesEcef, const core::Ellipsoid& ellipsoid) {
    if (verticesEcef.empty()) return std::nullopt;
    std::vector<Vertex> vertices;
    for (const glm::dvec3& v : verticesEcef) vertices.push_back({v, ellipsoid.toGeodetic(v)});
    TileSurface surface;
    surface.middle = middleOf(vertices);
    const glm::dvec3 up = upAt(surface.middle, ellipsoid);
    const auto isNear = [&](const Vertex& v) { return glm::dot(upAt(v.position, ellipsoid), up) > 0.0; };
    if (!std::all_of(vertices.begin(), vertices.end(), isNear)) return std::nullopt;
    const Columns columns(vertices, surface.middle, ellipsoid);
    std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(surface.vertices),
                 [&](const Vertex& v) { return !columns.isBelowAnother(v); });
    return surface;
}

std::vector<FoundTile> tilesOnGlobe(osg::Node& graph, const osg::EllipsoidModel* pageOf) {
    TileFrame frame;
    frame.ellipsoid = pageOf;
    frame.isBelowTile = pageOf != nullptr;
    std::vector<FoundTile> tiles = findTiles(graph, frame);
    const auto isOnGlobe = [](const FoundTile& tile) {
        return tile.frame.ellipsoid && !isMapPlane(*tile.frame.ellipsoid);
    };
    tiles.erase(std::stable_partition(tiles.begin(), tiles.end(), isOnGlobe), tiles.end());
    return tiles;
}

}  // namespace osgAnalyticBin::bench
