// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshSurface.h"

#include "Skirts.h"
#include "TerrainLimits.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin {

namespace {

// Metres on the earth, in proportion elsewhere: float vertices about the axis are that far off at most; they get no
// longitude of their own.
constexpr double kAxisTolerance = 1.0;
constexpr std::size_t kEdges = 4;

// What has to be known of a mesh, whichever way it was found.
struct MeshBounds {
    core::GeodeticBin bin;
    double sag = 0.0;
    std::array<double, kEdges> edgeLow{};  // of the vertices that are marked so
    bool touchesAxis = true;
};

std::array<double, kEdges> lowestOnEdges(const std::vector<std::uint8_t>& marks, const std::vector<double>& altitudes) {
    std::array<double, kEdges> lows;
    lows.fill(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] == 0) continue;
        for (std::size_t edge = 0; edge < kEdges; ++edge)
            if ((static_cast<unsigned int>(marks[i]) >> edge) & 1u) lows[edge] = std::min(lows[edge], altitudes[i]);
    }
    return lows;
}

// For meshes that wrap half the globe, or are no terrain.
MeshBounds thoroughBounds(const SurfaceMesh& mesh, const MeshSkirts& skirts, const core::Ellipsoid& ellipsoid) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < mesh.size(); ++i) sum += mesh.vertex(i);
    if (!std::isfinite(sum.x + sum.y + sum.z)) return {};
    MeshBounds result;
    core::GeodeticMeshBounds bounds(ellipsoid, std::atan2(sum.y, sum.x), kAxisTolerance * core::earthScale(ellipsoid));
    std::vector<double> altitudes;
    altitudes.reserve(mesh.size());
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        bounds.expandByVertex(mesh.vertex(i));
        altitudes.push_back(ellipsoid.toGeodetic(mesh.vertex(i)).altitude);
    }
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        bounds.expandByTriangle(mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]),
                                mesh.vertex(mesh.triangles[i + 2]));
    }
    result.bin = bounds.bin();
    result.sag = *std::min_element(altitudes.begin(), altitudes.end()) - result.bin.altitude().lower;
    result.edgeLow = lowestOnEdges(skirts.marks, altitudes);
    return result;
}

MeshBounds boundsOf(const SurfaceMesh& mesh, const MeshSkirts& skirts, const core::Ellipsoid& ellipsoid) {
    // keeps its memory: fresh pages from the system for every tile cost a third of the work
    thread_local core::QuickMeshBounds quick;
    quick.find(ellipsoid, mesh);
    if (!quick.isKnown()) return thoroughBounds(mesh, skirts, ellipsoid);
    MeshBounds result{quick.bin(), quick.sag(), lowestOnEdges(skirts.marks, quick.altitudes()), quick.touchesAxis()};
    for (double& low : result.edgeLow) low -= quick.altitudeError();
    return result;
}

// Metres that a chord of this length, squared, sags at most below its lower end.
double chordSag(double length2, const core::Ellipsoid& ellipsoid) {
    const double smallestRadius = core::smallestCurvatureRadius(ellipsoid) + lowestMesh(ellipsoid);
    return length2 / (8.0 * smallestRadius);
}

// Where skirts do not tell which vertices are on an edge, all may be.
std::array<double, kEdges> edgeLows(const MeshBounds& bounds, double borderSag) {
    const double low = bounds.bin.altitude().lower;
    std::array<double, kEdges> lows = bounds.edgeLow;
    for (double& edge : lows) edge = std::isfinite(edge) ? std::max(edge - borderSag, low) : low;
    return lows;
}

}  // namespace

TileSurface meshSurface(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    const MeshSkirts skirts = foldSkirts(mesh, ellipsoid);
    dropUnusedVertices(mesh);
    const MeshBounds bounds = boundsOf(mesh, skirts, ellipsoid);
    const core::Interval& altitude = bounds.bin.altitude();
    const bool isTerrain = altitude.lower > lowestMesh(ellipsoid) && altitude.upper < highestTerrain(ellipsoid);
    if (bounds.bin.empty() || !isTerrain) return {};

    TileSurface result;
    const double offset = bounds.touchesAxis ? core::earthScale(ellipsoid) * kAxisTolerance : 0.0;
    result.bin = AnalyticBin(bounds.bin, drawingError(ellipsoid) + offset);
    result.bin.setSag(bounds.sag);
    result.edgeLow = edgeLows(bounds, chordSag(skirts.borderChord2, ellipsoid));
    result.skirt = skirts.depth;
    return result;
}

}  // namespace osgAnalyticBin
