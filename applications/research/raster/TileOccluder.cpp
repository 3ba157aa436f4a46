// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileOccluder.h"

#include "Angles.h"
#include "BoxBins.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

using support::kPi;
constexpr double kNone = std::numeric_limits<double>::infinity();
// Of a cell: vertices on the border of two cells belong to both.
constexpr double kOnBorder = 1e-3;

double eastOf(const core::Geodetic& middle, const core::Geodetic& position) {
    return std::remainder(position.longitude - middle.longitude, 2.0 * kPi);
}

/// Where a face of a box and its opposite lie along their normal.
struct Extent {
    glm::dvec3 axis{0.0};
    double low = 0.0, high = 0.0;
};

std::array<Extent, 3> extentsOf(const rivals::OrientedBoxBin& box) {
    std::array<Extent, 3> extents;
    std::size_t count = 0;
    for (std::size_t i = 0; i < rivals::OrientedBoxBin::kFaces; ++i) {
        const core::Plane face = box.face(i);
        const auto end = extents.begin() + static_cast<std::ptrdiff_t>(count);
        const auto opposite =
            std::find_if(extents.begin(), end, [&](const Extent& e) { return glm::dot(e.axis, face.normal) < -0.5; });
        // a face says normal.x >= -offset, its opposite axis.x <= offset
        if (opposite != end)
            opposite->high = face.offset;
        else
            extents[count++] = {face.normal, -face.offset, 0.0};
    }
    return extents;
}

}  // namespace

std::optional<OccluderGrid> occluderOf(const std::vector<Vertex>& surface, const core::Geodetic& middle,
                                       const core::Ellipsoid& ellipsoid, int cells) {
    double halfHeight = 0.0;
    double halfWidth = 0.0;
    for (const Vertex& v : surface) {
        halfHeight = std::max(halfHeight, std::abs(v.position.latitude - middle.latitude));
        halfWidth = std::max(halfWidth, std::abs(eastOf(middle, v.position)));
    }
    if (!(halfHeight > 0.0) || !(halfWidth > 0.0)) return std::nullopt;
    const int row = cells + 1;
    std::vector<double> altitudes(static_cast<std::size_t>(row) * static_cast<std::size_t>(row), kNone);
    const auto nodesAround = [&](double offset, double half) {
        const double at = 0.5 * cells * (1.0 + offset / half);
        return std::pair(std::max(0, static_cast<int>(std::ceil(at - 1.0 - kOnBorder))),
                         std::min(cells, static_cast<int>(std::floor(at + 1.0 + kOnBorder))));
    };
    for (const Vertex& v : surface) {
        const auto [west, east] = nodesAround(eastOf(middle, v.position), halfWidth);
        const auto [south, north] = nodesAround(v.position.latitude - middle.latitude, halfHeight);
        for (int j = south; j <= north; ++j) {
            for (int i = west; i <= east; ++i) {
                double& lowest = altitudes[static_cast<std::size_t>(j * row + i)];
                lowest = std::min(lowest, v.position.altitude);
            }
        }
    }
    OccluderGrid grid{cells, ellipsoid.toEcef(middle), {}};
    const auto share = [&](std::size_t at) { return 2.0 * static_cast<double>(at) / cells - 1.0; };
    const auto length = static_cast<std::size_t>(row);
    for (std::size_t node = 0; node < altitudes.size(); ++node) {
        if (altitudes[node] == kNone) return std::nullopt;
        const core::Geodetic at{middle.latitude + share(node / length) * halfHeight,
                                middle.longitude + share(node % length) * halfWidth, altitudes[node]};
        grid.nodes.emplace_back(ellipsoid.toEcef(at) - grid.origin);
    }
    return grid;
}

std::array<glm::dvec3, 8> boxCorners(const AnalyticBin& bin, const core::Ellipsoid& ellipsoid) {
    const std::array<Extent, 3> extents = extentsOf(rivals::OrientedBoxBin(ellipsoid, bin.bin(), bin.margin()));
    std::array<glm::dvec3, 8> corners;
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        corners[corner] = glm::dvec3(0.0);
        for (std::size_t k = 0; k < extents.size(); ++k)
            corners[corner] += extents[k].axis * ((corner >> k & 1U) != 0 ? extents[k].high : extents[k].low);
    }
    return corners;
}

}  // namespace osgAnalyticBin::bench
