// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TerrainPicture.h"

#include "Angles.h"
#include "Relief.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

using support::kRadiansPerDegree;
constexpr int kCells = 24;
constexpr double kNear = 100.0;
// Slopes are shaded as if they were this much steeper: from far away they are faint.
constexpr double kSteeper = 6.0;
// A height with the colour of water.
constexpr double kWater = -1000.0;
const glm::dvec3 kSky(214.0, 228.0, 240.0);
const glm::dvec3 kLine(30.0, 30.0, 30.0);

double edgeOf(const glm::dvec3& a, const glm::dvec3& b, double x, double y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// East and north slope to brightness, by a sun 45 degrees high in the north-west.
double brightness(double east, double north) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-kSteeper * east, -kSteeper * north, 1.0));
    const double light = glm::dot(normal, glm::normalize(glm::dvec3(-1.0, 1.0, 1.4)));
    return 0.35 + 0.8 * std::max(0.0, light);
}

}  // namespace

TerrainPicture::TerrainPicture(const Camera& camera, int width)
    : _camera(camera), _width(kFiner * width), _height(kFiner * static_cast<int>(width / Camera::kAspect)) {
    const std::size_t samples = static_cast<std::size_t>(_width) * static_cast<std::size_t>(_height);
    _inverseDepths.assign(samples, 0.0);
    _colours.assign(samples, glm::vec3(kSky));
    _owners.assign(samples, 0);
}

TerrainPicture::Vertex TerrainPicture::vertex(Terrain& terrain, const osgbindem::PositionDeg& position,
                                              double stepDeg) const {
    const auto height = [&](double northDeg, double eastDeg) {
        return terrain.height(
            {std::clamp(position.latitudeDeg + northDeg, -90.0, 90.0), position.longitudeDeg + eastDeg});
    };
    const double here = height(0.0, 0.0);
    const double metres = 2.0 * stepDeg * kRadiansPerDegree * terrain.ellipsoid().equatorialRadius();
    const double cosine = std::max(0.01, std::cos(position.latitudeDeg * kRadiansPerDegree));
    const double light = brightness((height(0.0, stepDeg) - height(0.0, -stepDeg)) / (metres * cosine),
                                    (height(stepDeg, 0.0) - height(-stepDeg, 0.0)) / metres);
    // The sea's surface, and where the raster has no data.
    const bool isWater = here == 0.0 || here <= terrain.floor();
    const osg::Vec4ub rgb = colourAt(hypsometricStops(), isWater ? kWater : here);
    const glm::dvec3 point = terrain.ellipsoid().toEcef(
        {position.latitudeDeg * kRadiansPerDegree, position.longitudeDeg * kRadiansPerDegree, here});
    const glm::dvec3 offset = point - _camera.eye;
    return {{glm::dot(offset, _camera.right), glm::dot(offset, _camera.up), glm::dot(offset, _camera.forward)},
            light * glm::dvec3(rgb[0], rgb[1], rgb[2])};
}

void TerrainPicture::add(Terrain& terrain, const TileId& tile) {
    ++_tiles;
    const osgbindem::RectDeg rect = tile.rect();
    const double stepDeg = (rect.north - rect.south) / kCells;
    terrain.prefetch(rect.grownBy(stepDeg));
    std::vector<Vertex> vertices;
    for (int row = 0; row <= kCells; ++row) {
        for (int column = 0; column <= kCells; ++column) {
            vertices.push_back(
                vertex(terrain, {rect.south + row * stepDeg, rect.west + column * stepDeg}, 0.5 * stepDeg));
        }
    }
    for (std::size_t row = 0; row < kCells; ++row) {
        for (std::size_t column = 0; column < kCells; ++column) {
            const std::size_t i = row * (kCells + 1) + column;
            draw(vertices[i], vertices[i + 1], vertices[i + kCells + 2]);
            draw(vertices[i], vertices[i + kCells + 2], vertices[i + kCells + 1]);
        }
    }
}

// Pixels right and down; the third coordinate is one over the depth.
glm::dvec3 TerrainPicture::onScreen(const glm::dvec3& view) const noexcept {
    const double scale = 0.5 * _height / (_camera.tangent() * view.z);
    return {0.5 * _width + scale * view.x, 0.5 * _height - scale * view.y, 1.0 / view.z};
}

void TerrainPicture::draw(const Vertex& a, const Vertex& b, const Vertex& c) {
    if (std::min({a.view.z, b.view.z, c.view.z}) < kNear) return;
    const glm::dvec3 p = onScreen(a.view);
    const glm::dvec3 q = onScreen(b.view);
    const glm::dvec3 r = onScreen(c.view);
    // East, then north is counterclockwise seen from above; rows run downward.
    const double area = edgeOf(p, q, r.x, r.y);
    if (!(area < 0.0)) return;
    const auto first = [](double lowest) { return static_cast<int>(std::max(0.0, std::floor(lowest))); };
    const auto last = [](double highest, int size) { return static_cast<int>(std::min(highest + 1.0, size - 1.0)); };
    for (int row = first(std::min({p.y, q.y, r.y})); row <= last(std::max({p.y, q.y, r.y}), _height); ++row) {
        for (int column = first(std::min({p.x, q.x, r.x})); column <= last(std::max({p.x, q.x, r.x}), _width);
             ++column) {
            const double u = edgeOf(q, r, column + 0.5, row + 0.5) / area;
            const double v = edgeOf(r, p, column + 0.5, row + 0.5) / area;
            const double t = 1.0 - u - v;
            if (u < 0.0 || v < 0.0 || t < 0.0) continue;
            const double inverseDepth = u * p.z + v * q.z + t * r.z;
            const std::size_t sample = index(column, row);
            if (inverseDepth <= _inverseDepths[sample]) continue;
            _inverseDepths[sample] = inverseDepth;
            _colours[sample] = glm::vec3(u * a.colour + v * b.colour + t * c.colour);
            _owners[sample] = _tiles;
        }
    }
}

bool TerrainPicture::isBorder(int column, int row) const noexcept {
    const std::uint32_t owner = _owners[index(column, row)];
    if (owner == 0) return false;
    for (int d = 1; d <= kFiner; ++d) {
        const std::uint32_t right = column + d < _width ? _owners[index(column + d, row)] : owner;
        const std::uint32_t below = row + d < _height ? _owners[index(column, row + d)] : owner;
        if ((right != owner && right != 0) || (below != owner && below != 0)) return true;
    }
    return false;
}

std::vector<std::uint8_t> TerrainPicture::pixels() const {
    std::vector<std::uint8_t> result;
    for (int row = 0; row < height(); ++row) {
        for (int column = 0; column < width(); ++column) {
            glm::dvec3 sum(0.0);
            for (int i = 0; i < kFiner * kFiner; ++i) {
                const int x = kFiner * column + i % kFiner;
                const int y = kFiner * row + i / kFiner;
                sum += isBorder(x, y) ? kLine : glm::dvec3(_colours[index(x, y)]);
            }
            sum /= kFiner * kFiner;
            for (glm::length_t i = 0; i < 3; ++i)
                result.push_back(static_cast<std::uint8_t>(std::clamp(sum[i], 0.0, 255.0)));
        }
    }
    return result;
}

}  // namespace osgAnalyticBin::paper
