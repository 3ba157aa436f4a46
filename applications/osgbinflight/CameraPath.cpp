// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraPath.h"

#include "CsvTable.h"
#include "Failure.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <optional>
#include <regex>
#include <set>

namespace osgAnalyticBin::flight {

using namespace support;

namespace {

// Far beyond the moon, and far from where a double stops to resolve metres.
constexpr double kLargestDistance = 1e12;
constexpr double kLowestAltitude = -6.3e6;
constexpr double kLongestTime = 1e9;

struct NumberColumn {
    const char* name;
    double lowest;
    double highest;
    bool isOptional = false;
    const char* inMap = nullptr;  // what stands for an angle in a map
};

enum Number { EyeLat, EyeLon, EyeAlt, LookLat, LookLon, LookAlt, Fov, Near, Far, Time, Roll, EyeRight, NumberCount };

constexpr std::array<NumberColumn, NumberCount> kNumbers{{{"eyeLatDeg", -90.0, 90.0, false, "eyeY"},
                                                          {"eyeLonDeg", -360.0, 360.0, false, "eyeX"},
                                                          {"eyeAlt", kLowestAltitude, kLargestDistance},
                                                          {"lookLatDeg", -90.0, 90.0, false, "lookY"},
                                                          {"lookLonDeg", -360.0, 360.0, false, "lookX"},
                                                          {"lookAlt", kLowestAltitude, kLargestDistance},
                                                          {"fovDeg", 0.001, 179.0},
                                                          {"near", 1e-6, kLargestDistance, true},
                                                          {"far", 1e-6, kLargestDistance, true},
                                                          {"time", 0.0, kLongestTime, true},
                                                          {"rollDeg", -360.0, 360.0, true},
                                                          {"eyeRight", -kLargestDistance, kLargestDistance, true}}};
constexpr const char* kNameColumn = "name";

NumberColumn numberColumn(std::size_t i, bool isMap) {
    constexpr double kLargestCoordinate = 1e9;  // map units: far from where a latitude ends
    const NumberColumn& column = kNumbers[i];
    return isMap && column.inMap ? NumberColumn{column.inMap, -kLargestCoordinate, kLargestCoordinate} : column;
}

struct Columns {
    std::size_t name = 0;
    bool isMap = false;
    std::array<std::optional<std::size_t>, NumberCount> numbers;
};

Columns columnsOf(const CsvTable& table) {
    const auto require = [&](const char* name) {
        const auto column = table.column(name);
        if (!column) throw Failure(table.fileName + ": column \"" + name + "\" is missing");
        return *column;
    };
    Columns columns;
    columns.name = require(kNameColumn);
    columns.isMap = table.column(numberColumn(EyeLon, true).name).has_value();
    std::vector<std::string> known{kNameColumn};
    for (std::size_t i = 0; i < kNumbers.size(); ++i) {
        const NumberColumn number = numberColumn(i, columns.isMap);
        columns.numbers[i] = number.isOptional ? table.column(number.name) : require(number.name);
        known.emplace_back(number.name);
    }
    if (columns.numbers[Near].has_value() != columns.numbers[Far].has_value())
        throw Failure(table.fileName +
                      ": of the columns \"near\" and \"far\" one is missing; leave out both, and OSG computes the "
                      "planes");
    for (const std::string& column : table.columns)
        if (std::find(known.begin(), known.end(), column) == known.end())
            throw Failure(table.fileName + ": unknown column \"" + column + "\"");
    return columns;
}

core::Geodetic positionOf(double latitude, double longitude, double altitude, bool isMap) {
    const double radians = isMap ? 1.0 / core::Ellipsoid::kMapUnitsInRadian : glm::radians(1.0);
    return {latitude * radians, longitude * radians, altitude};
}

// Why the numbers contradict each other; empty when they do not.
std::string contradiction(const std::array<double, NumberCount>& n) {
    const bool hasPlanes = n[Near] != 0.0;
    if (hasPlanes && !(n[Near] < n[Far])) return "near has to be smaller than far";
    if (n[EyeLat] == n[LookLat] && n[EyeLon] == n[LookLon] && n[EyeAlt] == n[LookAlt])
        return "eye and look are the same point";
    return {};
}

CameraPose poseOf(const CsvTable& table, const CsvTable::Row& row, const Columns& columns) {
    std::array<double, NumberCount> n{};
    for (std::size_t i = 0; i < n.size(); ++i) {
        if (!columns.numbers[i]) continue;
        const std::string& cell = row.cells[*columns.numbers[i]];
        const auto number = numberFrom(cell);
        const NumberColumn column = numberColumn(i, columns.isMap);
        if (!number || *number < column.lowest || *number > column.highest)
            throw Failure(atLine(table, row,
                                 std::string(column.name) + " is \"" + cell + "\", not a number from " +
                                     textFrom(column.lowest) + " to " + textFrom(column.highest)));
        n[i] = *number;
    }
    const std::string& name = row.cells[columns.name];
    std::string problem = contradiction(n);
    if (!std::regex_match(name, std::regex("[A-Za-z0-9_-]+")))
        problem = "name \"" + name + "\" may hold letters, digits, _ and - only";
    if (!problem.empty()) throw Failure(atLine(table, row, problem));
    return CameraPose{name,
                      positionOf(n[EyeLat], n[EyeLon], n[EyeAlt], columns.isMap),
                      positionOf(n[LookLat], n[LookLon], n[LookAlt], columns.isMap),
                      glm::radians(n[Fov]),
                      n[Near],
                      n[Far],
                      n[Time],
                      glm::radians(n[Roll]),
                      n[EyeRight]};
}

}  // namespace

std::vector<CameraPose> readCameraPath(std::istream& input, const std::string& fileName) {
    const CsvTable table = readCsv(input, fileName);
    const Columns columns = columnsOf(table);
    std::vector<CameraPose> path;
    std::set<std::string> names;
    for (const CsvTable::Row& row : table.rows) {
        CameraPose pose = poseOf(table, row, columns);
        if (!columns.numbers[Time]) pose.time = static_cast<double>(path.size());
        if (!names.insert(pose.name).second)
            throw Failure(atLine(table, row, "name \"" + pose.name + "\" is used twice"));
        if (!path.empty() && !(path.back().time < pose.time))
            throw Failure(atLine(table, row,
                                 "time is " + textFrom(pose.time) + ", but has to be later than " +
                                     textFrom(path.back().time) + " of the pose before"));
        path.push_back(std::move(pose));
    }
    if (path.empty()) throw Failure(fileName + ": no pose");
    return path;
}

namespace {

double mixed(double a, double b, double share) {
    const double ratio = a > 0.0 && b > 0.0 ? b / a : 0.0;
    return ratio > 0.0 ? a * std::pow(ratio, share) : a + (b - a) * share;
}

// Directions from the centre of a sphere.
glm::dvec3 directionTo(const core::Geodetic& place) {
    return core::Ellipsoid(1.0, 1.0).up(place.latitude, place.longitude);
}
core::Geodetic placeIn(const glm::dvec3& direction, double altitude) {
    return {std::asin(std::clamp(direction.z, -1.0, 1.0)), std::atan2(direction.y, direction.x), altitude};
}

core::Geodetic mixed(const core::Geodetic& a, const core::Geodetic& b, double share) {
    const glm::dvec3 from = directionTo(a), to = directionTo(b);
    const double angle = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
    const double sine = std::sin(angle);
    // Where the two ends coincide, or stand opposite each other, there is no one circle to follow.
    const glm::dvec3 v = sine > 1e-9 ? (std::sin((1.0 - share) * angle) * from + std::sin(share * angle) * to) / sine
                                     : (share < 0.5 ? from : to);
    return placeIn(v, mixed(a.altitude, b.altitude, share));
}

CameraPose mixed(const CameraPose& a, const CameraPose& b, double share) {
    return {{},
            mixed(a.eye, b.eye, share),
            mixed(a.look, b.look, share),
            mixed(a.verticalFov, b.verticalFov, share),
            mixed(a.nearPlane, b.nearPlane, share),
            mixed(a.farPlane, b.farPlane, share),
            a.time + (b.time - a.time) * share,
            a.roll + (b.roll - a.roll) * share,
            a.eyeRight + (b.eyeRight - a.eyeRight) * share};
}

}  // namespace

std::vector<CameraPose> continuousPath(const std::vector<CameraPose>& path, int frames) {
    std::vector<CameraPose> poses;
    const double begin = path.front().time, duration = path.back().time - begin;
    std::size_t from = 0;
    for (int frame = 0; frame < frames; ++frame) {
        const double time = begin + (frames > 1 ? duration * frame / (frames - 1) : 0.0);
        while (from + 2 < path.size() && path[from + 1].time <= time) ++from;
        const std::size_t to = std::min(from + 1, path.size() - 1);
        const double seconds = path[to].time - path[from].time;
        const double share = seconds > 0.0 ? std::clamp((time - path[from].time) / seconds, 0.0, 1.0) : 0.0;
        poses.push_back(mixed(path[from], path[to], share));
    }
    return poses;
}

std::vector<CameraPose> flightsAhead(const std::vector<CameraPose>& path, int frames, double step) {
    std::vector<CameraPose> poses;
    for (const CameraPose& start : path) {
        const glm::dvec3 across = glm::cross(directionTo(start.eye), directionTo(start.look));
        const glm::dvec3 west(std::sin(start.eye.longitude), -std::cos(start.eye.longitude), 0.0);
        const glm::dvec3 axis = glm::length(across) > 1e-12 ? glm::normalize(across) : west;
        for (int frame = 0; frame < frames; ++frame) {
            const double sine = std::sin(frame * step), cosine = std::cos(frame * step);
            CameraPose pose = start;
            pose.name.clear();
            for (core::Geodetic* const place : {&pose.eye, &pose.look}) {
                const glm::dvec3 from = directionTo(*place);  // perpendicular to the axis
                *place = placeIn(cosine * from + sine * glm::cross(axis, from), place->altitude);
            }
            poses.push_back(pose);
        }
    }
    return poses;
}

}  // namespace osgAnalyticBin::flight
