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
// What float vertices lose once more on their way to the screen.
constexpr double kDrawing = 0.01;
// Coarse meshes sag far below the ellipsoid; what leaves these altitudes is no terrain.
constexpr double kLowestMesh = -1.0e6;
constexpr double kHighestMesh = 5.0e4;
constexpr std::size_t kEdges = 4;

// Takes the skirts out of a mesh: their triangles, and, in place of their vertices and of those that no triangle uses,
// any vertex of the surface. Returns: the length in metres of the longest chord of the border.
double keepSurface(SurfaceMesh& mesh, const MeshSkirts& skirts) {
    std::vector<std::uint8_t> isUsed(mesh.size(), 0);
    double longest2 = 0.0;
    std::uint32_t* kept = mesh.triangles.data();
    const std::uint32_t* const end = kept + mesh.triangles.size() / 3 * 3;
    const std::uint8_t* marks = skirts.marks.empty() ? nullptr : skirts.marks.data();
    const auto noteChord = [&](std::uint32_t i, std::uint32_t j) {
        if ((marks[i] | marks[j]) & kSkirtVertex) return;
        const glm::dvec3 chord = mesh.vertex(i) - mesh.vertex(j);
        longest2 = std::max(longest2, glm::dot(chord, chord));
    };
    for (const std::uint32_t* t = kept; t != end; t += 3) {
        if (marks && ((marks[t[0]] | marks[t[1]] | marks[t[2]]) & kSkirtVertex)) {
            noteChord(t[0], t[1]);
            noteChord(t[1], t[2]);
            noteChord(t[2], t[0]);
            continue;
        }
        isUsed[t[0]] = isUsed[t[1]] = isUsed[t[2]] = 1;
        for (int corner = 0; corner < 3; ++corner) *kept++ = t[corner];
    }
    mesh.triangles.resize(static_cast<std::size_t>(kept - mesh.triangles.data()));
    if (mesh.triangles.empty()) return 0.0;
    const glm::dvec3 any = mesh.vertex(mesh.triangles.front());
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        if (isUsed[i]) continue;
        mesh.x[i] = any.x;
        mesh.y[i] = any.y;
        mesh.z[i] = any.z;
    }
    return std::sqrt(longest2);
}

// What has to be known of a mesh, whichever way it was found.
struct MeshBounds {
    core::GeodeticBin bin;
    double sag = 0.0;
    std::vector<double> altitudes;
    bool touchesAxis = true;
};

// For meshes that wrap half the globe, or are no terrain.
MeshBounds thoroughBounds(const SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < mesh.size(); ++i) sum += mesh.vertex(i);
    if (!std::isfinite(sum.x + sum.y + sum.z)) return {};
    MeshBounds result;
    core::GeodeticMeshBounds bounds(ellipsoid, std::atan2(sum.y, sum.x), kAxisTolerance);
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        bounds.expandByVertex(mesh.vertex(i));
        result.altitudes.push_back(ellipsoid.toGeodetic(mesh.vertex(i)).altitude);
        lowest = std::min(lowest, result.altitudes.back());
    }
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        bounds.expandByTriangle(mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]),
                                mesh.vertex(mesh.triangles[i + 2]));
    }
    result.bin = bounds.bin();
    result.sag = lowest - result.bin.altitude().lower;
    return result;
}

MeshBounds boundsOf(const SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    core::QuickMeshBounds quick(ellipsoid, mesh);
    if (!quick.isKnown()) return thoroughBounds(mesh, ellipsoid);
    MeshBounds result{quick.bin(), quick.sag(), quick.takeAltitudes(), quick.touchesAxis()};
    for (double& altitude : result.altitudes) altitude -= quick.altitudeError();
    return result;
}

// Metres that a chord of this length sags at most below its lower end.
double chordSag(double length, const core::Ellipsoid& ellipsoid) {
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    const double smallestRadius = std::min(a * a / b, b * b / a) + kLowestMesh;
    return length * length / (8.0 * smallestRadius);
}

std::array<double, kEdges> edgeLows(const MeshBounds& bounds, const MeshSkirts& skirts, double borderSag) {
    const double low = bounds.bin.altitude().lower;
    std::array<double, kEdges> lows;
    lows.fill(skirts.marks.empty() ? low : std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < skirts.marks.size(); ++i) {
        const unsigned int marks = skirts.marks[i];
        if (marks == 0 || (marks & kSkirtVertex)) continue;
        for (std::size_t edge = 0; edge < kEdges; ++edge)
            if ((marks >> edge) & 1u) lows[edge] = std::min(lows[edge], bounds.altitudes[i]);
    }
    for (double& edge : lows) edge = std::isfinite(edge) ? std::max(edge - borderSag, low) : low;
    return lows;
}

}  // namespace

TileSurface meshSurface(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    const MeshSkirts skirts = findSkirts(mesh, ellipsoid);
    const double borderChord = keepSurface(mesh, skirts);
    if (mesh.triangles.empty()) return {};
    const MeshBounds bounds = boundsOf(mesh, ellipsoid);
    const core::Interval& altitude = bounds.bin.altitude();
    if (bounds.bin.empty() || altitude.lower <= kLowestMesh || altitude.upper >= kHighestMesh) return {};

    TileSurface result;
    result.bin = AnalyticBin(bounds.bin, kDrawing + (bounds.touchesAxis ? kAxisTolerance : 0.0));
    result.bin.setSag(bounds.sag);
    result.edgeLow = edgeLows(bounds, skirts, chordSag(borderChord, ellipsoid));
    result.skirt = skirts.depth;
    return result;
}

}  // namespace osgAnalyticBin
