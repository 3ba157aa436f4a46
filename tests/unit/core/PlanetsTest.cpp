// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Ellipsoids from the Moon to Saturn, oblate and prolate extremes, and each of them in metres, in kilometres and with
// an equatorial radius of one: verdicts are as sound, and ranges nearly as tight, as on the earth. Planes and lines of
// sight come as close to a tie as doubles can say. Oracles: closed forms in long double.

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <support/GeodeticOracle.h>
#include <support/Planets.h>
#include <support/RandomBins.h>
#include <support/RandomViews.h>
#include <support/View.h>
#include <vector>

namespace osgAnalyticBin::test {

namespace {

using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::GeodeticBin;
using core::HorizonBin;
using core::HorizonEye;
using core::Interval;
using core::Plane;
using core::Side;

constexpr int kTrials = 2000;

class Planets : public ::testing::TestWithParam<Planet> {
protected:
    [[nodiscard]] std::array<double, 3> units() const { return GetParam().units(); }

    void setUnit(double unit) {
        ellipsoid = GetParam().in(unit);
        size = std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    }

    GeodeticBin randomBinHere() { return randomBinOn(ellipsoid, random); }

    // From a unit in the last place of the radius to the radius.
    double nearlyNothing() { return random.sign() * random.logUniform(1e-17, 1.0) * size; }

    Random random{1200};
    Ellipsoid ellipsoid{1.0, 1.0};
    double size = 1.0;
};

template <class Bin>
void expectSound(const Bin& bin, const Plane& plane, const RealRange& truth, Real rounding) {
    const Side side = bin.classify(plane);
    ASSERT_FALSE(side == Side::Outside && truth.upper >= rounding) << static_cast<double>(truth.upper);
    ASSERT_FALSE(side == Side::Inside && truth.lower < -rounding) << static_cast<double>(truth.lower);
    const Interval range = bin.distanceRange(plane);
    ASSERT_LE(range.lower, truth.lower + rounding);
    ASSERT_GE(range.upper, truth.upper - rounding);
}

TEST_P(Planets, HaveSoundAndTightVerdicts) {
    for (const double unit : units()) {
        setUnit(unit);
        for (int i = 0; i < kTrials; ++i) {
            const GeodeticBin bin = randomBinHere();
            ASSERT_TRUE(ExactGeodeticBin::holds(ellipsoid, bin));
            const ExactGeodeticBin exact(ellipsoid, bin);
            const core::QuadraticOrExact either = core::quadraticOrExact(ellipsoid, bin);
            const BinOracle oracle(ellipsoid, bin);
            const glm::dvec3 normal = random.direction();
            const RealRange range = oracle.range(normal);
            for (const Real touched : {range.lower, range.upper}) {
                const Plane plane{normal, nearlyNothing() - static_cast<double>(touched)};
                const RealRange truth = oracle.distanceRange(plane);
                expectSound(exact, plane, truth, oracle.rounding(plane));
                std::visit([&](const auto& form) { expectSound(form, plane, truth, oracle.rounding(plane)); }, either);
                const double room = 128.0 * 2.3e-16 * (exact.reach() + std::abs(plane.offset));
                EXPECT_LE(truth.lower - exact.distanceRange(plane).lower, room);
                if (HasFatalFailure()) return;
            }
        }
    }
}

TEST_P(Planets, PartNoBinFromAPointOfIt) {
    for (const double unit : units()) {
        setUnit(unit);
        int separated = 0;
        for (int i = 0; i < kTrials; ++i) {
            const GeodeticBin bin = randomBinHere();
            const ExactGeodeticBin exact(ellipsoid, bin);
            const RealVector point = geodeticToEcef(ellipsoid, randomPosition(random, bin));
            std::vector<Plane> planes(4);
            for (Plane& plane : planes) {
                plane.normal = random.direction();
                plane.offset = -glm::dot(plane.normal, rounded(point));
                while (exactDistance(plane, point) < 0) plane.offset += 4e-16 * size;
            }
            ASSERT_FALSE(core::isSeparated(exact, planes, planes.size(), 0xF, 4)) << "trial " << i;
            // away from the bin, so that something is there to be found
            for (Plane& plane : planes) plane.offset -= 0.05 * size;
            separated += core::isSeparated(exact, planes, planes.size(), 0xF, 4) ? 1 : 0;
        }
        EXPECT_GT(separated, kTrials / 10);
    }
}

// The last eye that sees the target, on a way from one that does to one that does not.
glm::dvec3 lastThatSees(const Ellipsoid& ellipsoid, double depth, const RealVector& target, glm::dvec3 seeing,
                        glm::dvec3 blind) {
    for (int step = 0; step < 60; ++step) {
        const glm::dvec3 middle = 0.5 * (seeing + blind);
        (segmentMissesOccluder(ellipsoid, depth, target, real(middle)) ? seeing : blind) = middle;
    }
    return seeing;
}

TEST_P(Planets, HideNoPointThatALineOfSightReaches) {
    for (const double unit : units()) {
        setUnit(unit);
        int tried = 0;
        int hidden = 0;
        for (int i = 0; i < kTrials; ++i) {
            const GeodeticBin bin = randomBinHere();
            const double depth = random.uniform(-0.001, 0.01) * std::min(size, ellipsoid.polarRadius());
            const RealVector target = geodeticToEcef(ellipsoid, randomPosition(random, bin));
            const glm::dvec3 top = rounded(target) * random.uniform(1.1, 5.0);
            const glm::dvec3 far = size * random.logUniform(1.2, 30.0) * random.direction();
            const HorizonBin prepared(ellipsoid, bin);
            const auto farEye = HorizonEye::fromEye(ellipsoid, depth, far);
            const bool isFarSeen = segmentMissesOccluder(ellipsoid, depth, target, real(far));
            hidden += farEye && farEye->hides(prepared) ? 1 : 0;
            ASSERT_FALSE(isFarSeen && farEye && farEye->hides(prepared)) << "trial " << i;
            if (isFarSeen || !segmentMissesOccluder(ellipsoid, depth, target, real(top))) continue;
            const glm::dvec3 last = lastThatSees(ellipsoid, depth, target, top, far);
            const auto eye = HorizonEye::fromEye(ellipsoid, depth, last);
            ++tried;
            ASSERT_FALSE(eye && eye->hides(prepared)) << "trial " << i;
        }
        EXPECT_GT(tried, kTrials / 8);
        EXPECT_GT(hidden, kTrials / 16);
    }
}

INSTANTIATE_TEST_SUITE_P(All, Planets, ::testing::ValuesIn(kPlanets),
                         [](const auto& planet) { return std::string(planet.param.name); });
INSTANTIATE_TEST_SUITE_P(Flat, Planets, ::testing::ValuesIn(kFlatPlanets),
                         [](const auto& planet) { return std::string(planet.param.name); });

}  // namespace
}  // namespace osgAnalyticBin::test
