// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshSurface.h"

#include "Skirts.h"

#include <osgAnalyticBin/core/GeodeticMeshBounds.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin {

namespace {

// Float vertices about the axis are that far off at most; they get no longitude of their own.
constexpr double kAxisTolerance = 1.0;
// Coarse meshes sag far below the ellipsoid; what leaves these altitudes is no terrain.
constexpr double kLowestMesh = -1.0e6;
constexpr double kHighestMesh = 5.0e4;
constexpr std::size_t kEdges = 4;

// The triangles that are no skirts, and the vertices that these use.
struct Surface {
    std::vector<std::uint32_t> triangles;
    std::vector<std::uint32_t> vertices;
    double longestBorderChord = 0.0;  // metres
};

class SurfaceFilter {
public:
    SurfaceFilter(const SurfaceMesh& mesh, const MeshSkirts& skirts)
        : _mesh(mesh), _marks(skirts.marks), _isUsed(mesh.size(), 0) {}

    Surface run() {
        for (std::size_t i = 0; i + 2 < _mesh.triangles.size(); i += 3) add(&_mesh.triangles[i]);
        for (std::uint32_t i = 0; i < _isUsed.size(); ++i)
            if (_isUsed[i]) _surface.vertices.push_back(i);
        return std::move(_surface);
    }

private:
    void add(const std::uint32_t* corners) {
        const bool isSkirt = !_marks.empty() && std::any_of(corners, corners + 3, [this](std::uint32_t i) {
            return (_marks[i] & kSkirtVertex) != 0;
        });
        if (isSkirt) return noteBorder(corners);
        _surface.triangles.insert(_surface.triangles.end(), corners, corners + 3);
        for (int i = 0; i < 3; ++i) _isUsed[corners[i]] = 1;
    }

    // A skirt hangs from a chord of the border.
    void noteBorder(const std::uint32_t* corners) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = corners[i];
            const std::uint32_t b = corners[(i + 1) % 3];
            if (((_marks[a] | _marks[b]) & kSkirtVertex) != 0) continue;
            const double length = glm::length(_mesh.vertex(a) - _mesh.vertex(b));
            _surface.longestBorderChord = std::max(_surface.longestBorderChord, length);
        }
    }

    const SurfaceMesh& _mesh;
    const std::vector<std::uint8_t>& _marks;
    std::vector<std::uint8_t> _isUsed;
    Surface _surface;
};

double middleLongitude(const SurfaceMesh& mesh, const Surface& surface) {
    glm::dvec3 sum(0.0);
    for (const std::uint32_t i : surface.vertices) sum += mesh.vertex(i);
    return std::atan2(sum.y, sum.x);
}

core::GeodeticBin boundsOf(const SurfaceMesh& mesh, const Surface& surface, const core::Ellipsoid& ellipsoid) {
    core::GeodeticMeshBounds bounds(ellipsoid, middleLongitude(mesh, surface), kAxisTolerance);
    for (const std::uint32_t i : surface.vertices) bounds.expandByVertex(mesh.vertex(i));
    for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
        bounds.expandByTriangle(mesh.vertex(surface.triangles[i]), mesh.vertex(surface.triangles[i + 1]),
                                mesh.vertex(surface.triangles[i + 2]));
    }
    return bounds.bin();
}

// Metres that a chord of this length sags at most below its lower end.
double chordSag(double length, const core::Ellipsoid& ellipsoid) {
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    const double smallestRadius = std::min(a * a / b, b * b / a) + kLowestMesh;
    return length * length / (8.0 * smallestRadius);
}

std::array<double, kEdges> edgeLows(const SurfaceMesh& mesh, const Surface& surface, const MeshSkirts& skirts,
                                    const core::Ellipsoid& ellipsoid, double low) {
    std::array<double, kEdges> lows;
    lows.fill(low);
    if (skirts.marks.empty()) return lows;
    lows.fill(std::numeric_limits<double>::infinity());
    for (const std::uint32_t i : surface.vertices) {
        const unsigned int marks = skirts.marks[i];
        if (marks == 0) continue;
        const double altitude = ellipsoid.toGeodetic(mesh.vertex(i)).altitude;
        for (std::size_t edge = 0; edge < kEdges; ++edge)
            if ((marks >> edge) & 1u) lows[edge] = std::min(lows[edge], altitude);
    }
    const double sag = chordSag(surface.longestBorderChord, ellipsoid);
    for (double& edge : lows) edge = std::isfinite(edge) ? std::max(edge - sag, low) : low;
    return lows;
}

}  // namespace

TileSurface meshSurface(const SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    const MeshSkirts skirts = findSkirts(mesh, ellipsoid);
    const Surface surface = SurfaceFilter(mesh, skirts).run();
    if (surface.triangles.empty()) return {};
    const core::GeodeticBin bin = boundsOf(mesh, surface, ellipsoid);
    const bool isTerrain = !bin.empty() && bin.altitude().lower > kLowestMesh && bin.altitude().upper < kHighestMesh;
    if (!isTerrain) return {};

    TileSurface result;
    result.bin = AnalyticBin(bin, kAxisTolerance);
    result.edgeLow = edgeLows(mesh, surface, skirts, ellipsoid, bin.altitude().lower);
    result.skirt = skirts.depth;
    return result;
}

}  // namespace osgAnalyticBin
