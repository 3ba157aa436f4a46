// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Matrices of a pose. Oracle: where known points of the globe come to lie in the eye's frame (x right, y up, -z ahead).

#include "CameraView.h"

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/PagedLOD>

#include <support/GridMesh.h>

namespace osgAnalyticBin::flight {
namespace {

constexpr double kRadius = 6378137.0;
constexpr double kMetre = 1e-3;

Globe earth() {
    return {new osg::EllipsoidModel, osg::Matrixd()};
}

CameraPose poseOf(const core::Geodetic& eye, const core::Geodetic& look) {
    return {"pose", eye, look, osg::DegreesToRadians(60.0), 10.0, 1000.0};
}

// Where a point of the globe comes to lie in the eye's frame: to the right, up, ahead.
void expectInEye(const CameraPose& pose, const osg::Vec3d& point, const osg::Vec3d& place, double room = kMetre) {
    const osg::Vec3d found = point * viewMatrixOf(pose, earth());
    EXPECT_LT((found - osg::Vec3d(place.x(), place.y(), -place.z())).length(), room)
        << found.x() << ' ' << found.y() << ' ' << found.z();
}

const CameraPose kStraightDown = poseOf({0.0, 0.0, 1000.0}, {0.0, 0.0, 0.0});

TEST(CameraView, StandsAtItsGeodeticPositionWithTheLocalVerticalUp) {
    const CameraPose east = poseOf({0.0, 0.0, 1000.0}, {0.0, 1e-6, 1000.0});
    expectInEye(east, {kRadius + 1000.0, 0.0, 0.0}, {});
    expectInEye(east, {kRadius + 2000.0, 0.0, 0.0}, {0.0, 1000.0, 0.0}, 0.01);
    expectInEye(east, {kRadius + 1000.0, 500.0, 0.0}, {0.0, 0.0, 500.0}, 0.01);
    // looking straight down, north is up
    expectInEye(kStraightDown, {kRadius, 0.0, 500.0}, {0.0, 500.0, 1000.0});
    const CameraPose pole = poseOf({osg::PI_2, 0.0, 1e6}, {osg::PI_2, 0.0, 0.0});
    EXPECT_TRUE(viewMatrixOf(pole, earth()).valid());
    expectInEye(pole, {0.0, 0.0, 6356752.3142 + 1e6}, {}, 1.0);
}

TEST(CameraView, TurnsUpClockwiseByTheRollAndStepsAsideInTheRolledFrame) {
    CameraPose pose = kStraightDown;
    pose.eyeRight = 30.0;
    expectInEye(pose, {kRadius + 1000.0, 30.0, 0.0}, {});
    pose.roll = osg::PI_2;  // up from north to east, right is south
    expectInEye(pose, {kRadius + 1000.0, 0.0, -30.0}, {});
    pose.eyeRight = 0.0;
    expectInEye(pose, {kRadius, 500.0, 0.0}, {0.0, 500.0, 1000.0});
}

TEST(CameraView, StandsUprightInAMapWhereverThatIs) {
    const osg::Vec3 corners[] = {{0, 0, 5}, {100, 0, 5}, {0, 100, 5}};
    const osg::ref_ptr<osg::PagedLOD> tile = new osg::PagedLOD;
    tile->addChild(test::makeGeometry(new osg::Vec3Array(3, corners), new osg::DrawArrays(GL_TRIANGLES, 0, 3)), 0.0F,
                   1e10F);
    const osg::ref_ptr<osg::CoordinateSystemNode> map = new osg::CoordinateSystemNode("WKT", "PROJCS[\"map\"]");
    map->addChild(tile);
    const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(0.0, 0.0, 5e6));
    moved->addChild(map);
    const core::Ellipsoid plane = core::Ellipsoid::plane();
    const CameraPose pose = poseOf(plane.toGeodetic({50.0, 20.0, 30.0}), plane.toGeodetic({150.0, 20.0, 30.0}));
    const osg::Matrixd view = viewMatrixOf(pose, globeOf(*moved));
    EXPECT_LT((osg::Vec3d(50.0, 20.0, 5e6 + 30.0) * view).length(), kMetre);
    EXPECT_LT((osg::Vec3d(90.0, 20.0, 5e6 + 37.0) * view - osg::Vec3d(0.0, 7.0, -40.0)).length(), kMetre);
}

TEST(CameraView, FollowsATransformAboveTheGlobe) {
    const osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(0.0, 0.0, 5e6));
    const osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    globe->setEllipsoidModel(new osg::EllipsoidModel(1000.0, 1000.0));
    moved->addChild(globe);
    const osg::Matrixd view = viewMatrixOf(poseOf({0.0, 0.0, 100.0}, {0.0, 0.0, 0.0}), globeOf(*moved));
    EXPECT_LT((osg::Vec3d(1100.0, 0.0, 5e6) * view).length(), kMetre);
}

TEST(CameraView, ShowsThePlaneOfTheLookPointUnchangedFromAside) {
    const auto inPicture = [](const CameraPose& pose, const osg::Vec3d& point) {
        return point * viewMatrixOf(pose, earth()) * projectionMatrixOf(pose, earth(), 1.5);
    };
    CameraPose middle = kStraightDown;
    middle.roll = 0.3;
    CameraPose right = middle;
    right.eyeRight = 30.0;
    for (const osg::Vec3d& inPlane : {osg::Vec3d(kRadius, 0.0, 0.0), osg::Vec3d(kRadius, 200.0, -100.0)}) {
        EXPECT_NEAR(inPicture(right, inPlane).x(), inPicture(middle, inPlane).x(), 1e-9);
        EXPECT_NEAR(inPicture(right, inPlane).y(), inPicture(middle, inPlane).y(), 1e-9);
    }
    // What is nearer moves to the left for an eye that moves to the right.
    const osg::Vec3d nearer(kRadius + 500.0, 0.0, 0.0);
    EXPECT_LT(inPicture(right, nearer).x(), inPicture(middle, nearer).x() - 0.01);
}

TEST(CameraView, ProjectsWithTheVerticalFieldOfView) {
    double fovy = 0.0, aspect = 0.0, nearPlane = 0.0, farPlane = 0.0;
    const CameraPose pose = poseOf({0.0, 0.0, 1.0}, {});
    ASSERT_TRUE(projectionMatrixOf(pose, earth(), 1.5).getPerspective(fovy, aspect, nearPlane, farPlane));
    EXPECT_NEAR(fovy, 60.0, 1e-9);
    EXPECT_NEAR(aspect, 1.5, 1e-9);
    EXPECT_NEAR(nearPlane, 10.0, 1e-9);
    EXPECT_NEAR(farPlane, 1000.0, 1e-6);
}

}  // namespace
}  // namespace osgAnalyticBin::flight
