// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Camera paths as text, and the frames of a continuous flight. Oracle: values worked out by hand. The table
// format itself is tested here too.

#include "CameraView.h"

#include <cmath>
#include <support/Programs.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::flight {
namespace {

constexpr double kPi = 3.14159265358979323846;
const std::string kHeader = "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n";

constexpr const char* kPose = ",0,0,1000,0,0,0,60,1,2\n";  // after its name

std::vector<CameraPose> read(const std::string& text) {
    std::istringstream input(text);
    return readCameraPath(input, "path.csv");
}

void expectError(const std::string& text, const std::string& what) {
    const std::string error = test::failureOf([&] { (void)read(text); });
    EXPECT_NE(error.find(what), std::string::npos) << what << " is not in " << error;
}

TEST(CameraPath, ConvertsDegreesToRadiansAndKeepsMetres) {
    const auto path = read("# a remark\n\n" + kHeader + " a_1 , 90,-180,1000,45.5,180,-20.5,60,1.5,2e6\n");
    ASSERT_EQ(path.size(), 1u);
    const CameraPose& pose = path.front();
    EXPECT_EQ(pose.name, "a_1");
    EXPECT_DOUBLE_EQ(pose.eye.latitude, kPi / 2);
    EXPECT_DOUBLE_EQ(pose.eye.longitude, -kPi);
    EXPECT_EQ(pose.eye.altitude, 1000.0);
    EXPECT_DOUBLE_EQ(pose.look.latitude, 45.5 * kPi / 180.0);
    EXPECT_DOUBLE_EQ(pose.look.longitude, kPi);
    EXPECT_EQ(pose.look.altitude, -20.5);
    EXPECT_DOUBLE_EQ(pose.verticalFov, kPi / 3);
    EXPECT_EQ(pose.nearPlane, 1.5);
    EXPECT_EQ(pose.farPlane, 2e6);
    // without columns of their own it is level, from the middle, and a second a pose
    EXPECT_EQ(pose.roll, 0.0);
    EXPECT_EQ(pose.eyeRight, 0.0);
    EXPECT_EQ(read(kHeader + "a" + kPose + "b" + kPose).back().time, 1.0);
}

TEST(CameraPath, TakesColumnsInAnyOrderAndTimeRollAndAnEyeAside) {
    const auto path = read(
        "eyeRight,far,time,name,rollDeg,near,fovDeg,lookAlt,lookLonDeg,lookLatDeg,eyeAlt,eyeLonDeg,eyeLatDeg\n"
        "-0.5,9,10,p,-90,8,7,6,5,4,3,2,1\n0.5,9,12.5,q,0,8,7,6,5,4,3,2,1\n");
    EXPECT_EQ(path.front().farPlane, 9.0);
    EXPECT_EQ(path.front().eye.altitude, 3.0);
    EXPECT_DOUBLE_EQ(path.front().eye.latitude, kPi / 180.0);
    EXPECT_EQ(path.front().eyeRight, -0.5);
    EXPECT_EQ(path.front().time, 10.0);
    EXPECT_DOUBLE_EQ(path.front().roll, -kPi / 2);
    EXPECT_EQ(path.back().time, 12.5);
    EXPECT_EQ(path.back().name, "q");
}

TEST(CameraPath, LeavesNearAndFarPlanesToOsg) {
    const std::string header = "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg";
    const auto path = read(header + "\np,1,2,300,1,3,300,60\n");
    EXPECT_FALSE(path.front().hasPlanes());
    expectError(header + ",far\np,1,2,300,1,3,300,60,9\n", "one is missing");
}

TEST(CameraPath, OverAMapHasCoordinatesInPlaceOfAngles) {
    const auto path = read(
        "name,eyeX,eyeY,eyeAlt,lookX,lookY,lookAlt,fovDeg,near,far\n"
        "p,500000.25,4600000.5,900,510000,4600000,800,60,1,2\n");
    EXPECT_EQ(core::Ellipsoid::plane().toEcef(path.front().eye), glm::dvec3(500000.25, 4600000.5, 900.0));
    EXPECT_EQ(core::Ellipsoid::plane().toEcef(path.front().look), glm::dvec3(510000.0, 4600000.0, 800.0));
    expectError("name,eyeX,eyeY,eyeAlt,lookLonDeg,lookLatDeg,lookAlt,fovDeg,near,far\np,1,2,3,4,5,6,7,8,9\n",
                "path.csv: column \"lookY\" is missing");
}

TEST(CameraPath, NamesFileAndLineOfABrokenLine) {
    const std::string good = std::string("a") + kPose;
    expectError(kHeader + good + "b,0,0,1000,0,zero,0,60,1,2\n", "path.csv:3: lookLonDeg");
    expectError("# x\n" + kHeader + "b,91,0,1000,0,0,0,60,1,2\n", "path.csv:3: eyeLatDeg");
    expectError(kHeader + good + good, "path.csv:3: name \"a\" is used twice");
    for (const auto& [line, what] : {std::pair("b,0,0,nan,0,0,0,60,1,2", "eyeAlt"),
                                     {"b,0,0,1000m,0,0,0,60,1,2", "eyeAlt"},
                                     {"b,0,0,1000,0,0,0,180,1,2", "fovDeg"},
                                     {"b,0,0,1000,0,0,0,60,0,2", "near"},
                                     {"b,0,0,1000,0,0,0,60,2,2", "near"},
                                     {"b,0,0,1000,0,0,1000,60,1,2", "eye and look"},
                                     {"b,0,0,1000,0,0,0,60,1", "9 cells"},
                                     {"a/b,0,0,1000,0,0,0,60,1,2", "name"}})
        expectError(kHeader + line + '\n', "path.csv:2: " + std::string(what));
    for (const auto& [column, number] : {std::pair("time", "-1"), {"rollDeg", "400"}, {"eyeRight", ""}})
        expectError(column + ("," + kHeader) + number + "," + good, "path.csv:2: " + std::string(column));
    expectError("time," + kHeader + "3,a" + kPose + "3,b" + kPose, "path.csv:3: time is 3, but has to be later than 3");
}

TEST(CameraPath, RejectsAnUnsuitableHeader) {
    expectError("", "no line that names the columns");
    expectError(kHeader, "no pose");
    expectError("name,eyeLatDeg\na,1\n", "\"eyeLonDeg\" is missing");
    expectError("name,name\na,1\n", "path.csv:1: column \"name\" stands twice");
    expectError("roll," + kHeader + "0,a" + kPose, "unknown column \"roll\"");
}

TEST(CameraPath, JoinsFilesOneSecondApart) {
    const test::TemporaryFolder folder;
    const std::string first = folder.write("first.csv", "time," + kHeader + "4,a" + kPose + "9,b" + kPose);
    const std::string second = folder.write("second.csv", "time," + kHeader + "7,c" + kPose + "8,d" + kPose);
    const auto path = readCameraPathFiles({first, second});
    ASSERT_EQ(path.size(), 4U);
    EXPECT_EQ(path[1].time, 9.0);
    EXPECT_EQ(path[2].time, 10.0);
    EXPECT_EQ(path[3].time, 11.0);
    for (const auto& [other, what] :
         {std::pair(first, "name \"a\" is used in " + first + " too"), {"/nowhere/path.csv", "/nowhere/path.csv"}}) {
        const std::string error = test::failureOf([&, file = other] { (void)readCameraPathFiles({first, file}); });
        EXPECT_NE(error.find(what), std::string::npos) << error;
    }
}

// Names that begin with the path's, so that figures can be summed up by path.
TEST(CameraPath, TheShippedPathsAreGoodTogetherAndNamedForTheirFiles) {
    std::vector<std::string> files;
    for (const std::string name :
         {"nadir", "oblique", "horizon", "rockies", "pole", "dateline", "sensor10", "sensor2", "stereo", "turning"}) {
        files.push_back(std::string(SHIPPED_PATHS) + "/" + name + ".csv");
        const auto path = readCameraPathFiles({files.back()});
        EXPECT_GE(path.size(), 6U) << name;
        for (const CameraPose& pose : path) EXPECT_EQ(pose.name.rfind(name + "_", 0), 0U) << pose.name;
    }
    EXPECT_NO_THROW((void)readCameraPathFiles(files));
    EXPECT_GE(readCameraPathFiles({DEMO_PATH_FILE}).size(), 14u);
}

constexpr double kTolerance = 1e-12;

CameraPose poseAt(double latDeg, double lonDeg, double altitude, double time = 0.0) {
    const double longitude = lonDeg * kPi / 180.0;
    CameraPose pose{"p", {latDeg * kPi / 180.0, longitude, altitude}, {0.1, longitude, 0.0}, 1.0, 10.0, 1000.0};
    pose.time = time;
    return pose;
}

// Straight down, level and rolled, as a viewer of OSG records them; standing still, and between half seconds.
TEST(PathFiles, AnAnimationPathShowsWhatWasRecorded) {
    const Globe earth{new osg::EllipsoidModel, osg::Matrixd()};
    const test::TemporaryFolder folder;
    std::ostringstream text;
    std::vector<osg::Matrixd> views;
    text.precision(15);
    for (const auto& [ahead, roll] : {std::pair(0.0, 0.0), {0.3, 0.4}, {0.3, -2.0}, {0.001, 3.0}}) {
        CameraPose pose{"p", {0.5, 1.0, 5e4}, {0.5 + ahead, 1.0, 0.0}, 0.5};
        pose.roll = roll;
        views.push_back(viewMatrixOf(pose, earth));
        const osg::Matrixd seen = osg::Matrixd::inverse(views.back());
        const osg::Quat turn = seen.getRotate();
        for (const double late : {0.0, 0.3, 0.6})
            text << 10.0 + 2.0 * static_cast<double>(views.size()) + late << ' ' << seen.getTrans().x() << ' '
                 << seen.getTrans().y() << ' ' << seen.getTrans().z() << ' ' << turn.x() << ' ' << turn.y() << ' '
                 << turn.z() << ' ' << turn.w() << '\n';
    }
    const auto path = readCameraPathFiles({folder.write("my_flight 2.path", text.str())}, [&] { return earth; });
    ASSERT_EQ(path.size(), views.size());
    const osg::Vec3d ahead(100.0, 200.0, -1000.0);
    for (std::size_t i = 0; i < views.size(); ++i) {
        EXPECT_EQ(path[i].name, "my-flight-2_" + std::to_string(i + 1));
        EXPECT_EQ(path[i].time, 12.0 + 2.0 * static_cast<double>(i));
        EXPECT_FALSE(path[i].hasPlanes());
        EXPECT_LT((ahead * osg::Matrixd::inverse(views[i]) * viewMatrixOf(path[i], earth) - ahead).length(), 0.01);
    }
    for (const char* const broken : {"", "1 2 3 4 5 six", "name,eyeLatDeg\n"}) {
        const std::string file = folder.write("broken.path", broken);
        EXPECT_NE(test::failureOf([&] { (void)readCameraPathFiles({file}); }).find("broken.path: "), std::string::npos);
    }
}

TEST(ContinuousPath, ReachesThePosesAtTheirTimes) {
    for (const double middle : {6.0, 7.0}) {
        const std::vector<CameraPose> path{poseAt(10, 20, 1000, 5.0), poseAt(30, 40, 4000, middle),
                                           poseAt(50, 60, 500, 9.0)};
        const auto frames = continuousPath(path, 5);
        ASSERT_EQ(frames.size(), 5U);
        const std::size_t places[] = {0, static_cast<std::size_t>(middle) - 5, 4};
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(frames[places[i]].eye.latitude, path[i].eye.latitude, kTolerance);
            EXPECT_NEAR(frames[places[i]].eye.longitude, path[i].eye.longitude, kTolerance);
            EXPECT_NEAR(frames[places[i]].eye.altitude, path[i].eye.altitude, 1e-9);
            EXPECT_NEAR(frames[places[i]].time, path[i].time, kTolerance);
        }
    }
}

TEST(ContinuousPath, ClimbsByEqualRatiosRollsAndStepsAsideAndCrossesTheDateLineTheShortWay) {
    std::vector<CameraPose> path{poseAt(0, 170, 1000, 0.0), poseAt(0, -170, 4000, 1.0)};
    path[0].roll = -0.5;
    path[1].roll = 1.5;
    path[1].eyeRight = 8.0;
    const auto frames = continuousPath(path, 5);
    EXPECT_NEAR(frames[2].eye.altitude, 2000.0, 1e-9);
    EXPECT_NEAR(std::cos(frames[2].eye.longitude), -1.0, kTolerance);
    EXPECT_NEAR(frames[1].roll, 0.0, kTolerance);
    EXPECT_NEAR(frames[1].eyeRight, 2.0, kTolerance);
}

TEST(FlightsAhead, GoFromEachPoseToWhereItLooks) {
    const auto frames = flightsAhead({poseAt(0, 10, 1000), poseAt(20, 30, 500)}, 3, 0.01);
    ASSERT_EQ(frames.size(), 6U);
    EXPECT_NEAR(frames[2].eye.latitude, 0.02, kTolerance);
    EXPECT_NEAR(frames[2].look.latitude, 0.12, kTolerance);
    EXPECT_NEAR(frames[4].eye.latitude, kPi / 9.0 - 0.01, kTolerance);
    EXPECT_NEAR(frames[4].eye.longitude, kPi / 6.0, kTolerance);
    EXPECT_EQ(frames[4].eye.altitude, 500.0);
}

TEST(ContinuousPath, TakesOnePoseOrOneFrame) {
    EXPECT_EQ(continuousPath({poseAt(1, 2, 3)}, 4).size(), 4U);
    const auto frames = continuousPath({poseAt(10, 20, 1000), poseAt(30, 40, 4000)}, 1);
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_NEAR(frames[0].eye.altitude, 1000.0, 1e-9);
}

}  // namespace
}  // namespace osgAnalyticBin::flight
