// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The reverse test. Soundness.cpp tests bins with a point that is inside the frustum by long double, and
// RivalBinsTest.cpp that frusta beyond a face are found.

#include "FrustumHull.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <support/View.h>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::GeodeticBin;
using core::Plane;
using hull::FrustumHull;
using hull::ReverseBin;

TEST(ReverseBin, FacesHoldTheBin) {
    Random random(325);
    for (int trial = 0; trial < 20000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const GeodeticBin bin = randomBin(random);
        const double margin = random.chance(0.5) ? 0.0 : random.logUniform(1e-3, 1e4);
        const ReverseBin reverse(ExactGeodeticBin(ellipsoid, bin, margin), bin);
        ASSERT_EQ(reverse.faceCount(), bin.longitude().width() < kPi ? 5u : 3u);
        for (int i = 0; i < 20; ++i) {
            const RealVector point = randomPointWithin(random, ellipsoid, bin, margin);
            ASSERT_LE(length(point), reverse.reach());
            for (std::size_t f = 0; f < reverse.faceCount(); ++f) ASSERT_GE(exactDistance(reverse.face(f), point), 0);
        }
    }
}

TEST(FrustumHull, HasTheCornersOfItsView) {
    Random random(322);
    for (int trial = 0; trial < 1000; ++trial) {
        View view;
        view.eye = 1e7 * random.direction();
        view.lookAlong(random.direction(), random);
        view.halfWidth = random.logUniform(0.05, 2.0);
        ASSERT_EQ(FrustumHull(view.planes(), 4).cornerCount(), 4u) << "the apex, for every three of its planes";
        view.nearDistance = 10.0;
        view.farDistance = 1e6;
        const std::vector<Plane> planes = view.planes();
        const FrustumHull hull(planes, 6);
        ASSERT_EQ(hull.cornerCount(), 8u);
        for (std::size_t i = 0; i < 8; ++i) {
            const auto isOn = [&](const Plane& p) { return std::abs(p.distance(hull.corner(i))) < 1e-4; };
            EXPECT_EQ(std::count_if(planes.begin(), planes.end(), isOn), 3);
            for (const Plane& plane : planes) EXPECT_GT(plane.distance(hull.corner(i)), -1e-4);
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
