// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: see support/MappingChecks.h; the geodetic mapping on a sphere.

#include "MercatorHeightField.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/mappings/AutodiffMapping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <support/MappingChecks.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::AutodiffMapping;
using core::ParameterBox;

constexpr double kRadius = 6378137.0;

// The formula alone, without the bound it brings.
struct UnboundedField {
    MercatorHeightField field;
    template <class T>
    core::Vec3<T> operator()(T u, T v, T w) const {
        return field(u, v, w);
    }
};

// A tile of a web map at a zoom level, with terrain.
ParameterBox randomMapTile(Random& random, int zoom) {
    const double half = kPi * kRadius / std::ldexp(1.0, zoom);
    const auto count = static_cast<int>(std::ldexp(1.0, zoom));
    const auto middle = [&] { return -kPi * kRadius + half * (2.0 * random.integer(0, count - 1) + 1.0); };
    return {{middle(), middle(), -1000.0}, {half, half, 10000.0}};
}

TEST(MercatorHeightField, IsTheSphereAtTheMapsLatitudes) {
    Random random(350);
    const core::Ellipsoid sphere(kRadius, kRadius);
    for (int trial = 0; trial < 10000; ++trial) {
        const double latitude = random.uniform(-1.45, 1.45);
        const double longitude = random.uniform(-kPi, kPi);
        const double altitude = random.uniform(-1e4, 1e5);
        const double northing = kRadius * std::log(std::tan(0.25 * kPi + 0.5 * latitude));
        const auto f = MercatorHeightField(kRadius)(longitude * kRadius, northing, altitude);
        ASSERT_LE(glm::distance(glm::dvec3(f.x, f.y, f.z), sphere.toEcef({latitude, longitude, altitude})), 1e-7);
    }
}

TEST(MercatorHeightField, DerivativesMatchDifferences) {
    Random random(351);
    for (int trial = 0; trial < 200; ++trial) {
        expectDerivativesMatchDifferences(AutodiffMapping(MercatorHeightField(kRadius)),
                                          randomMapTile(random, random.integer(4, 12)), random);
    }
}

TEST(MercatorHeightField, RemainderHoldsAndIsTight) {
    constexpr std::array<double, 3> kWorst{2.5, 2.5, 2.5};
    Random random(352);
    for (int zoom = 4; zoom <= 6; ++zoom) {
        double worst = 0.0;
        for (int trial = 0; trial < 60; ++trial) {
            worst = std::max(worst, expectRemainderHolds(AutodiffMapping(MercatorHeightField(kRadius)),
                                                         randomMapTile(random, zoom)));
        }
        std::printf("zoom %d: remainder at most %.2f times the model's error\n", zoom, worst);
        EXPECT_LE(worst, kWorst[static_cast<std::size_t>(zoom - 4)]);
    }
}

TEST(MercatorHeightField, IntervalBoundOfTheSameFormulaHoldsToo) {
    Random random(354);
    double loosest = 0.0;
    for (int trial = 0; trial < 60; ++trial) {
        const ParameterBox box = randomMapTile(random, random.integer(4, 8));
        const AutodiffMapping<UnboundedField> mapping({MercatorHeightField(kRadius)});
        expectRemainderHolds(mapping, box);
        const double byHand = MercatorHeightField(kRadius).remainder(box);
        loosest = std::max(loosest, mapping.remainder(box) / byHand);
    }
    std::printf("interval bound at most %.1f of the bound by hand\n", loosest);
    EXPECT_LE(loosest, 12.0);
}

TEST(MercatorHeightField, NeverContradictsASample) {
    Random random(353);
    for (int trial = 0; trial < 200; ++trial) {
        expectNoContradiction(AutodiffMapping(MercatorHeightField(kRadius)),
                              randomMapTile(random, random.integer(3, 16)), random);
    }
}

TEST(MercatorHeightField, ErrorFallsEightfoldPerHalving) {
    expectErrorFallsEightfold(AutodiffMapping(MercatorHeightField(kRadius)), {{1e6, 3e6, 0.0}, {4e5, 4e5, 1e4}}, 4);
}

}  // namespace
}  // namespace osgAnalyticBin::test
