// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What must hold for any bin that tells how far its points are from a plane. `make(ellipsoid, bin, margin)` makes it;
// `tolerance(planeCase)`: metres by which two evaluations of the same geometry may differ.

#pragma once

#include "CoreTest.h"

namespace osgAnalyticBin::test {

/// A bin of any kind, and a plane near it or far from it.
struct PlaneCase {
    explicit PlaneCase(Random& random)
        : kind(random.pick(kBinKinds)),
          oracle(randomEllipsoid(random), randomBin(random, kind)),
          plane(randomPlane(random, oracle, random.pick(kPlaneKinds))) {}

    BinKind kind;
    BinOracle oracle;
    core::Plane plane;
};

inline void expectSideOf(const core::Plane& plane, const RealVector& point, core::Side side, BinKind kind) {
    const Real distance = exactDistance(plane, point);
    ASSERT_TRUE(side != core::Side::Outside || distance < 0) << nameOf(kind);
    ASSERT_TRUE(side != core::Side::Inside || distance >= 0) << nameOf(kind);
}

template <class Make, class Tolerance>
void expectMarginToWidenTheRangeByItself(Random& random, const Make& make, const Tolerance& tolerance) {
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const double margin = random.logUniform(1e-3, 1e5);
        const auto bare = make(c.oracle.ellipsoid(), c.oracle.bin(), 0.0);
        const auto wide = make(c.oracle.ellipsoid(), c.oracle.bin(), margin);
        const double most = 2e-9 * margin + tolerance(c);
        ASSERT_NEAR(bare.distanceRange(c.plane).lower - wide.distanceRange(c.plane).lower, margin, most);
        ASSERT_NEAR(wide.distanceRange(c.plane).upper - bare.distanceRange(c.plane).upper, margin, most);
        const core::Side side = wide.classify(c.plane);
        if (side == core::Side::Straddling) continue;
        const RealVector point = geodeticToEcef(c.oracle.ellipsoid(), randomPosition(random, c.oracle.bin())) +
                                 real(margin * 0.999999 * random.direction());
        ASSERT_NO_FATAL_FAILURE(expectSideOf(c.plane, point, side, c.kind));
    }
}

template <class Make>
void expectPlanesWithoutNumbersToBeUndecided(const Make& make) {
    const auto bin = make(wgs84(), kOneDegree, 0.0);
    for (int broken = 0; broken < 4; ++broken) {
        core::Plane plane{{1.0, 0.0, 0.0}, -1e9};
        ASSERT_EQ(bin.classify(plane), core::Side::Outside);
        (broken < 3 ? plane.normal[broken] : plane.offset) = kNaN;
        EXPECT_EQ(bin.classify(plane), core::Side::Straddling) << broken;
        EXPECT_EQ(bin.classify({-plane.normal, -plane.offset}), core::Side::Straddling) << broken;
    }
    for (const double offset : {kInfinity, -kInfinity})
        EXPECT_EQ(bin.classify({{1.0, 0.0, 0.0}, offset}), core::Side::Straddling);
}

}  // namespace osgAnalyticBin::test
