// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle of remainders: finite differences of the long double mapping. The value itself is tested as
// Ellipsoid.ConvertsLikeLongDouble; first and second derivatives in mappings/, against those by automatic
// differentiation, and by what QuadraticBin makes of them.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::ParameterBox;

// The length of D3f(x)[e, e, e], by differences whose reach in angle is a hundredth of a radian.
double thirdDifferential(const Ellipsoid& ellipsoid, const glm::dvec3& at, const glm::dvec3& e) {
    const Real t = 0.01L / std::max({std::abs(e.x), std::abs(e.y), 1e-9});
    const auto along = [&](Real k) {
        return geodeticToEcef(ellipsoid, at.x + k * t * e.x, at.y + k * t * e.y, at.z + k * t * e.z) -
               geodeticToEcef(ellipsoid, at.x - k * t * e.x, at.y - k * t * e.y, at.z - k * t * e.z);
    };
    return static_cast<double>(length((1 / (8 * t * t * t)) * (8 * along(2) - 13 * along(1) - along(3))));
}

glm::dvec3 randomStep(Random& random, const glm::dvec3& halfSize) {
    const bool corner = random.chance(0.7);
    const auto factor = [&] { return corner ? random.sign() : random.uniform(-1.0, 1.0); };
    return {factor() * halfSize.x, factor() * halfSize.y, factor() * halfSize.z};
}

glm::dvec3 randomParameters(Random& random, const GeodeticBin& bin) {
    const core::Geodetic position = randomPosition(random, bin);
    return {position.latitude, position.longitude, position.altitude};
}

TEST(GeodeticMapping, RemainderHolds) {
    // The differences err by about 1e-7 of the differential, and by rounding: 1e-5 m at a reach of 0.01 radians,
    // scaled to the box.
    constexpr double kTruncation = 1e-6;
    Random random(42);
    for (int trial = 0; trial < 20000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const BinKind kind = random.pick(kBinKinds);
        const GeodeticBin bin = randomBin(random, kind);
        const ParameterBox box = core::parameterBox(bin);
        const double bound = 6.0 * GeodeticMapping(ellipsoid).remainder(box);
        const double reach = std::max(box.halfSize.x, box.halfSize.y) / 0.01;
        const double rounding = 1e-5 * reach * reach * reach + 1e-9;
        if (box.halfSize.z > 1e3 * 6e6 * std::max(box.halfSize.x, box.halfSize.y)) continue;  // towers: no differences
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 at = randomParameters(random, bin);
            const double actual = thirdDifferential(ellipsoid, at, randomStep(random, box.halfSize));
            ASSERT_LE(actual, bound * (1.0 + kTruncation) + rounding) << nameOf(kind);
        }
    }
}

// A box a nanoradian from the pole: its cosine of latitude must not drown in 1 - sin2.
TEST(GeodeticMapping, RemainderHoldsBesideTheAxis) {
    const Ellipsoid earth = wgs84();
    for (const double distance : {1e-3, 1e-6, 1e-7, 1e-8, 3e-9, 1e-9, 1e-12}) {
        const GeodeticBin bin({kHalfPi - distance, kHalfPi}, {0.0, kPi}, {0.0, 0.0});
        const ParameterBox box = core::parameterBox(bin);
        const double eastward = std::pow(box.halfSize.y, 3) * 6.3e6 * distance;  // f_lll at the southern edge
        EXPECT_GE(6.0 * GeodeticMapping(earth).remainder(box), 0.99 * eastward) << distance;
    }
}

TEST(GeodeticMapping, RemainderIsTight) {
    // The bound adds the largest of each term; the truth is at one place, for one step.
    constexpr double kLooseness = 2.0;
    Random random(43);
    double worst = 0.0;
    for (int trial = 0; trial < 400; ++trial) {
        const Ellipsoid ellipsoid = wgs84();
        const GeodeticBin bin = randomTile(random, random.integer(0, 6), {-500.0, 9000.0});
        const ParameterBox box = core::parameterBox(bin);
        double largest = 0.0;
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 at = randomParameters(random, bin);
            largest = std::max(largest, thirdDifferential(ellipsoid, at, randomStep(random, box.halfSize)));
        }
        worst = std::max(worst, 6.0 * GeodeticMapping(ellipsoid).remainder(box) / largest);
    }
    std::printf("six remainders / largest third differential found: at most %.2f\n", worst);
    EXPECT_LE(worst, kLooseness);
}

TEST(GeodeticMapping, ParameterBoxHoldsTheBin) {
    Random random(46);
    for (int trial = 0; trial < 100000; ++trial) {
        const GeodeticBin bin = randomBin(random);
        const ParameterBox box = core::parameterBox(bin);
        const std::array<core::Interval, 3> intervals{bin.latitude(), bin.longitude(), bin.altitude()};
        for (int i = 0; i < 3; ++i) {
            const core::Interval& interval = intervals[static_cast<std::size_t>(i)];
            ASSERT_LE(static_cast<Real>(box.center[i]) - box.halfSize[i], interval.lower);
            ASSERT_GE(static_cast<Real>(box.center[i]) + box.halfSize[i], interval.upper);
            ASSERT_LE(box.halfSize[i], 0.5 * interval.width() * (1.0 + 1e-12) + 1e-15 * std::abs(interval.upper));
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
