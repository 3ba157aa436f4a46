// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../../../osgAnalyticBin/src/node/cull/PlanarBin.h"

#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

using core::Plane;
using core::Side;

// A box somewhere in a map, and the frame of a tile in it, seldom one of right angles.
struct RandomBin {
    explicit RandomBin(test::Random& random) {
        const osg::Vec3d center(random.uniform(-1e7, 1e7), random.uniform(-1e7, 1e7), random.uniform(-1e4, 1e4));
        const osg::Vec3d half(random.logUniform(1e-2, 1e6), random.logUniform(1e-2, 1e6), random.logUniform(1e-3, 1e5));
        box = osg::BoundingBoxd(center - half, center + half);
        if (random.chance(0.5)) {
            const double angle = random.uniform(0.0, 6.0);
            mapToLocal = osg::Matrixd::rotate(angle, osg::Vec3d(random.uniform(), 1.0, random.uniform())) *
                         osg::Matrixd::scale(random.logUniform(0.1, 10.0), 1.0, random.logUniform(0.1, 10.0));
        }
        mapToLocal.postMultTranslate(osg::Vec3d(random.uniform(-1e7, 1e7), random.uniform(-1e7, 1e7), 0.0));
    }

    [[nodiscard]] glm::dvec3 corner(int i) const {
        const osg::Vec3d v = box.corner(static_cast<unsigned int>(i)) * mapToLocal;
        return {v.x(), v.y(), v.z()};
    }
    // of the farthest and the nearest corner along a plane's normal
    [[nodiscard]] core::Interval distances(const Plane& plane) const {
        core::Interval range{plane.distance(corner(0)), plane.distance(corner(0))};
        for (int i = 1; i < 8; ++i) {
            range.lower = std::min(range.lower, plane.distance(corner(i)));
            range.upper = std::max(range.upper, plane.distance(corner(i)));
        }
        return range;
    }

    osg::BoundingBoxd box;
    osg::Matrixd mapToLocal;
};

TEST(PlanarBin, TellsBoxesFromPlanesToRounding) {
    test::Random random(4711);
    for (int trial = 0; trial < 20000; ++trial) {
        const RandomBin any(random);
        const PlanarBin bin(any.box, any.mapToLocal);
        Plane plane{random.direction(), 0.0};
        plane.offset = -glm::dot(plane.normal, any.corner(random.integer(0, 7)));
        const double slack = 1e-3;
        const core::Interval range = any.distances(plane);
        for (const double shift : {0.0, 1e-9, -1e-9, -range.upper - slack, -range.lower + slack}) {
            Plane shifted = plane;
            shifted.offset += shift;
            const Side side = bin.classify(shifted);
            const core::Interval now = any.distances(shifted);
            // the test's own distances are rounded too
            EXPECT_FALSE(now.upper > 1e-6 && side == Side::Outside);
            EXPECT_FALSE(now.lower < -1e-6 && side == Side::Inside);
            // and no more is kept than rounding asks for
            EXPECT_FALSE(now.upper < -1e-4 && side != Side::Outside);
            EXPECT_FALSE(now.lower > 1e-4 && side != Side::Inside);
        }
        EXPECT_EQ(bin.classify({plane.normal, std::nan("")}), Side::Straddling);
    }
}

TEST(PlanarBin, SupportPointsAreFarthestAndTheSphereHoldsTheCorners) {
    test::Random random(4712);
    for (int trial = 0; trial < 5000; ++trial) {
        const RandomBin any(random);
        const PlanarBin bin(any.box, any.mapToLocal);
        const glm::dvec3 direction = random.direction();
        const double farthest = any.distances({direction, 0.0}).upper;
        EXPECT_NEAR(glm::dot(direction, bin.supportPoint(direction)), farthest, 1e-6);
        const osg::BoundingSphere sphere = bin.boundingSphere();
        const glm::dvec3 center(sphere.center().x(), sphere.center().y(), sphere.center().z());
        for (int i = 0; i < 8; ++i) {
            EXPECT_LE(glm::distance(center, any.corner(i)), static_cast<double>(sphere.radius()) + 1e-6);
            EXPECT_LE(glm::length(any.corner(i)), bin.reach() * (1.0 + 1e-12));
        }
    }
}

TEST(PlanarBin, ABoxBeyondAnEdgeIsSeparated) {
    const PlanarBin bin(osg::BoundingBoxd(-10, -10, -1, 10, 10, 1), osg::Matrixd());
    // a wedge about the y axis whose edge lies above the box's corner, outside of neither plane
    core::PlaneSet planes;
    const double s = std::sqrt(0.5);
    planes.push_back({{s, 0.0, s}, -s * 10.5});
    planes.push_back({{-s, 0.0, s}, s * 9.0});
    core::PlaneMask undecided = planes.all();
    ASSERT_EQ(core::classify(bin, planes, undecided), Side::Straddling);
    EXPECT_FALSE(core::isSeparated(bin, planes, planes.size(), undecided));
    core::PlaneSet above;
    above.push_back({{s, 0.0, s}, -s * 4.0});
    above.push_back({{-s, 0.0, s}, -s * 4.0});
    undecided = above.all();
    ASSERT_EQ(bin.classify(above, undecided), Side::Straddling);
    EXPECT_TRUE(core::isSeparated(bin, above, above.size(), undecided));
}

}  // namespace
}  // namespace osgAnalyticBin
