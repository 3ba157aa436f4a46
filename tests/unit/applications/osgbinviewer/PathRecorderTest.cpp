// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Recorded camera paths. Oracle: what osgbinbench makes of them.

#include "CameraView.h"
#include "Handlers.h"
#include "ViewerFixture.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <support/FailureText.h>

namespace osgAnalyticBin::viewer {
namespace {

using test::ViewerScene;

std::vector<flight::CameraPose> somePath(ViewerScene& scene) {
    std::vector<flight::CameraPose> path;
    for (const double pitch : {0.5, 30.0, 65.0, 89.0}) {
        scene.lookFrom(-33.0 + pitch, 150.0 + pitch, 1000.0 * (1.0 + pitch * pitch), pitch, 35.0);
        const auto pose = recordedPose(scene.camera(), 0.5 * double(path.size()));
        if (pose) path.push_back(*pose);
    }
    return path;
}

TEST(PathRecorder, WritesWhatIsReadBackEqual) {
    ViewerScene scene;
    std::vector<flight::CameraPose> path = somePath(scene);
    ASSERT_EQ(path.size(), 4u);
    for (std::size_t i = 0; i < path.size(); ++i) path[i].roll = 0.3 - 0.2 * double(i);
    std::istringstream text(textOf(path));
    const auto read = flight::readCameraPath(text, "recorded");
    ASSERT_EQ(read.size(), path.size());
    constexpr double kRounding = 2e-15;
    const auto expectSame = [](const core::Geodetic& a, const core::Geodetic& b) {
        EXPECT_NEAR(a.latitude, b.latitude, kRounding);
        EXPECT_NEAR(a.longitude, b.longitude, kRounding);
        EXPECT_EQ(a.altitude, b.altitude);
    };
    for (std::size_t i = 0; i < path.size(); ++i) {
        expectSame(read[i].eye, path[i].eye);
        expectSame(read[i].look, path[i].look);
        EXPECT_NEAR(read[i].verticalFov, path[i].verticalFov, kRounding);
        EXPECT_EQ(read[i].nearPlane, path[i].nearPlane);
        EXPECT_EQ(read[i].farPlane, path[i].farPlane);
        EXPECT_EQ(read[i].time, path[i].time);
        EXPECT_NEAR(read[i].roll, path[i].roll, kRounding);
    }
}

TEST(PathRecorder, TellsTheRollAndPlaysIt) {
    ViewerScene scene;
    for (const auto& [pitch, roll] : {std::pair(1.0, 0.0), {70.0, -2.0}, {70.0, -0.3}, {80.0, 0.4}, {100.0, 3.0}}) {
        scene.lookFrom(10.0, 20.0, 50e3, pitch, 35.0);
        // the camera turns clockwise: the picture turns the other way
        scene.camera().setViewMatrix(scene.camera().getViewMatrix() *
                                     osg::Matrixd::rotate(roll, osg::Vec3d(0.0, 0.0, 1.0)));
        const auto pose = recordedPose(scene.camera(), 0.0);
        ASSERT_TRUE(pose);
        EXPECT_NEAR(pose->roll, roll, 1e-6);
        flight::CameraPose played{"p", pose->eye, pose->look, pose->verticalFov, pose->nearPlane, pose->farPlane};
        played.roll = pose->roll;
        const osg::Matrixd difference = osg::Matrixd::inverse(scene.camera().getViewMatrix()) *
                                        flight::viewMatrixOf(played, flight::globeOf(scene.database()));
        const osg::Vec3d ahead(100.0, 200.0, -1000.0);
        EXPECT_LT((ahead * difference - ahead).length(), 0.01) << roll;
    }
}

TEST(PathRecorder, HasNoPoseOfAnOrthographicViewOrThatOsgbinbenchRefuses) {
    ViewerScene scene;
    scene.camera().setProjectionMatrixAsOrtho(-1.0, 1.0, -1.0, 1.0, 1.0, 10.0);
    EXPECT_FALSE(recordedPose(scene.camera(), 0.0));
    scene.camera().setProjectionMatrixAsPerspective(35.0, 1.0, 1000.0, 1e8);
    scene.camera().setViewMatrix(osg::Matrixd());  // at the earth's centre
    EXPECT_FALSE(recordedPose(scene.camera(), 0.0));
}

}  // namespace
}  // namespace osgAnalyticBin::viewer
