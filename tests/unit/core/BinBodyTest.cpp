// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle: the interpolated point of the eight corners, which is in their hull, beside the point in long double.

#include "CoreTest.h"

#include <osgAnalyticBin/core/occlusion/BinBody.h>

namespace osgAnalyticBin::test {
namespace {

TEST(BinBody, IsInTheHullsOfItsQuarters) {
    Random random(1711);
    double closest = 1e300;
    for (int trial = 0; trial < 20000; ++trial) {
        const double radius = random.logUniform(1.0, 1e9);
        const Ellipsoid ellipsoid(radius, radius * random.uniform(0.996, 1.004));
        const double size = random.logUniform(1e-7, 1.5), wider = random.logUniform(1e-7, 3.0);
        const double south = random.uniform(-1.57, 1.57 - size), west = random.uniform(-4.0, 4.0);
        const double low = radius * random.uniform(-0.1, 0.1);
        const GeodeticBin bin({south, south + size}, {west, west + wider},
                              {low, low + radius * random.logUniform(1e-6, 0.1)});
        core::Frame frame{radius * random.uniform(0.0, 1.1) * random.direction(), random.direction(), {}, {}};
        frame.y = glm::normalize(glm::cross(frame.x, random.direction()));
        frame.z = glm::cross(frame.x, frame.y);
        const int quarter = random.integer(0, 3);
        BinHull hull = core::BinBody(ellipsoid, bin, 0.0, frame).quarters()[static_cast<std::size_t>(quarter)];
        const double top = random.chance(0.5) ? 1.0 : random.uniform();
        hull.lowerTop(low + top * bin.altitude().width(), bin.altitude());
        // at the middle the interpolation is worst
        const auto share = [&] { return random.chance(0.5) ? 0.5 : random.uniform(); };
        const double p = share(), l = share(), h = random.uniform();
        const glm::dvec3 point =
            ellipsoid.toEcef({south + 0.5 * (quarter / 2 + p) * size, west + 0.5 * (quarter % 2 + l) * wider,
                              low + h * top * bin.altitude().width()});
        glm::dvec3 inHull(0.0);
        for (std::size_t i = 0; i < 8; ++i) {
            inHull += (i % 2 != 0 ? l : 1.0 - l) * (i / 2 % 2 != 0 ? p : 1.0 - p) * (i / 4 != 0 ? h : 1.0 - h) *
                      hull.corner(i);
        }
        ASSERT_LE(glm::distance(point, frame.toOuter(inHull)), hull.reach);
        if (p == 0.5 && l == 0.5 && size > 1e-3)
            closest = std::min(closest, hull.reach / glm::distance(point, frame.toOuter(inHull)));
    }
    EXPECT_LT(closest, 1.1);
}

TEST(BinBody, IsInItsBall) {
    Random random(1712);
    for (int trial = 0; trial < 100000; ++trial) {
        const bool isMap = random.chance(0.2);
        const double radius = random.logUniform(1.0, 1e9);
        const Ellipsoid ellipsoid =
            isMap ? Ellipsoid::plane() : Ellipsoid(radius, radius * random.uniform(0.996, 1.004));
        const double size = random.logUniform(1e-7, 3.0), wider = random.logUniform(1e-7, 6.2);
        const double south = random.uniform(-1.57, 1.57 - size), west = random.uniform(-4.0, 4.0);
        const double low = radius * random.uniform(-0.1, 0.1), margin = radius * random.logUniform(1e-9, 1e-2);
        const GeodeticBin bin({south, south + size}, {west, west + wider},
                              {low, low + radius * random.logUniform(1e-6, 0.1)});
        core::Frame frame{radius * random.uniform(0.0, 1.1) * random.direction(), random.direction(), {}, {}};
        frame.y = glm::normalize(glm::cross(frame.x, random.direction()));
        frame.z = glm::cross(frame.x, frame.y);
        const core::BinBall ball = core::BinBody(ellipsoid, bin, margin, frame).ball();
        // corners are worst
        const auto share = [&] { return random.chance(0.7) ? std::floor(random.uniform(0.0, 2.0)) : random.uniform(); };
        const glm::dvec3 point =
            ellipsoid.toEcef({south + share() * size, west + share() * wider, low + share() * bin.altitude().width()});
        const glm::dvec3 inMargin = point + 0.999 * margin * random.direction();
        ASSERT_LE(glm::distance(inMargin, frame.toOuter(ball.centre)), ball.radius) << "trial " << trial;
    }
}

TEST(BinBody, IsBoundlessOnFlatEllipsoids) {
    const GeodeticBin bin({0.1, 0.2}, {0.1, 0.2}, {0.0, 1.0});
    const auto reachOf = [&](double polarRadius, double margin) {
        return core::BinBody(Ellipsoid(6e6, polarRadius), bin, margin, core::Frame()).quarters().front().reach;
    };
    EXPECT_TRUE(std::isinf(reachOf(5e6, 0.0)));
    EXPECT_DOUBLE_EQ(reachOf(6e6, 7.0), reachOf(6e6, 0.0) + 7.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
