// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: finite differences of the long double mapping, convergence order of the model. The value itself is
// tested as Ellipsoid.ConvertsLikeLongDouble.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::Hessians;
using core::ParameterBox;

using RealStep = std::array<Real, 3>;

RealVector mapped(const Ellipsoid& ellipsoid, const glm::dvec3& at, const RealStep& step, Real t) {
    return geodeticToEcef(ellipsoid, at.x + t * step[0], at.y + t * step[1], at.z + t * step[2]);
}

// Fourth-order central differences of t -> f(at + t step) at t = 0.
RealVector firstDerivative(const Ellipsoid& e, const glm::dvec3& at, const RealStep& step, Real t) {
    const RealVector near = mapped(e, at, step, t) - mapped(e, at, step, -t);
    const RealVector far = mapped(e, at, step, 2 * t) - mapped(e, at, step, -2 * t);
    return (1 / (12 * t)) * (8 * near - far);
}

RealVector secondDerivative(const Ellipsoid& e, const glm::dvec3& at, const RealStep& step, Real t) {
    const RealVector middle = mapped(e, at, step, 0);
    const RealVector near = mapped(e, at, step, t) + mapped(e, at, step, -t) - 2 * middle;
    const RealVector far = mapped(e, at, step, 2 * t) + mapped(e, at, step, -2 * t) - 2 * middle;
    return (1 / (12 * t * t)) * (16 * near - far);
}

RealVector thirdDerivative(const Ellipsoid& e, const glm::dvec3& at, const RealStep& step, Real t) {
    const RealVector one = mapped(e, at, step, t) - mapped(e, at, step, -t);
    const RealVector two = mapped(e, at, step, 2 * t) - mapped(e, at, step, -2 * t);
    const RealVector three = mapped(e, at, step, 3 * t) - mapped(e, at, step, -3 * t);
    return (1 / (8 * t * t * t)) * (8 * two - 13 * one - three);
}

// u'Hu for a step u.
glm::dvec3 applied(const Hessians& h, const glm::dvec3& u) {
    return h.uu * (u.x * u.x) + h.vv * (u.y * u.y) + h.ww * (u.z * u.z) +
           2.0 * (h.uv * (u.x * u.y) + h.uw * (u.x * u.z) + h.vw * (u.y * u.z));
}

double gapBetween(const glm::dvec3& a, const RealVector& b) {
    return static_cast<double>(length(real(a) - b));
}

glm::dvec3 anyParameters(Random& random) {
    return {random.uniform(-kHalfPi, kHalfPi), random.uniform(-kPi, kPi),
            random.uniform(kAllAltitudes.lower, kAllAltitudes.upper)};
}

TEST(GeodeticMapping, JacobianIsTheFirstDerivative) {
    // t4/30 f5 is 2e-11 m at this step; rounding of long double divided by the step 1e-8 m; of double 1e-8 m.
    constexpr Real kStep = 1e-4L;
    constexpr double kTolerance = 5e-8;
    Random random(40);
    for (int trial = 0; trial < 5000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const GeodeticMapping mapping(ellipsoid);
        const glm::dvec3 at = anyParameters(random);
        const glm::dmat3 jacobian = mapping.jacobian(at);
        ASSERT_LE(gapBetween(jacobian[0], firstDerivative(ellipsoid, at, {1, 0, 0}, kStep)), kTolerance);
        ASSERT_LE(gapBetween(jacobian[1], firstDerivative(ellipsoid, at, {0, 1, 0}, kStep)), kTolerance);
        ASSERT_LE(gapBetween(jacobian[2] * 1e6, firstDerivative(ellipsoid, at, {0, 0, 1e6L}, kStep)), kTolerance);
        ASSERT_NEAR(glm::length(jacobian[2]), 1.0, 1e-15);
    }
}

TEST(GeodeticMapping, HessiansAreTheSecondDerivatives) {
    // Along random steps of up to a radian and 1000 km: all six at once, and each by itself.
    constexpr Real kStep = 1e-3L;
    constexpr double kTolerance = 2e-4;  // metres; the derivatives are about 1e7
    Random random(41);
    for (int trial = 0; trial < 5000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const glm::dvec3 at = anyParameters(random);
        const Hessians hessians = GeodeticMapping(ellipsoid).hessians(at);
        for (const glm::dvec3& u :
             {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1e6),
              glm::dvec3(1.0, 1.0, 0.0), glm::dvec3(1.0, 0.0, 1e6), glm::dvec3(0.0, 1.0, 1e6),
              glm::dvec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1e6, 1e6))}) {
            ASSERT_LE(gapBetween(applied(hessians, u), secondDerivative(ellipsoid, at, {u.x, u.y, u.z}, kStep)),
                      kTolerance);
        }
        ASSERT_EQ(hessians.ww, glm::dvec3(0.0));
    }
}

// The length of D3f(x)[e, e, e], by differences whose reach in angle is a hundredth of a radian.
double thirdDifferential(const Ellipsoid& ellipsoid, const glm::dvec3& at, const glm::dvec3& e) {
    const double angle = std::max({std::abs(e.x), std::abs(e.y), 1e-9});
    return static_cast<double>(length(thirdDerivative(ellipsoid, at, {e.x, e.y, e.z}, 0.01L / angle)));
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
