// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: see support/MappingChecks.h; the interval bound of the same formula.

#include "TorusSegment.h"

#include <osgAnalyticBin/mappings/AutodiffMapping.h>
#include <osgAnalyticBin/mappings/CylinderSegment.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <support/MappingChecks.h>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using assembly::TorusSegment;
using core::AutodiffMapping;
using core::Frame;
using core::frameAboutAxis;
using core::ParameterBox;

// The formula alone, without the bound it brings.
struct UnboundedTorus {
    TorusSegment torus;
    template <class T>
    core::Vec3<T> operator()(T u, T v, T w) const {
        return torus(u, v, w);
    }
};

TorusSegment randomTorus(Random& random, double farthest) {
    const Frame frame =
        frameAboutAxis(random.direction() * random.uniform(0.0, farthest), random.direction(), random.direction());
    return {frame, random.logUniform(0.5, 50.0)};
}

// A piece of a bend, up to an eighth of a turn both ways from its middle.
ParameterBox randomTorusWall(Random& random) {
    const double radius = random.logUniform(0.05, 0.5);
    return {{random.uniform(-kPi, kPi), random.uniform(-kPi, kPi), radius},
            {random.uniform(0.02, 0.25 * kPi), random.uniform(0.02, 0.25 * kPi), radius * random.uniform(0.0, 0.3)}};
}

TEST(TorusSegment, DerivativesMatchDifferences) {
    Random random(330);
    for (int trial = 0; trial < 200; ++trial) {
        expectDerivativesMatchDifferences(AutodiffMapping(randomTorus(random, 1e5)), randomTorusWall(random), random);
    }
}

TEST(TorusSegment, RemainderHoldsAndIsTight) {
    Random random(331);
    double worst = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
        worst =
            std::max(worst, expectRemainderHolds(AutodiffMapping(randomTorus(random, 10.0)), randomTorusWall(random)));
    }
    std::printf("remainder at most %.2f times the model's error\n", worst);
    EXPECT_LE(worst, 3.0);
}

TEST(TorusSegment, IntervalBoundOfTheSameFormulaAgrees) {
    Random random(332);
    double tightest = 1e9;
    double loosest = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
        const TorusSegment torus = randomTorus(random, 10.0);
        const ParameterBox box = randomTorusWall(random);
        const AutodiffMapping<UnboundedTorus> mapping({torus});
        const double ratio = mapping.remainder(box) / torus.remainder(box);
        expectRemainderHolds(mapping, box);
        tightest = std::min(tightest, ratio);
        loosest = std::max(loosest, ratio);
    }
    std::printf("interval bound %.2f .. %.2f of the bound by hand\n", tightest, loosest);
    EXPECT_LE(loosest, 3.0);
}

TEST(TorusSegment, NeverContradictsASample) {
    Random random(333);
    for (int trial = 0; trial < 200; ++trial) {
        expectNoContradiction(AutodiffMapping(randomTorus(random, 1e5)), randomTorusWall(random), random);
    }
}

TEST(TorusSegment, ErrorFallsEightfoldPerHalving) {
    expectErrorFallsEightfold(AutodiffMapping(TorusSegment(Frame(), 2.0)), {{0.4, 0.7, 0.3}, {0.3, 0.3, 0.05}}, 5);
}

}  // namespace
}  // namespace osgAnalyticBin::test
