// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshSurface.h"

#include "../PerThread.h"
#include "Skirts.h"
#include "TerrainLimits.h"

#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin {

namespace {

constexpr std::size_t kEdges = 4;

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

// Metres that a chord of this length, squared, sags at most below its lower end.
double chordSag(double length2, const core::Ellipsoid& ellipsoid) {
    const double smallestRadius = core::smallestCurvatureRadius(ellipsoid) + lowestMesh(ellipsoid);
    return length2 / (8.0 * smallestRadius);
}

// Where skirts do not tell which vertices are on an edge, all may be.
std::array<double, kEdges> edgeLows(const core::MeshBounds& bounds, const MeshSkirts& skirts, double borderSag) {
    const double low = bounds.bin().altitude().lower, error = bounds.altitudeError() + borderSag;
    std::array<double, kEdges> lows = lowestOnEdges(skirts.marks, bounds.altitudes());
    for (double& edge : lows) edge = std::isfinite(edge) ? std::max(edge - error, low) : low;
    return lows;
}

}  // namespace

TileSurface meshSurface(SurfaceMesh& mesh, const core::Ellipsoid& ellipsoid) {
    const MeshSkirts skirts = foldSkirts(mesh, ellipsoid);
    dropUnusedVertices(mesh);
    // keeps its memory: fresh pages from the system for every tile cost a third of the work
    thread_local PerThread<core::MeshBounds> kept;
    core::MeshBounds& bounds = *kept;
    bounds.find(ellipsoid, mesh);
    const core::Interval& altitude = bounds.bin().altitude();
    const bool isTerrain = altitude.lower > lowestMesh(ellipsoid) && altitude.upper < highestTerrain(ellipsoid);
    if (bounds.bin().empty() || !isTerrain) return {};

    TileSurface result;
    const double error =
        ellipsoid.isPlane() ? drawingErrorInMap(largestCoordinate(bounds.bin())) : drawingError(ellipsoid);
    result.bin = AnalyticBin(bounds.bin(), error + bounds.axisError());
    result.bin.setSag(bounds.sag());
    result.edgeLow = edgeLows(bounds, skirts, chordSag(skirts.borderChord2, ellipsoid));
    result.skirt = skirts.depth;
    return result;
}

}  // namespace osgAnalyticBin
