// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What must hold for any test of whether a bin is behind the horizon. `hides(eye, bin)` is that test, of a
// core::HorizonBin.

#pragma once

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <support/RandomBins.h>
#include <support/RandomViews.h>
#include <support/View.h>

namespace osgAnalyticBin::test {

template <class Hides>
void expectNoVisiblePointToBeHidden(Random& random, const Hides& hides) {
    int hidden = 0;
    for (int trial = 0; trial < 60000; ++trial) {
        const core::Ellipsoid ellipsoid = randomEllipsoid(random);
        const core::GeodeticBin bin = randomBin(random);
        const double depth = randomDepth(random);
        const glm::dvec3 eye = randomEye(random, ellipsoid, depth);
        const auto prepared = core::HorizonEye::fromEye(ellipsoid, depth, eye);
        if (!prepared || !hides(*prepared, core::HorizonBin(ellipsoid, bin))) continue;
        ++hidden;
        for (int i = 0; i < 40; ++i) {
            const RealVector point = geodeticToEcef(ellipsoid, randomPosition(random, bin));
            ASSERT_FALSE(segmentMissesOccluder(ellipsoid, depth, point, real(eye))) << "trial " << trial;
        }
    }
    EXPECT_GT(hidden, 10000) << "nothing is tested";
}

template <class Hides>
void expectLinesOfSightThatJustMissToBeSeen(Random& random, const Hides& hides) {
    int seen = 0;
    for (int trial = 0; trial < 300000; ++trial) {
        const LineOfSight line = randomLineOfSight(random);
        if (!segmentMissesOccluder(line.ellipsoid, line.depth, line.target, real(line.eye))) continue;
        ++seen;
        const auto prepared = core::HorizonEye::fromEye(line.ellipsoid, line.depth, line.eye);
        if (!prepared) continue;
        ASSERT_FALSE(hides(*prepared, core::HorizonBin(line.ellipsoid, line.bin, line.margin))) << "trial " << trial;
    }
    EXPECT_GT(seen, 100000) << "nothing is tested";
}

template <class Hides>
void expectParallelRaysThatJustMissToBeSeen(Random& random, const Hides& hides) {
    int seen = 0;
    int active = 0;
    for (int trial = 0; trial < 200000; ++trial) {
        const LineOfSight line = randomLineOfSight(random);
        const glm::dvec3 direction = glm::normalize(rounded(line.target) - line.eye);
        if (!halfLineMissesOccluder(line.ellipsoid, line.depth, line.target, real(-direction))) continue;
        ++seen;
        const glm::dvec3 nearPoint = line.eye - 4e7 * direction;
        const auto prepared = core::HorizonEye::fromDirection(line.ellipsoid, line.depth, direction, nearPoint);
        if (!prepared) continue;
        ++active;
        ASSERT_FALSE(hides(*prepared, core::HorizonBin(line.ellipsoid, line.bin, line.margin))) << "trial " << trial;
    }
    EXPECT_GT(seen, 50000);
    EXPECT_GT(active, 50000);
}

}  // namespace osgAnalyticBin::test
