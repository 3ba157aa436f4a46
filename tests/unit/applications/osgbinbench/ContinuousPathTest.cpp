// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ContinuousPath.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osgAnalyticBin::bench {
namespace {

constexpr double kTolerance = 1e-12;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

flight::CameraPose poseAt(double latDeg, double lonDeg, double altitude) {
    return {"p", {latDeg * kDegree, lonDeg * kDegree, altitude}, {0.1, lonDeg * kDegree, 0.0}, 1.0, 10.0, 1000.0};
}

TEST(ContinuousPath, BeginsAndEndsWithThePosesGiven) {
    const std::vector<flight::CameraPose> path{poseAt(10, 20, 1000), poseAt(30, 40, 4000), poseAt(50, 60, 500)};
    const auto frames = continuousPath(path, 5);
    ASSERT_EQ(frames.size(), 5U);
    for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_NEAR(frames[2 * i].eye.latitude, path[i].eye.latitude, kTolerance);
        EXPECT_NEAR(frames[2 * i].eye.longitude, path[i].eye.longitude, kTolerance);
        EXPECT_NEAR(frames[2 * i].eye.altitude, path[i].eye.altitude, 1e-9);
    }
}

TEST(ContinuousPath, ClimbsByEqualRatiosAndCrossesTheDateLineTheShortWay) {
    const auto frames = continuousPath({poseAt(0, 170, 1000), poseAt(0, -170, 4000)}, 3);
    EXPECT_NEAR(frames[1].eye.altitude, 2000.0, 1e-9);
    EXPECT_NEAR(std::cos(frames[1].eye.longitude), -1.0, kTolerance);
}

TEST(ContinuousPath, ReachesThePosesAtTheirTimes) {
    std::vector<flight::CameraPose> path{poseAt(10, 20, 1000), poseAt(30, 40, 4000), poseAt(50, 60, 500)};
    path[0].time = 5.0;
    path[1].time = 6.0;
    path[2].time = 9.0;
    const auto frames = continuousPath(path, 5);
    EXPECT_NEAR(frames[1].eye.altitude, 4000.0, 1e-9);
    EXPECT_NEAR(frames[1].time, 6.0, kTolerance);
    EXPECT_NEAR(frames[4].eye.altitude, 500.0, 1e-9);
    EXPECT_NEAR(frames[4].time, 9.0, kTolerance);
}

TEST(ContinuousPath, RollsAndStepsAsideEvenly) {
    std::vector<flight::CameraPose> path{poseAt(10, 20, 1000), poseAt(30, 40, 4000)};
    path[0].roll = -0.5;
    path[1].roll = 1.5;
    path[1].eyeRight = 8.0;
    const auto frames = continuousPath(path, 5);
    EXPECT_NEAR(frames[1].roll, 0.0, kTolerance);
    EXPECT_NEAR(frames[1].eyeRight, 2.0, kTolerance);
}

TEST(ContinuousPath, TakesOnePoseOrOneFrame) {
    EXPECT_EQ(continuousPath({poseAt(1, 2, 3)}, 4).size(), 4U);
    const auto frames = continuousPath({poseAt(10, 20, 1000), poseAt(30, 40, 4000)}, 1);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_NEAR(frames[0].eye.altitude, 1000.0, 1e-9);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
