// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The truth that the other tests lean on is itself tested: the closed form against sampling and climbing, the
// inverse mapping against the mapping.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

// What climbing leaves below the true extremum, as a share of the bin's size: its last step is 2^-24 of a cell, in
// altitude or at an end as well, where the bin's edge is met exactly.
constexpr double kClimbingError = 1e-10;

TEST(GeodeticOracle, ClosedFormHoldsEverySampleAndIsReached) {
    Random random(1);
    double worst = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
        const core::Ellipsoid ellipsoid = randomEllipsoid(random);
        const BinKind kind = random.pick(kBinKinds);
        const BinOracle oracle(ellipsoid, randomBin(random, kind));
        const core::Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const RealRange truth = oracle.distanceRange(plane);
        const RealRange sampled = sampledDistanceRange(ellipsoid, oracle.bin(), plane, 8);
        const Real rounding = oracle.rounding(plane);
        ASSERT_LE(truth.lower, sampled.lower + rounding) << nameOf(kind);
        ASSERT_GE(truth.upper, sampled.upper - rounding) << nameOf(kind);
        const double size = sizeOf(ellipsoid, oracle.bin());
        const Real gap = std::max(sampled.lower - truth.lower, truth.upper - sampled.upper) - rounding;
        worst = std::max(worst, static_cast<double>(gap) / size);
        ASSERT_LE(gap, kClimbingError * size) << nameOf(kind);
    }
    RecordProperty("largestGapPerSize", std::to_string(worst));
}

TEST(GeodeticOracle, InverseReturnsToTheSamePoint) {
    Random random(2);
    for (int trial = 0; trial < 4000; ++trial) {
        const core::Ellipsoid ellipsoid = randomEllipsoid(random);
        const RealVector point = real(random.direction() * random.uniform(0.9, 1.1) * ellipsoid.equatorialRadius());
        const RealGeodetic position = ecefToGeodetic(ellipsoid, point);
        const RealVector back = geodeticToEcef(ellipsoid, position.latitude, position.longitude, position.altitude);
        ASSERT_LE(length(back - point), 1e-11L);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
