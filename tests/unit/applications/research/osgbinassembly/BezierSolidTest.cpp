// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: see support/MappingChecks.h; the interval bound of the same formula; the B-spline by its recursive basis
// functions.

#include "BsplineSolid.h"

#include <osgAnalyticBin/mappings/AutodiffMapping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <support/MappingChecks.h>

namespace osgAnalyticBin::test {
namespace {

using assembly::BezierSolid;
using assembly::ControlNet;
using core::AutodiffMapping;
using core::ParameterBox;

// A panel: a plane grid of points, moved by up to `roughness` of the grid's step.
ControlNet randomNet(Random& random, std::size_t degreeU, std::size_t degreeV, const glm::dvec3& origin,
                     double roughness) {
    ControlNet net{degreeU, degreeV, {}};
    for (std::size_t i = 0; i <= degreeU; ++i) {
        for (std::size_t j = 0; j <= degreeV; ++j) {
            net.points.push_back(origin + glm::dvec3(static_cast<double>(i), static_cast<double>(j), 0.0) +
                                 random.direction() * random.uniform(0.0, roughness));
        }
    }
    return net;
}

BezierSolid randomSolid(Random& random, double farthest, double roughness = 0.6) {
    const auto degreeU = static_cast<std::size_t>(random.integer(1, 5));
    const auto degreeV = static_cast<std::size_t>(random.integer(1, 5));
    const glm::dvec3 origin = random.direction() * farthest;
    const ControlNet inner = randomNet(random, degreeU, degreeV, origin, roughness);
    ControlNet outer = inner;
    for (glm::dvec3& p : outer.points) p += glm::dvec3(0.0, 0.0, 0.2) + random.direction() * 0.05;
    return {inner, outer};
}

ParameterBox randomPart(Random& random) {
    ParameterBox box;
    for (glm::length_t i = 0; i < 3; ++i) {
        const double lower = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.9);
        const double upper = random.chance(0.3) ? 1.0 : random.uniform(lower, 1.0);
        box.center[i] = 0.5 * (lower + upper);
        box.halfSize[i] = 0.5 * (upper - lower);
    }
    return box;
}

constexpr double kHalf = 0.5;
const ParameterBox kWhole{glm::dvec3(kHalf), glm::dvec3(kHalf)};

struct Unbounded {
    BezierSolid solid;
    template <class T>
    core::Vec3<T> operator()(T u, T v, T w) const {
        return solid(u, v, w);
    }
};

TEST(BezierSolid, DerivativesMatchDifferences) {
    Random random(340);
    for (int trial = 0; trial < 60; ++trial) {
        expectDerivativesMatchDifferences(AutodiffMapping(randomSolid(random, 10.0)), randomPart(random), random);
    }
}

// The loosest remainder of whole bicubic patches. Other degrees may have no third derivative, and no ratio.
double loosestRemainder(Random& random, double roughness) {
    double loosest = 0.0;
    for (int trial = 0; trial < 60; ++trial) {
        const double bend = random.uniform(0.1, 0.3);
        ControlNet inner = randomNet(random, 3, 3, random.direction(), roughness);
        for (glm::dvec3& p : inner.points) p.z += bend * (p.x * p.x - p.x * p.y) * (1.0 + 0.3 * p.y);
        ControlNet outer = inner;
        for (glm::dvec3& p : outer.points) p += glm::dvec3(0.02 * p.x, 0.0, 0.2);
        loosest = std::max(loosest, expectRemainderHolds(AutodiffMapping(BezierSolid(inner, outer)), kWhole));
    }
    std::printf("roughness %.2f: remainder at most %.2f times the model's error\n", roughness, loosest);
    return loosest;
}

TEST(BezierSolid, RemainderHoldsAndIsTight) {
    Random random(341);
    EXPECT_LE(loosestRemainder(random, 0.02), 2.5);
    EXPECT_LE(loosestRemainder(random, 0.6), 25.0);
}

TEST(BezierSolid, RemainderHoldsOnEveryPart) {
    Random random(342);
    for (int trial = 0; trial < 60; ++trial) {
        expectRemainderHolds(AutodiffMapping(randomSolid(random, 1e5)), randomPart(random));
    }
}

TEST(BezierSolid, ConvexHullBoundIsTighterThanIntervals) {
    Random random(343);
    for (int trial = 0; trial < 20; ++trial) {
        const BezierSolid solid = randomSolid(random, 1.0);
        const AutodiffMapping<Unbounded> intervals({solid}, 1);
        expectRemainderHolds(intervals, kWhole);
        EXPECT_LE(solid.remainder(kWhole), intervals.remainder(kWhole) + 1e-9);
    }
}

TEST(BezierSolid, MeshesStayWithinTheSag) {
    Random random(348);
    double largest = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
        largest =
            std::max(largest, expectSagHolds(AutodiffMapping(randomSolid(random, 10.0)), randomPart(random), random));
    }
    EXPECT_GE(largest, 0.3);
}

TEST(BezierSolid, NeverContradictsASample) {
    Random random(344);
    for (int trial = 0; trial < 60; ++trial) {
        expectNoContradiction(AutodiffMapping(randomSolid(random, 1e4)), randomPart(random), random);
    }
}

TEST(BezierSolid, ErrorFallsEightfoldPerHalving) {
    Random random(345);
    const ControlNet inner = randomNet(random, 3, 3, glm::dvec3(0.0), 0.6);
    const ControlNet outer = randomNet(random, 3, 3, glm::dvec3(0.0, 0.0, 0.3), 0.6);
    expectErrorFallsEightfold(AutodiffMapping(BezierSolid(inner, outer)), {{0.5, 0.5, 0.5}, {0.1, 0.1, 0.1}}, 4);
}

TEST(BezierSolid, OutsideOfTheUnitCubeThereIsNoBound) {
    Random random(346);
    const BezierSolid solid = randomSolid(random, 1.0);
    EXPECT_TRUE(std::isinf(solid.remainder({{0.5, 0.5, 0.5}, {0.6, 0.5, 0.5}})));
    EXPECT_TRUE(std::isinf(solid.remainder({{0.5, 0.5, std::nan("")}, {0.5, 0.5, 0.5}})));
    EXPECT_TRUE(std::isfinite(solid.remainder(kWhole)));
}

// The basis function of a point, by its definition.
double basis(const Knots& knots, std::size_t i, std::size_t degree, double t) {
    if (degree == 0) return knots[i] <= t && t < knots[i + 1] ? 1.0 : 0.0;
    const auto part = [](double value, double width) { return width > 0.0 ? value / width : 0.0; };
    return part(t - knots[i], knots[i + degree] - knots[i]) * basis(knots, i, degree - 1, t) +
           part(knots[i + degree + 1] - t, knots[i + degree + 1] - knots[i + 1]) * basis(knots, i + 1, degree - 1, t);
}

glm::dvec3 splinePoint(const ControlNet& net, const Knots& ku, const Knots& kv, double u, double v) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i <= net.degreeU; ++i) {
        for (std::size_t j = 0; j <= net.degreeV; ++j) {
            sum += net.at(i, j) *
                   (basis(ku, i, ku.size() - net.degreeU - 2, u) * basis(kv, j, kv.size() - net.degreeV - 2, v));
        }
    }
    return sum;
}

TEST(BsplineSolid, SpansAreTheSameSurfaceAsTheSpline) {
    Random random(347);
    const Knots ku{0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 2.5, 4.0, 4.0, 4.0, 4.0};  // cubic, one double knot
    const Knots kv{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0};                      // quadratic, not clamped
    const ControlNet inner = randomNet(random, 6, 3, glm::dvec3(0.0), 0.4);
    const ControlNet outer = randomNet(random, 6, 3, glm::dvec3(0.0, 0.0, 0.5), 0.4);
    const std::vector<BezierSolid> solids = bezierSolids(inner, outer, ku, kv);
    const std::vector<std::pair<double, double>> spansU{{0.0, 1.0}, {1.0, 2.5}, {2.5, 4.0}};
    const std::vector<std::pair<double, double>> spansV{{2.0, 3.0}, {3.0, 4.0}};
    ASSERT_EQ(solids.size(), spansU.size() * spansV.size());
    for (int trial = 0; trial < 2000; ++trial) {
        const auto i = static_cast<std::size_t>(random.integer(0, 2));
        const auto j = static_cast<std::size_t>(random.integer(0, 1));
        const double s = random.uniform();
        const double t = random.uniform();
        const double u = spansU[i].first + s * (spansU[i].second - spansU[i].first);
        const double v = spansV[j].first + t * (spansV[j].second - spansV[j].first);
        const core::Vec3<double> bottom = solids[i * 2 + j](s, t, 0.0);
        const core::Vec3<double> top = solids[i * 2 + j](s, t, 1.0);
        ASSERT_LE(glm::distance(glm::dvec3(bottom.x, bottom.y, bottom.z), splinePoint(inner, ku, kv, u, v)), 1e-13);
        ASSERT_LE(glm::distance(glm::dvec3(top.x, top.y, top.z), splinePoint(outer, ku, kv, u, v)), 1e-13);
    }
    for (const BezierSolid& solid : solids) expectNoContradiction(AutodiffMapping(solid), kWhole, random);
}

}  // namespace
}  // namespace osgAnalyticBin::test
