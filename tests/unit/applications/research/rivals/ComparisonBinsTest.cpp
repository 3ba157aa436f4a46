// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The two published rules are implemented as published. Oracle: the rules written down a second time. Soundness.cpp and
// osgbinpaper.Experiment.CornersAndThePublishedRuleCullWhatIsSeenAndTheWorstCullIsAProof show that the rules are wrong.

#include "ComparisonBins.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {
namespace {

using core::GeodeticMapping;
using core::Interval;
using core::ParameterBox;
using core::Plane;
using core::Quadratic;
using core::QuadraticBin;
using core::Side;
using rivals::CornersBin;
using rivals::PaperBin;

constexpr double kTie = 1e-6;  // metres from a plane within which a verdict may go either way

Side sideOf(const Interval& range) {
    if (range.upper < 0.0) return Side::Outside;
    return range.lower >= 0.0 ? Side::Inside : Side::Straddling;
}

// The nine-point rule, its linear system solved by Cramer's rule in long double.
Interval ninePointRange(const Quadratic& q) {
    Interval range{q(1.0, 1.0, 1.0), q(1.0, 1.0, 1.0)};
    const auto take = [&](double u, double v, double w) {
        range = {std::min(range.lower, q(u, v, w)), std::max(range.upper, q(u, v, w))};
    };
    for (int corner = 0; corner < 8; ++corner)
        take(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const auto& h = q.hessian;
    const RealVector columns[] = {{h[0], h[3], h[4]}, {h[3], h[1], h[5]}, {h[4], h[5], h[2]}};
    const RealVector right = Real{-1} * RealVector{q.gradient[0], q.gradient[1], q.gradient[2]};
    const Real determinant = dot(columns[0], cross(columns[1], columns[2]));
    if (determinant == 0) return range;
    const double u = static_cast<double>(dot(right, cross(columns[1], columns[2])) / determinant);
    const double v = static_cast<double>(dot(columns[0], cross(right, columns[2])) / determinant);
    const double w = static_cast<double>(dot(columns[0], cross(columns[1], right)) / determinant);
    if (std::abs(u) <= 1.0 && std::abs(v) <= 1.0 && std::abs(w) <= 1.0) take(u, v, w);
    return range;
}

Interval ninePointRange(const ParameterBox& box, double growth, const Plane& plane) {
    return ninePointRange(
        QuadraticBin(GeodeticMapping(wgs84()), {box.center, box.halfSize * growth}).distanceModel(plane));
}

Interval cornerRange(const core::GeodeticBin& bin, const Plane& plane) {
    Interval range{1e300, -1e300};
    const auto end = [](const Interval& of, int bit) { return bit ? of.upper : of.lower; };
    for (int corner = 0; corner < 8; ++corner) {
        const RealVector point = geodeticToEcef(wgs84(), end(bin.latitude(), corner & 1),
                                                end(bin.longitude(), corner & 2), end(bin.altitude(), corner & 4));
        const auto distance = static_cast<double>(exactDistance(plane, point));
        range = {std::min(range.lower, distance), std::max(range.upper, distance)};
    }
    return range;
}

// The bin's verdicts on random tiles and planes are those of ranges that are computed once more, but for ties.
template <class Check>
void forRandomPlanes(std::uint64_t stream, const Check& check) {
    Random random(stream);
    int decided = 0;
    for (int trial = 0; trial < 50000 && !testing::Test::HasFailure(); ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, random.integer(0, 8), randomAltitude(random)));
        const Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const auto [range, side] = check(random, oracle.bin(), plane);
        if (std::min(std::abs(range.lower), std::abs(range.upper)) < kTie) continue;
        ++decided;
        EXPECT_EQ(side, sideOf(range));
    }
    EXPECT_GT(decided, 40000);
}

TEST(PaperBin, IsTheNinePointRuleOnTheGrownBox) {
    forRandomPlanes(80, [](Random& random, const core::GeodeticBin& bin, const Plane& plane) {
        const ParameterBox box = core::parameterBox(bin);
        const double growth = random.chance(0.5) ? PaperBin::kDefaultGrowth : random.uniform(1.0, 1.5);
        return std::pair(ninePointRange(box, growth, plane),
                         PaperBin(GeodeticMapping(wgs84()), box, growth).classify(plane));
    });
    EXPECT_EQ(PaperBin::kDefaultGrowth, 1.1);
}

TEST(CornersBin, IsTheRuleOfTheEightCorners) {
    forRandomPlanes(81, [](Random&, const core::GeodeticBin& bin, const Plane& plane) {
        return std::pair(cornerRange(bin, plane),
                         CornersBin(GeodeticMapping(wgs84()), core::parameterBox(bin)).classify(plane));
    });
}

struct Misses {
    int count = 0;
    double largest = 0.0;

    void note(double missedBy) {
        if (missedBy <= kTie) return;
        ++count;
        largest = std::max(largest, missedBy);
    }
};

// How often, and by how much, a rule's maximum stays below the true one over random directions.
struct MissTable {
    Misses ninePoints, grown, corners;
};

MissTable missesAt(Random& random, int level, int trials) {
    MissTable misses;
    for (int trial = 0; trial < trials; ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, level, kTerrainAltitudes));
        const ParameterBox box = core::parameterBox(oracle.bin());
        const Plane plane{random.direction(), 0.0};
        const double truth = static_cast<double>(oracle.range(plane.normal).upper);
        misses.ninePoints.note(truth - ninePointRange(box, 1.0, plane).upper);
        misses.grown.note(truth - ninePointRange(box, PaperBin::kDefaultGrowth, plane).upper);
        misses.corners.note(truth - cornerRange(oracle.bin(), plane).upper);
    }
    return misses;
}

// The maximum of the model itself over the box, without what the model leaves out.
Misses modelMissesAt(Random& random, int level, int trials) {
    Misses misses;
    for (int trial = 0; trial < trials; ++trial) {
        const ParameterBox box = core::parameterBox(randomTile(random, level, kTerrainAltitudes));
        const Quadratic q = QuadraticBin(GeodeticMapping(wgs84()), box).distanceModel({random.direction(), 0.0});
        misses.note(core::exactRange(q).upper - ninePointRange(q).upper);
    }
    return misses;
}

TEST(PaperBin, MissesTheMaximumThisOften) {
    constexpr int kTrials = 100000;
    Random random(82);
    const auto percent = [](const Misses& m) { return 100.0 * m.count / kTrials; };
    std::printf("true maximum missed, %d random directions a level, altitudes %.0f .. %.0f m\n", kTrials,
                kTerrainAltitudes.lower, kTerrainAltitudes.upper);
    std::printf("  tile deg | model's maximum, 9 points | 9 points vs truth  | grown by 1.1       | 8 corners\n");
    for (int level = 0; level <= 4; ++level) {
        const Misses model = modelMissesAt(random, level, kTrials);
        const MissTable m = missesAt(random, level, kTrials);
        std::printf("  %8.4f | %6.2f %%  %10.1f m     | %6.2f %% %9.1f m | %6.2f %% %9.1f m | %6.2f %% %9.1f m\n",
                    std::ldexp(kRootTileDeg, -level), percent(model), model.largest, percent(m.ninePoints),
                    m.ninePoints.largest, percent(m.grown), m.grown.largest, percent(m.corners), m.corners.largest);
        if (level == 0) {
            EXPECT_GT(percent(model), 4.0);
            EXPECT_GT(percent(m.grown), 2.0);
            EXPECT_GT(m.grown.largest, 100e3);
            EXPECT_GT(percent(m.corners), 4.0);
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
