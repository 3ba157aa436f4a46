// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraView.h"
#include "Failure.h"

#include <osg/Quat>
#include <osgDB/FileNameUtils>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>

namespace osgAnalyticBin::flight {

using support::Failure;

namespace {

// Clockwise about the line of sight, radians.
double rollOf(const osg::Vec3d& sight, const osg::Vec3d& up, const osg::Vec3d& upWithoutRoll) {
    const osg::Vec3d level = upWithoutRoll - sight * (sight * upWithoutRoll);
    return std::atan2((level ^ up) * sight, level * up);
}

CameraPose poseOf(const osg::Vec3d& eye, const osg::Quat& attitude, const Globe& globe) {
    constexpr double kShortestSight = 100.0;
    const osg::Vec3d sight = attitude * osg::Vec3d(0.0, 0.0, -1.0);
    CameraPose pose;
    pose.verticalFov = 2.0 * std::atan2(0.13, 0.5);  // OSG's screen, 26 cm high, seen from 50 cm
    pose.eye = globe.geodetic(eye);
    const auto ground = globe.radii().isPlane() ? std::nullopt : globe.intersection(eye, sight);
    const double distance = std::max(kShortestSight, std::abs(pose.eye.altitude));
    pose.look = globe.geodetic(ground && (*ground - eye).length() > kShortestSight ? *ground : eye + sight * distance);
    pose.roll = rollOf(sight, attitude * osg::Vec3d(0.0, 1.0, 0.0), upWithoutRoll(globe, pose.eye, sight));
    return pose;
}

// Letters and digits alone: what follows an underscore numbers the poses of a path.
std::string pathNameOf(const std::string& fileName) {
    std::string name = osgDB::getStrippedName(fileName);
    const auto isOther = [](unsigned char c) { return !std::isalnum(c); };
    std::replace_if(name.begin(), name.end(), isOther, '-');
    return name + "_";
}

std::vector<CameraPose> readAnimationPath(std::istream& input, const std::string& fileName, const Globe& globe) {
    constexpr double kInterval = 0.5;  // seconds
    const std::string name = pathNameOf(fileName);
    std::vector<CameraPose> path;
    osg::Vec3d eye, lastEye;
    osg::Quat attitude, lastAttitude;
    double time = 0.0;
    while (input >> time >> eye.x() >> eye.y() >> eye.z() >> attitude.x() >> attitude.y() >> attitude.z() >>
           attitude.w()) {
        const bool isDue = path.empty() || time >= path.back().time + kInterval;
        if (!isDue || (!path.empty() && eye == lastEye && attitude == lastAttitude)) continue;
        path.push_back(poseOf(eye, attitude, globe));
        path.back().name = name + std::to_string(path.size());
        path.back().time = time;
        lastEye = eye;
        lastAttitude = attitude;
    }
    if (!input.eof()) throw Failure(fileName + ": is not an animation path of OpenSceneGraph");
    if (path.empty()) throw Failure(fileName + ": no pose");
    return path;
}

}  // namespace

std::vector<CameraPose> readCameraPathFiles(const std::vector<std::string>& fileNames,
                                            const std::function<Globe()>& globe) {
    std::vector<CameraPose> joined;
    std::map<std::string, std::string> fileOfName;
    std::optional<Globe> seen;
    for (const std::string& fileName : fileNames) {
        std::ifstream input(fileName);
        if (!input) throw Failure(fileName + ": cannot be opened");
        const bool isAnimation = osgDB::getLowerCaseFileExtension(fileName) == "path";
        if (isAnimation && !seen) seen = globe();
        const std::vector<CameraPose> path =
            isAnimation ? readAnimationPath(input, fileName, *seen) : readCameraPath(input, fileName);
        const double begin = joined.empty() ? 0.0 : joined.back().time + 1.0 - path.front().time;
        for (CameraPose pose : path) {
            const auto [known, isNew] = fileOfName.emplace(pose.name, fileName);
            if (!isNew) throw Failure(fileName + ": name \"" + pose.name + "\" is used in " + known->second + " too");
            pose.time += begin;
            joined.push_back(std::move(pose));
        }
    }
    return joined;
}

}  // namespace osgAnalyticBin::flight
