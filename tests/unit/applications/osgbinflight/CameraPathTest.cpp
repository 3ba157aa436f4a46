// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Camera paths as text. Oracle: values worked out by hand. The table format itself is tested here too.

#include "CameraPath.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <support/FailureText.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::flight {
namespace {

constexpr double kPi = 3.14159265358979323846;
const std::string kHeader = "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg,near,far\n";

std::string errorOf(const std::string& text) {
    std::istringstream input(text);
    return test::failureOf([&] { (void)readCameraPath(input, "path.csv"); });
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(CameraPath, ConvertsDegreesToRadiansAndKeepsMetres) {
    std::istringstream input("# a remark\n\n" + kHeader + " a_1 , 90,-180,1000,45.5,180,-20.5,60,1.5,2e6\n");
    const auto path = readCameraPath(input, "path.csv");
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
}

TEST(CameraPath, TakesColumnsInAnyOrder) {
    std::istringstream input(
        "far,name,near,fovDeg,lookAlt,lookLonDeg,lookLatDeg,eyeAlt,eyeLonDeg,eyeLatDeg\n9,p,8,7,6,5,4,3,2,1\n");
    const auto path = readCameraPath(input, "path.csv");
    EXPECT_EQ(path.front().farPlane, 9.0);
    EXPECT_EQ(path.front().eye.altitude, 3.0);
    EXPECT_DOUBLE_EQ(path.front().eye.latitude, kPi / 180.0);
}

TEST(CameraPath, LeavesNearAndFarPlanesToOsg) {
    const std::string header = "name,eyeLatDeg,eyeLonDeg,eyeAlt,lookLatDeg,lookLonDeg,lookAlt,fovDeg";
    std::istringstream input(header + "\np,1,2,300,1,3,300,60\n");
    const auto path = readCameraPath(input, "path.csv");
    EXPECT_FALSE(path.front().hasPlanes());
    std::ostringstream written;
    writeCameraPath(written, path);
    EXPECT_EQ(written.str().substr(0, header.size() + 6), header + ",time,");
    EXPECT_TRUE(contains(errorOf(header + ",far\np,1,2,300,1,3,300,60,9\n"), "one is missing"));
}

TEST(CameraPath, OverAMapHasCoordinatesInPlaceOfAngles) {
    const std::string header = "name,eyeX,eyeY,eyeAlt,lookX,lookY,lookAlt,fovDeg,near,far\n";
    std::istringstream input(header + "p,500000.25,4600000.5,900,510000,4600000,800,60,1,2\n");
    const auto path = readCameraPath(input, "path.csv");
    EXPECT_EQ(core::Ellipsoid::plane().toEcef(path.front().eye), glm::dvec3(500000.25, 4600000.5, 900.0));
    EXPECT_EQ(core::Ellipsoid::plane().toEcef(path.front().look), glm::dvec3(510000.0, 4600000.0, 800.0));
    std::istringstream mixed(
        "name,eyeX,eyeY,eyeAlt,lookLonDeg,lookLatDeg,lookAlt,fovDeg,near,far\np,1,2,3,4,5,6,7,8,9\n");
    EXPECT_EQ(test::failureOf([&] { (void)readCameraPath(mixed, "path.csv"); }),
              "path.csv: column \"lookY\" is missing");
}

TEST(CameraPath, NamesFileAndLineOfABrokenLine) {
    const std::string good = "a,0,0,1000,0,0,0,60,1,2\n";
    EXPECT_TRUE(contains(errorOf(kHeader + good + "b,0,0,1000,0,zero,0,60,1,2\n"), "path.csv:3: lookLonDeg"));
    EXPECT_TRUE(contains(errorOf("# x\n" + kHeader + "b,91,0,1000,0,0,0,60,1,2\n"), "path.csv:3: eyeLatDeg"));
    EXPECT_TRUE(contains(errorOf(kHeader + "b,0,0,nan,0,0,0,60,1,2\n"), "path.csv:2: eyeAlt"));
    EXPECT_TRUE(contains(errorOf(kHeader + "b,0,0,1000m,0,0,0,60,1,2\n"), "path.csv:2: eyeAlt"));
    EXPECT_TRUE(contains(errorOf(kHeader + "b,0,0,1000,0,0,0,180,1,2\n"), "path.csv:2: fovDeg"));
    EXPECT_TRUE(contains(errorOf(kHeader + "b,0,0,1000,0,0,0,60,0,2\n"), "path.csv:2: near"));
    EXPECT_TRUE(contains(errorOf(kHeader + "b,0,0,1000,0,0,0,60,2,2\n"), "path.csv:2: near"));
    EXPECT_TRUE(contains(errorOf(kHeader + "b,0,0,1000,0,0,1000,60,1,2\n"), "path.csv:2: eye and look"));
    EXPECT_TRUE(contains(errorOf(kHeader + "b,0,0,1000,0,0,0,60,1\n"), "path.csv:2: 9 cells"));
    EXPECT_TRUE(contains(errorOf(kHeader + "a/b,0,0,1000,0,0,0,60,1,2\n"), "path.csv:2: name"));
    EXPECT_TRUE(contains(errorOf(kHeader + good + good), "path.csv:3: name \"a\" is used twice"));
}

TEST(CameraPath, RejectsAnUnsuitableHeader) {
    EXPECT_TRUE(contains(errorOf(""), "no line that names the columns"));
    EXPECT_TRUE(contains(errorOf(kHeader), "no pose"));
    EXPECT_TRUE(contains(errorOf("name,eyeLatDeg\na,1\n"), "\"eyeLonDeg\" is missing"));
    EXPECT_TRUE(contains(errorOf("name,name\na,1\n"), "path.csv:1: column \"name\" stands twice"));
    const std::string header = kHeader.substr(0, kHeader.size() - 1);
    EXPECT_TRUE(contains(errorOf(header + ",roll\na,0,0,1000,0,0,0,60,1,2,0\n"), "unknown column \"roll\""));
}

TEST(CameraPath, TakesTimeRollAndAnEyeAside) {
    const std::string header = "eyeRight,time,rollDeg," + kHeader;
    std::istringstream input(header + "-0.5,10,-90,a,0,0,1000,0,0,0,60,1,2\n0.5,12.5,0,b,0,0,1000,0,0,0,60,1,2\n");
    const auto path = readCameraPath(input, "path.csv");
    EXPECT_EQ(path.front().eyeRight, -0.5);
    EXPECT_EQ(path.front().time, 10.0);
    EXPECT_DOUBLE_EQ(path.front().roll, -kPi / 2);
    EXPECT_EQ(path.back().time, 12.5);
    EXPECT_EQ(path.back().name, "b");
}

TEST(CameraPath, IsLevelFromTheMiddleAndASecondAPoseWithoutTheseColumns) {
    std::istringstream input(kHeader + "a,0,0,1000,0,0,0,60,1,2\nb,0,0,1000,0,0,0,60,1,2\n");
    const auto path = readCameraPath(input, "path.csv");
    EXPECT_EQ(path.front().time, 0.0);
    EXPECT_EQ(path.back().time, 1.0);
    EXPECT_EQ(path.back().roll, 0.0);
    EXPECT_EQ(path.back().eyeRight, 0.0);
}

TEST(CameraPath, RejectsTimesThatDoNotGrow) {
    const std::string header = "time," + kHeader;
    const std::string error = errorOf(header + "3,a,0,0,1000,0,0,0,60,1,2\n3,b,0,0,1000,0,0,0,60,1,2\n");
    EXPECT_TRUE(contains(error, "path.csv:3: time is 3, but has to be later than 3")) << error;
    EXPECT_TRUE(contains(errorOf(header + "-1,a,0,0,1000,0,0,0,60,1,2\n"), "path.csv:2: time"));
    EXPECT_TRUE(contains(errorOf("rollDeg," + kHeader + "400,a,0,0,1000,0,0,0,60,1,2\n"), "path.csv:2: rollDeg"));
    EXPECT_TRUE(contains(errorOf("eyeRight," + kHeader + ",a,0,0,1000,0,0,0,60,1,2\n"), "path.csv:2: eyeRight"));
}

TEST(CameraPath, JoinsFilesOneSecondApart) {
    const test::TemporaryFolder folder;
    const std::string first = folder.write("first.csv", "time," + kHeader +
                                                            "4,a,0,0,1000,0,0,0,60,1,2\n"
                                                            "9,b,0,0,1000,0,0,0,60,1,2\n");
    const std::string second = folder.write("second.csv", "time," + kHeader +
                                                              "7,c,0,0,1000,0,0,0,60,1,2\n"
                                                              "8,d,0,0,1000,0,0,0,60,1,2\n");
    const auto path = readCameraPathFiles({first, second});
    ASSERT_EQ(path.size(), 4U);
    EXPECT_EQ(path[1].time, 9.0);
    EXPECT_EQ(path[2].time, 10.0);
    EXPECT_EQ(path[3].time, 11.0);
    const auto errorOfSecond = [&](const std::string& other) {
        return test::failureOf([&] { (void)readCameraPathFiles({first, other}); });
    };
    EXPECT_TRUE(contains(errorOfSecond(first), "name \"a\" is used in " + first + " too")) << errorOfSecond(first);
    EXPECT_TRUE(contains(errorOfSecond("/nowhere/path.csv"), "/nowhere/path.csv"));
}

// Names that begin with the path's, so that figures can be summed up by path.
TEST(CameraPath, TheShippedPathsAreGoodTogetherAndNamedForTheirFiles) {
    const std::vector<std::string> names{"nadir",    "oblique",  "horizon", "rockies", "pole",
                                         "dateline", "sensor10", "sensor2", "stereo",  "turning"};
    std::vector<std::string> files;
    for (const std::string& name : names) files.push_back(std::string(SHIPPED_PATHS) + "/" + name + ".csv");
    EXPECT_NO_THROW((void)readCameraPathFiles(files));
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto path = readCameraPathFiles({files[i]});
        EXPECT_GE(path.size(), 6U) << names[i];
        for (const CameraPose& pose : path) EXPECT_EQ(pose.name.rfind(names[i] + "_", 0), 0U) << pose.name;
    }
}

TEST(CameraPath, TheDemosPathIsGood) {
    const auto path = readCameraPathFiles({DEMO_PATH_FILE});
    EXPECT_GE(path.size(), 14u);
}

}  // namespace
}  // namespace osgAnalyticBin::flight
