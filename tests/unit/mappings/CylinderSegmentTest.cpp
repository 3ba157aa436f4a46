// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: see support/MappingChecks.h; the largest third differential in closed form.

#include <osgAnalyticBin/mappings/AutodiffMapping.h>
#include <osgAnalyticBin/mappings/CylinderSegment.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <support/MappingChecks.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::AutodiffMapping;
using core::CylinderSegment;
using core::Frame;
using core::frameAboutAxis;
using core::ParameterBox;

Frame randomFrame(Random& random) {
    return frameAboutAxis(random.direction() * random.logUniform(0.1, 1e6), random.direction(), random.direction());
}

// A piece of a pipe's wall, up to half a turn.
ParameterBox randomWall(Random& random) {
    const double radius = random.logUniform(0.01, 100.0);
    return {{random.uniform(-kPi, kPi), radius, random.uniform(-10.0, 10.0)},
            {random.logUniform(1e-3, kHalfPi), radius * random.uniform(0.0, 0.5), random.logUniform(1e-3, 100.0)}};
}

TEST(CylinderSegment, DerivativesMatchDifferences) {
    Random random(320);
    for (int trial = 0; trial < 200; ++trial) {
        expectDerivativesMatchDifferences(AutodiffMapping(CylinderSegment(randomFrame(random))), randomWall(random),
                                          random);
    }
}

TEST(CylinderSegment, RemainderHoldsAndIsTight) {
    Random random(321);
    double worst = 0.0;
    for (int trial = 0; trial < 100; ++trial) {
        const Frame frame = frameAboutAxis(random.direction(), random.direction(), random.direction());
        ParameterBox wall = randomWall(random);
        wall.halfSize.x = random.uniform(0.05, 0.8);
        worst = std::max(worst, expectRemainderHolds(AutodiffMapping(CylinderSegment(frame)), wall));
    }
    std::printf("remainder at most %.2f times the model's error\n", worst);
    EXPECT_LE(worst, 1.25);
}

TEST(CylinderSegment, FarFromTheOriginTheRemainderHoldsToo) {
    Random random(322);
    for (int trial = 0; trial < 100; ++trial) {
        expectRemainderHolds(AutodiffMapping(CylinderSegment(randomFrame(random))), randomWall(random));
    }
}

TEST(CylinderSegment, NeverContradictsASample) {
    Random random(323);
    for (int trial = 0; trial < 200; ++trial) {
        expectNoContradiction(AutodiffMapping(CylinderSegment(randomFrame(random))), randomWall(random), random);
    }
}

TEST(CylinderSegment, ErrorFallsEightfoldPerHalving) {
    expectErrorFallsEightfold(AutodiffMapping(CylinderSegment(Frame())), {{0.4, 2.0, 1.0}, {0.5, 0.3, 4.0}}, 5);
}

}  // namespace
}  // namespace osgAnalyticBin::test
