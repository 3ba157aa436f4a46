// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Boxes of meshes against planes, and as bins. Oracle: corners in long double.

#include "../../osgAnalyticBin/src/node/surface/MeshBox.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

osg::BoundingBoxd randomBox(test::Random& random) {
    osg::BoundingBoxd box;
    const double size = random.logUniform(1e-3, 1e5);
    for (int i = 0; i < 2; ++i)
        box.expandBy(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
    return box;
}

long double distanceOf(const osg::Plane& plane, const osg::Vec3d& point) {
    long double sum = plane[3];
    for (unsigned int i = 0; i < 3; ++i)
        sum += static_cast<long double>(plane[i]) * static_cast<long double>(point[int(i)]);
    return sum;
}

TEST(MeshBox, IsOutsideOrInsideByProof) {
    test::Random random(102);
    int outside = 0, inside = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const osg::BoundingBoxd box = randomBox(random);
        const glm::dvec3 normal = random.direction();
        osg::Plane plane(normal.x, normal.y, normal.z, 0.0);
        // through a corner, or about so
        const double away = random.chance(0.5) ? 0.0 : random.uniform(-1, 1) * 1e-12 * box.radius();
        plane[3] = -static_cast<double>(distanceOf(plane, box.corner(unsigned(random.integer(0, 7))))) + away;
        core::PlaneMask undecided = 1;
        const core::Side side = TestedBox(box).classify({plane}, undecided, nullptr);
        long double least = std::numeric_limits<long double>::infinity(), greatest = -least;
        for (unsigned int i = 0; i < 8; ++i) {
            least = std::min(least, distanceOf(plane, box.corner(i)));
            greatest = std::max(greatest, distanceOf(plane, box.corner(i)));
        }
        EXPECT_TRUE(side != core::Side::Outside || greatest < 0.0L);
        EXPECT_TRUE(side != core::Side::Inside || least >= 0.0L);
        EXPECT_EQ(undecided == 0, side == core::Side::Inside);
        // tight: what is clearly outside or inside is found to be
        const long double slack = 1e-9L * (1.0L + std::abs(static_cast<long double>(plane[3])));
        EXPECT_TRUE(side == core::Side::Outside || greatest >= -slack);
        EXPECT_TRUE(side == core::Side::Inside || least <= slack);
        outside += side == core::Side::Outside;
        inside += side == core::Side::Inside;
    }
    EXPECT_GT(outside, 500);
    EXPECT_GT(inside, 500);
}

TEST(MeshBox, WithASphereIsOutsideOnlyWhereBothAre) {
    const TestedBox box(osg::BoundingBoxd(0, 0, 0, 1, 1, 1));
    const osg::BoundingSphere sphere(osg::Vec3(5, 0, 0), 1.0F);
    const auto sideOf = [&](double x, const osg::BoundingSphere* also) {
        core::PlaneMask undecided = 1;
        return box.classify({osg::Plane(1.0, 0.0, 0.0, -x)}, undecided, also);
    };
    EXPECT_EQ(sideOf(2.0, nullptr), core::Side::Outside);
    EXPECT_EQ(sideOf(2.0, &sphere), core::Side::Straddling);
    EXPECT_EQ(sideOf(7.0, &sphere), core::Side::Outside);
    EXPECT_EQ(sideOf(-1.0, &sphere), core::Side::Inside);
}

TEST(MeshBox, IsABinOfAMapAndBack) {
    test::Random random(103);
    for (int trial = 0; trial < 1000; ++trial) {
        const osg::BoundingBoxd box = randomBox(random);
        const MeshBox mesh = MeshBox(osg::BoundingBoxf(-1, -1, -1, 1, 1, 1))
                                 .moved(osg::Matrixd::scale(box._max) * osg::Matrixd::translate(box._min));
        const MeshBox back(mesh.bin());
        EXPECT_TRUE(back.contains(mesh));
        EXPECT_TRUE(mesh.contains(back));
    }
    EXPECT_FALSE(MeshBox::boundless().bin().valid());
    EXPECT_FALSE(MeshBox().bin().valid());
    EXPECT_FALSE(MeshBox(osg::BoundingBoxf(0, 0, 0, 1e10F, 1, 1)).bin().valid());
    EXPECT_TRUE(MeshBox(AnalyticBin()).isBoundless());
    EXPECT_TRUE(MeshBox::boundless().contains(MeshBox(osg::BoundingBoxf(0, 0, 0, 1, 1, 1))));
    EXPECT_FALSE(MeshBox(osg::BoundingBoxf(0, 0, 0, 1, 1, 1)).contains(MeshBox::boundless()));
}

}  // namespace
}  // namespace osgAnalyticBin
