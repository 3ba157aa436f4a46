// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Boxes of meshes as bins of a map.

#include "../../osgAnalyticBin/src/kit/surface/MeshBox.h"
#include "TileFixture.h"

#include <gtest/gtest.h>

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

// The eyes are near: from afar the rounding is smaller than a pixel.
TEST(MeshBox, HoldsVerticesWhereTheyAreDrawn) {
    test::Random random(104);
    for (int trial = 0; trial < 1000; ++trial) {
        const osg::BoundingBoxd box = randomBox(random);
        const osg::Vec3 vertex(box._min);
        const osg::Vec3d eye = box._min + osg::Vec3d(random.uniform(0.1, 1.0), 0.2, 0.3) * (0.01 * box._min.length());
        const osg::Vec3d drawn =
            test::drawnByFloats(vertex, osg::Matrixd::lookAt(eye, osg::Vec3d(vertex), osg::Vec3d(0, 0, 1)));
        const AnalyticBin bin = MeshBox(osg::BoundingBoxf(vertex, vertex)).bin();
        EXPECT_LE((drawn - osg::Vec3d(vertex)).length(), bin.margin()) << trial;
    }
}

}  // namespace
}  // namespace osgAnalyticBin
