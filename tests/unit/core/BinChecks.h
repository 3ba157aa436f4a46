// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What must hold for any bin that tells how far its points are from a plane. `make(ellipsoid, bin, margin)` makes it;
// `tolerance(planeCase)`: metres by which two evaluations of the same geometry may differ.

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/Plane.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <support/Numbers.h>
#include <support/RandomBins.h>

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
    if (side == core::Side::Outside) {
        ASSERT_LT(distance, 0) << nameOf(kind);
    }
    if (side == core::Side::Inside) {
        ASSERT_GE(distance, 0) << nameOf(kind);
    }
}

template <class Make>
void expectNoContradictionOfASample(Random& random, const Make& make) {
    std::array<int, 3> verdicts{};
    for (int trial = 0; trial < 20000; ++trial) {
        const PlaneCase c(random);
        const core::Side side = make(c.oracle.ellipsoid(), c.oracle.bin(), 0.0).classify(c.plane);
        ++verdicts[static_cast<std::size_t>(side)];
        if (side == core::Side::Straddling) continue;
        for (int i = 0; i < 30; ++i) {
            const RealVector point = geodeticToEcef(c.oracle.ellipsoid(), randomPosition(random, c.oracle.bin()));
            ASSERT_NO_FATAL_FAILURE(expectSideOf(c.plane, point, side, c.kind));
        }
    }
    for (const int count : verdicts) EXPECT_GT(count, 1000) << "every verdict must occur, or nothing is tested";
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
    const auto bin = make(wgs84(), core::GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0}), 0.0);
    for (int broken = 0; broken < 4; ++broken) {
        core::Plane plane{{1.0, 0.0, 0.0}, -1e9};
        ASSERT_EQ(bin.classify(plane), core::Side::Outside);
        (broken < 3 ? plane.normal[broken] : plane.offset) = kNaN;
        EXPECT_EQ(bin.classify(plane), core::Side::Straddling) << broken;
        EXPECT_EQ(bin.classify(plane.flipped()), core::Side::Straddling) << broken;
    }
    for (const double offset : {kInfinity, -kInfinity}) {
        EXPECT_EQ(bin.classify({{1.0, 0.0, 0.0}, offset}), core::Side::Straddling);
    }
}

template <class Make>
void expectFlippedPlanesToFlipTheRange(Random& random, const Make& make) {
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const auto bin = make(c.oracle.ellipsoid(), c.oracle.bin(), 0.0);
        const core::Interval range = bin.distanceRange(c.plane);
        const core::Interval flipped = bin.distanceRange(c.plane.flipped());
        ASSERT_EQ(flipped.lower, -range.upper);
        ASSERT_EQ(flipped.upper, -range.lower);
    }
}

inline void expectSameRange(const core::Interval& a, const core::Interval& b, double tolerance) {
    ASSERT_NEAR(a.lower, b.lower, tolerance);
    ASSERT_NEAR(a.upper, b.upper, tolerance);
}

/// `turnsFullCircles`: whether bins all around the earth, whose middle is fixed, shall turn too.
template <class Make, class Tolerance>
void expectRangesToTurnWithTheEarth(Random& random, const Make& make, const Tolerance& tolerance,
                                    bool turnsFullCircles) {
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const core::GeodeticBin& bin = c.oracle.bin();
        const double turn = random.uniform(-kPi, kPi);
        const core::GeodeticBin turned(bin.latitude(), {bin.longitude().lower + turn, bin.longitude().upper + turn},
                                       bin.altitude());
        if (!turnsFullCircles && (turned.isFullCircle() || bin.isFullCircle())) continue;
        const glm::dvec3& n = c.plane.normal;
        const core::Plane plane{
            {n.x * std::cos(turn) - n.y * std::sin(turn), n.x * std::sin(turn) + n.y * std::cos(turn), n.z},
            c.plane.offset};
        ASSERT_NO_FATAL_FAILURE(expectSameRange(make(c.oracle.ellipsoid(), turned, 0.0).distanceRange(plane),
                                                make(c.oracle.ellipsoid(), bin, 0.0).distanceRange(c.plane),
                                                tolerance(c)));
    }
}

template <class Make, class Tolerance>
void expectRangesToMirrorWithTheHemispheres(Random& random, const Make& make, const Tolerance& tolerance) {
    for (int trial = 0; trial < 50000; ++trial) {
        const PlaneCase c(random);
        const core::Ellipsoid& ellipsoid = c.oracle.ellipsoid();
        const core::GeodeticBin& bin = c.oracle.bin();
        const core::GeodeticBin south({-bin.latitude().upper, -bin.latitude().lower}, bin.longitude(), bin.altitude());
        const core::GeodeticBin west(bin.latitude(), {-bin.longitude().upper, -bin.longitude().lower}, bin.altitude());
        const core::Interval range = make(ellipsoid, bin, 0.0).distanceRange(c.plane);
        const core::Plane downward{c.plane.normal * glm::dvec3(1.0, 1.0, -1.0), c.plane.offset};
        const core::Plane westward{c.plane.normal * glm::dvec3(1.0, -1.0, 1.0), c.plane.offset};
        ASSERT_NO_FATAL_FAILURE(
            expectSameRange(make(ellipsoid, south, 0.0).distanceRange(downward), range, tolerance(c)));
        ASSERT_NO_FATAL_FAILURE(
            expectSameRange(make(ellipsoid, west, 0.0).distanceRange(westward), range, tolerance(c)));
    }
}

template <class Make>
void expectACameraInsideToKeepTheBin(Random& random, const Make& make) {
    for (int trial = 0; trial < 50000; ++trial) {
        const core::Ellipsoid ellipsoid = randomEllipsoid(random);
        const core::GeodeticBin bin = randomBin(random);
        const glm::dvec3 eye = rounded(geodeticToEcef(ellipsoid, randomPosition(random, bin)));
        const glm::dvec3 normal = random.direction();
        ASSERT_EQ(make(ellipsoid, bin, 0.0).classify({normal, -glm::dot(normal, eye)}), core::Side::Straddling);
    }
}

}  // namespace osgAnalyticBin::test
