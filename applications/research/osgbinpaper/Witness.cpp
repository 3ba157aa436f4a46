// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Witness.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace osgAnalyticBin::paper {

namespace {

constexpr int kSearchSteps = 6;
constexpr int kHalvings = 14;
// Of the radius: what rounding may add to a line of sight that ends on the globe.
constexpr double kGrazing = 1e-9;

// A position of the unit cube, in latitude, longitude and altitude.
using Shares = glm::dvec3;

double depthOf(const glm::dvec3& point, const std::array<core::Plane, 4>& planes) {
    double least = std::numeric_limits<double>::infinity();
    for (const core::Plane& plane : planes) least = std::min(least, plane.distance(point));
    return least;
}

struct Best {
    Shares shares{0.5};
    double depth = -std::numeric_limits<double>::infinity();
};

// Steps along the axes and along the diagonals, which a corner between two sides of the frustum needs.
template <class Depth>
void climb(const Depth& depth, glm::length_t axes, Best& best) {
    double step = 0.5 / kSearchSteps;
    for (int halving = 0; halving < kHalvings; step *= 0.5, ++halving) {
        const Shares from = best.shares;
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                Shares to = from + step * glm::dvec3(i, j, 0.0);
                to = {std::clamp(to.x, 0.0, 1.0), std::clamp(to.y, 0.0, 1.0), to.z};
                const double value = depth(to);
                if (value > best.depth) best = {to, value};
            }
        }
        if (axes < 3) continue;
        for (const double z : {0.0, 1.0}) {
            const Shares to{best.shares.x, best.shares.y, z};
            const double value = depth(to);
            if (value > best.depth) best = {to, value};
        }
    }
}

template <class Depth>
Best deepest(const Depth& depth, glm::length_t axes) {
    Best best;
    for (int i = 0; i <= kSearchSteps; ++i) {
        for (int j = 0; j <= kSearchSteps; ++j) {
            for (int k = 0; k <= (axes < 3 ? 0 : 1); ++k) {
                const Shares shares{static_cast<double>(i) / kSearchSteps, static_cast<double>(j) / kSearchSteps, k};
                const double value = depth(shares);
                if (value > best.depth) best = {shares, value};
            }
        }
    }
    climb(depth, axes, best);
    return best;
}

// Whether the ellipsoid leaves the line of sight free.
bool isInSight(const core::Ellipsoid& ellipsoid, const glm::dvec3& eye, const glm::dvec3& point) {
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    const glm::dvec3 from = point / radii;
    const glm::dvec3 step = eye / radii - from;
    const double nearest = std::clamp(-glm::dot(from, step) / glm::dot(step, step), 0.0, 1.0);
    return glm::length(from + nearest * step) >= 1.0 - kGrazing;
}

}  // namespace

core::Geodetic positionIn(const core::GeodeticBin& bin, const glm::dvec3& shares) noexcept {
    return {bin.latitude().lower + shares.x * bin.latitude().width(),
            bin.longitude().lower + shares.y * bin.longitude().width(),
            bin.altitude().lower + shares.z * bin.altitude().width()};
}

std::optional<Witness> findWitness(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                                   const Camera& camera) {
    const std::array<core::Plane, 4> planes = camera.planes();
    const auto depth = [&](const Shares& shares) { return depthOf(ellipsoid.toEcef(positionIn(bin, shares)), planes); };
    const Best best = deepest(depth, 3);
    if (!(best.depth > 0.0)) return std::nullopt;
    return Witness{positionIn(bin, best.shares), best.depth};
}

std::optional<Witness> findTerrainWitness(Terrain& terrain, const core::GeodeticBin& bin, const Camera& camera) {
    const std::array<core::Plane, 4> planes = camera.planes();
    const auto depth = [&](const Shares& shares) {
        const glm::dvec3 point = terrain.ellipsoid().toEcef(terrain.onSurface(positionIn(bin, shares)));
        if (!isInSight(terrain.ellipsoid(), camera.eye, point)) return -std::numeric_limits<double>::infinity();
        return depthOf(point, planes);
    };
    const Best best = deepest(depth, 2);
    if (!(best.depth > 0.0)) return std::nullopt;
    return Witness{terrain.onSurface(positionIn(bin, best.shares)), best.depth};
}

}  // namespace osgAnalyticBin::paper
