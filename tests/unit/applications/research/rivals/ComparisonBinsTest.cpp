// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The two published rules must be what they claim to be. Oracle: the rules written down a second time. That they are
// wrong: Soundness.cpp, and osgbinpaper.ExperimentTest.CornersAndThePublishedRuleCullWhatIsSeen.

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

bool isTie(const Interval& range) {
    return std::min(std::abs(range.lower), std::abs(range.upper)) < kTie;
}

// The nine-point rule, its linear system solved by elimination in long double.
Interval ninePointRange(const Quadratic& q) {
    Interval range{q.value, q.value};
    bool first = true;
    const auto take = [&](double u, double v, double w) {
        const double value = q(u, v, w);
        range = first ? Interval{value, value} : Interval{std::min(range.lower, value), std::max(range.upper, value)};
        first = false;
    };
    for (const double u : {-1.0, 1.0}) {
        for (const double v : {-1.0, 1.0}) {
            for (const double w : {-1.0, 1.0}) take(u, v, w);
        }
    }
    const auto& h = q.hessian;
    Real rows[3][4] = {{h[0], h[3], h[4], -static_cast<Real>(q.gradient[0])},
                       {h[3], h[1], h[5], -static_cast<Real>(q.gradient[1])},
                       {h[4], h[5], h[2], -static_cast<Real>(q.gradient[2])}};
    for (int c = 0; c < 3; ++c) {
        int pivot = c;
        for (int r = c + 1; r < 3; ++r) {
            if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
        }
        if (rows[pivot][c] == 0) return range;
        std::swap(rows[c], rows[pivot]);
        for (int r = 0; r < 3; ++r) {
            if (r == c) continue;
            const Real factor = rows[r][c] / rows[c][c];
            for (int k = c; k < 4; ++k) rows[r][k] -= factor * rows[c][k];
        }
    }
    const auto coordinate = [&](int i) { return static_cast<double>(rows[i][3] / rows[i][i]); };
    if (std::abs(coordinate(0)) <= 1.0 && std::abs(coordinate(1)) <= 1.0 && std::abs(coordinate(2)) <= 1.0) {
        take(coordinate(0), coordinate(1), coordinate(2));
    }
    return range;
}

Interval ninePointRange(const ParameterBox& box, double growth, const Plane& plane) {
    return ninePointRange(
        QuadraticBin(GeodeticMapping(wgs84()), {box.center, box.halfSize * growth}).distanceModel(plane));
}

Interval cornerRange(const core::GeodeticBin& bin, const Plane& plane) {
    Interval range{1e300, -1e300};
    for (const double latitude : {bin.latitude().lower, bin.latitude().upper}) {
        for (const double longitude : {bin.longitude().lower, bin.longitude().upper}) {
            for (const double altitude : {bin.altitude().lower, bin.altitude().upper}) {
                const auto distance =
                    static_cast<double>(exactDistance(plane, geodeticToEcef(wgs84(), latitude, longitude, altitude)));
                range = {std::min(range.lower, distance), std::max(range.upper, distance)};
            }
        }
    }
    return range;
}

TEST(PaperBin, IsTheNinePointRuleOnTheGrownBox) {
    Random random(80);
    int decided = 0;
    for (int trial = 0; trial < 50000; ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, random.integer(0, 8), randomAltitude(random)));
        const ParameterBox box = core::parameterBox(oracle.bin());
        const Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const double growth = random.chance(0.5) ? PaperBin::kDefaultGrowth : random.uniform(1.0, 1.5);
        const Interval range = ninePointRange(box, growth, plane);
        if (isTie(range)) continue;
        ++decided;
        ASSERT_EQ(PaperBin(GeodeticMapping(wgs84()), box, growth).classify(plane), sideOf(range));
    }
    EXPECT_GT(decided, 40000);
    EXPECT_EQ(PaperBin::kDefaultGrowth, 1.1);
}

TEST(CornersBin, IsTheRuleOfTheEightCorners) {
    Random random(81);
    for (int trial = 0; trial < 50000; ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, random.integer(0, 8), randomAltitude(random)));
        const Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const Interval range = cornerRange(oracle.bin(), plane);
        if (isTie(range)) continue;
        ASSERT_EQ(CornersBin(GeodeticMapping(wgs84()), core::parameterBox(oracle.bin())).classify(plane),
                  sideOf(range));
    }
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
