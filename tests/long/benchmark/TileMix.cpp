// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileMix.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <support/View.h>

namespace osgAnalyticBin::test {

namespace {

using core::Geodetic;
using core::GeodeticBin;

constexpr std::size_t kSites = 4;
constexpr double kEarthRadius = 6.4e6;

Geodetic near(Random& random, const Geodetic& site, double distance) {
    const double heading = random.uniform(-kPi, kPi);
    const double angle = distance / kEarthRadius;
    const double latitude = std::clamp(site.latitude + angle * std::cos(heading), -kHalfPi, kHalfPi);
    const double shrink = std::max(0.05, std::cos(latitude));
    return {latitude, site.longitude + angle * std::sin(heading) / shrink, site.altitude};
}

GeodeticBin tileAt(Random& random, int level, const Geodetic& position) {
    const double tile = std::ldexp(kRootTileDeg, -level) * kRadiansPerDegree;
    const double south = std::min(std::floor(position.latitude / tile) * tile, kHalfPi - tile);
    const double west = std::floor(position.longitude / tile) * tile;
    const double low = random.uniform(-200.0, 3000.0);
    return GeodeticBin({south, south + tile}, {west, west + tile}, {low, low + random.logUniform(10.0, 4000.0)});
}

glm::dvec3 ecef(const Geodetic& position) {
    return wgs84().toEcef(position);
}

// A camera that looks at a target, rolled anyhow.
Frustum frustumAt(Random& random, const glm::dvec3& eye, const glm::dvec3& target) {
    const glm::dvec3 forward = glm::normalize(target - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, random.direction()));
    const glm::dvec3 up = glm::cross(right, forward);
    const double halfWidth = random.uniform(15.0, 35.0) * kRadiansPerDegree;
    const double halfHeight = halfWidth * random.uniform(0.5, 1.0);
    Frustum frustum;
    const auto plane = [&](const glm::dvec3& side, double halfAngle) {
        const glm::dvec3 normal = glm::normalize(forward * std::sin(halfAngle) + side * std::cos(halfAngle));
        return core::Plane{normal, -glm::dot(normal, eye)};
    };
    frustum.planes = {plane(right, halfWidth), plane(-right, halfWidth), plane(up, halfHeight), plane(-up, halfHeight)};
    for (const core::Plane& p : frustum.planes) {
        frustum.set.push_back(p);
        frustum.polytope.add(osg::Plane(p.normal.x, p.normal.y, p.normal.z, p.offset));
    }
    frustum.polytope.setupMask();
    frustum.eye = eye;
    frustum.horizon = core::HorizonEye::fromEye(wgs84(), kOccluderDepth, eye);
    return frustum;
}

}  // namespace

Scene::Scene(Random& random) {
    std::vector<Geodetic> sites;
    for (std::size_t i = 0; i < kSites; ++i) {
        sites.push_back({random.uniform(-1.2, 1.2), random.uniform(-kPi, kPi), 0.0});
    }
    for (std::size_t i = 0; i < kTiles; ++i) {
        const Geodetic position = near(random, sites[i % kSites], random.logUniform(1e3, 2e6));
        tiles.emplace_back(wgs84(), tileAt(random, random.integer(0, kDeepestLevel), position));
    }
    for (std::size_t i = 0; i < kFrusta; ++i) {
        const Geodetic& site = sites[i % kSites];
        const double height = random.logUniform(5e3, 2e6);
        Geodetic eye = near(random, site, random.uniform(0.0, 1.0) * height);
        eye.altitude = height;
        frusta.push_back(frustumAt(random, ecef(eye), ecef(near(random, site, random.uniform(0.0, 1.0) * height))));
    }
}

TileMix::TileMix(Random& random, const Scene& scene, double outsideShare) {
    for (const Frustum& frustum : scene.frusta) {
        std::vector<std::uint32_t> outside;
        std::vector<std::uint32_t> reachedInto;
        for (std::uint32_t i = 0; i < scene.tiles.size(); ++i) {
            (reachInto(frustum, scene.tiles[i]) < 0 ? outside : reachedInto).push_back(i);
        }
        std::vector<std::uint32_t>& chosen = tilesOfFrustum.emplace_back();
        while (chosen.size() < kTilesPerFrustum) {
            const std::vector<std::uint32_t>& from =
                reachedInto.empty() || (!outside.empty() && random.chance(outsideShare)) ? outside : reachedInto;
            chosen.push_back(from[static_cast<std::size_t>(random.integer(0, static_cast<int>(from.size()) - 1))]);
        }
    }
}

bool seesASample(const Frustum& frustum, const BinOracle& tile) {
    const core::GeodeticBin& bin = tile.bin();
    const auto at = [](const core::Interval& interval, int k, int last) {
        return interval.lower + interval.width() * k / last;
    };
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 point = wgs84().toEcef(
            {at(bin.latitude(), i % 5, 4), at(bin.longitude(), i / 5 % 5, 4), at(bin.altitude(), i / 25, 1)});
        const bool inside = std::all_of(frustum.planes.begin(), frustum.planes.end(),
                                        [&](const core::Plane& plane) { return plane.distance(point) > 1e-6; });
        if (inside && segmentMissesOccluder(wgs84(), kOccluderDepth, real(point), real(frustum.eye))) {
            return true;
        }
    }
    return false;
}

Real reachInto(const Frustum& frustum, const BinOracle& tile) {
    Real least = tile.distanceRange(frustum.planes[0]).upper;
    for (const core::Plane& plane : frustum.planes) least = std::min(least, tile.distanceRange(plane).upper);
    return least;
}

}  // namespace osgAnalyticBin::test
