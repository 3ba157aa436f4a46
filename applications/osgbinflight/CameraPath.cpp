// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CameraPath.h"

#include "CsvTable.h"
#include "TextFile.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

namespace osgAnalyticBin::flight {

namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
constexpr double kDegreesPerRadian = 180.0 / 3.14159265358979323846;
// Far beyond the moon, and far from where a double stops to resolve metres.
constexpr double kLargestDistance = 1e12;
constexpr double kLowestAltitude = -6.3e6;
constexpr double kLongestTime = 1e9;

// Map units: far from where a latitude ends.
constexpr double kLargestCoordinate = 1e9;

struct NumberColumn {
    const char* name;
    double lowest;
    double highest;
    bool isOptional = false;
};

enum Number { EyeLat, EyeLon, EyeAlt, LookLat, LookLon, LookAlt, Fov, Near, Far, Time, Roll, EyeRight, NumberCount };

constexpr std::array<NumberColumn, NumberCount> kNumbers{{{"eyeLatDeg", -90.0, 90.0},
                                                          {"eyeLonDeg", -360.0, 360.0},
                                                          {"eyeAlt", kLowestAltitude, kLargestDistance},
                                                          {"lookLatDeg", -90.0, 90.0},
                                                          {"lookLonDeg", -360.0, 360.0},
                                                          {"lookAlt", kLowestAltitude, kLargestDistance},
                                                          {"fovDeg", 0.001, 179.0},
                                                          {"near", 1e-6, kLargestDistance, true},
                                                          {"far", 1e-6, kLargestDistance, true},
                                                          {"time", 0.0, kLongestTime, true},
                                                          {"rollDeg", -360.0, 360.0, true},
                                                          {"eyeRight", -kLargestDistance, kLargestDistance, true}}};
constexpr const char* kNameColumn = "name";

// In place of the angles, for a map.
constexpr NumberColumn inMap(const char* name) {
    return {name, -kLargestCoordinate, kLargestCoordinate};
}

NumberColumn numberColumn(std::size_t i, bool isMap) {
    if (!isMap) return kNumbers[i];
    switch (i) {
        case EyeLat:
            return inMap("eyeY");
        case EyeLon:
            return inMap("eyeX");
        case LookLat:
            return inMap("lookY");
        case LookLon:
            return inMap("lookX");
        default:
            return kNumbers[i];
    }
}

struct Columns {
    std::size_t name = 0;
    bool isMap = false;
    std::array<std::optional<std::size_t>, NumberCount> numbers;
};

std::optional<Columns> columnsOf(const CsvTable& table, std::string& error) {
    const auto require = [&](const char* name) {
        const auto column = table.column(name);
        if (!column) error = table.fileName + ": column \"" + name + "\" is missing";
        return column;
    };
    Columns columns;
    const auto name = require(kNameColumn);
    if (!name) return std::nullopt;
    columns.name = *name;
    columns.isMap = table.column(numberColumn(EyeLon, true).name).has_value();
    std::vector<std::string> known{kNameColumn};
    for (std::size_t i = 0; i < kNumbers.size(); ++i) {
        const NumberColumn number = numberColumn(i, columns.isMap);
        columns.numbers[i] = number.isOptional ? table.column(number.name) : require(number.name);
        if (!columns.numbers[i] && !number.isOptional) return std::nullopt;
        known.emplace_back(number.name);
    }
    if (columns.numbers[Near].has_value() != columns.numbers[Far].has_value()) {
        error = table.fileName +
                ": of the columns \"near\" and \"far\" one is missing; leave out both, and OSG computes "
                "the planes";
        return std::nullopt;
    }
    const auto unknown = std::find_if(table.columns.begin(), table.columns.end(), [&](const std::string& column) {
        return std::find(known.begin(), known.end(), column) == known.end();
    });
    if (unknown == table.columns.end()) return columns;
    error = table.fileName + ": unknown column \"" + *unknown + "\"";
    return std::nullopt;
}

bool isFileName(const std::string& name) {
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    return !name.empty() && std::all_of(name.begin(), name.end(), allowed);
}

core::Geodetic positionOf(double latitude, double longitude, double altitude, bool isMap) {
    const double radians = isMap ? 1.0 / core::Ellipsoid::kMapUnitsInRadian : kRadiansPerDegree;
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

std::optional<CameraPose> poseOf(const CsvTable& table, const CsvTable::Row& row, const Columns& columns,
                                 std::string& error) {
    std::array<double, NumberCount> n{};
    for (std::size_t i = 0; i < n.size(); ++i) {
        if (!columns.numbers[i]) continue;
        const std::string& cell = row.cells[*columns.numbers[i]];
        const auto number = numberFrom(cell);
        const NumberColumn column = numberColumn(i, columns.isMap);
        if (!number || *number < column.lowest || *number > column.highest) {
            error = atLine(table, row,
                           std::string(column.name) + " is \"" + cell + "\", not a number from " +
                               textFrom(column.lowest) + " to " + textFrom(column.highest));
            return std::nullopt;
        }
        n[i] = *number;
    }
    const std::string& name = row.cells[columns.name];
    std::string problem = contradiction(n);
    if (!isFileName(name)) problem = "name \"" + name + "\" may hold letters, digits, _ and - only";
    if (!problem.empty()) {
        error = atLine(table, row, problem);
        return std::nullopt;
    }
    return CameraPose{name,
                      positionOf(n[EyeLat], n[EyeLon], n[EyeAlt], columns.isMap),
                      positionOf(n[LookLat], n[LookLon], n[LookAlt], columns.isMap),
                      n[Fov] * kRadiansPerDegree,
                      n[Near],
                      n[Far],
                      n[Time],
                      n[Roll] * kRadiansPerDegree,
                      n[EyeRight]};
}

// Gives the pose its time, where the file does not, and looks at what concerns the poses before it too.
bool append(std::vector<CameraPose>& path, CameraPose pose, bool hasTime, std::string& problem) {
    const bool isKnown =
        std::any_of(path.begin(), path.end(), [&](const CameraPose& before) { return before.name == pose.name; });
    if (isKnown) problem = "name \"" + pose.name + "\" is used twice";
    if (!hasTime) pose.time = static_cast<double>(path.size());
    if (!path.empty() && !(path.back().time < pose.time))
        problem = "time is " + textFrom(pose.time) + ", but has to be later than " + textFrom(path.back().time) +
                  " of the pose before";
    path.push_back(std::move(pose));
    return problem.empty();
}

}  // namespace

std::optional<std::vector<CameraPose>> readCameraPath(std::istream& input, const std::string& fileName,
                                                      std::string& error) {
    const auto table = readCsv(input, fileName, error);
    if (!table) return std::nullopt;
    const auto columns = columnsOf(*table, error);
    if (!columns) return std::nullopt;
    std::vector<CameraPose> path;
    for (const CsvTable::Row& row : table->rows) {
        auto pose = poseOf(*table, row, *columns, error);
        if (!pose) return std::nullopt;
        std::string problem;
        if (!append(path, std::move(*pose), columns->numbers[Time].has_value(), problem)) {
            error = atLine(*table, row, problem);
            return std::nullopt;
        }
    }
    if (!path.empty()) return path;
    error = fileName + ": no pose";
    return std::nullopt;
}

std::optional<std::vector<CameraPose>> readCameraPathFile(const std::string& fileName, std::string& error) {
    std::ifstream input(fileName);
    if (input) return readCameraPath(input, fileName, error);
    error = fileName + ": cannot be opened";
    return std::nullopt;
}

std::optional<std::vector<CameraPose>> readCameraPathFiles(const std::vector<std::string>& fileNames,
                                                           std::string& error) {
    std::vector<CameraPose> joined;
    std::map<std::string, std::string> fileOfName;
    for (const std::string& fileName : fileNames) {
        const auto path = readCameraPathFile(fileName, error);
        if (!path) return std::nullopt;
        const double begin = joined.empty() ? 0.0 : joined.back().time + 1.0 - path->front().time;
        for (CameraPose pose : *path) {
            const auto [known, isNew] = fileOfName.emplace(pose.name, fileName);
            if (!isNew) {
                error = fileName + ": name \"" + pose.name + "\" is used in " + known->second + " too";
                return std::nullopt;
            }
            pose.time += begin;
            joined.push_back(std::move(pose));
        }
    }
    return joined;
}

void writeCameraPath(std::ostream& out, const std::vector<CameraPose>& path) {
    const bool havePlanes =
        std::any_of(path.begin(), path.end(), [](const CameraPose& pose) { return pose.hasPlanes(); });
    out.precision(std::numeric_limits<double>::max_digits10);
    out << kNameColumn;
    for (std::size_t i = EyeLat; i <= (havePlanes ? Far : Fov); ++i) out << ',' << kNumbers[i].name;
    out << ',' << kNumbers[Time].name << ',' << kNumbers[Roll].name << '\n';
    std::size_t number = 0;
    for (const CameraPose& pose : path) {
        ++number;
        out << (pose.name.empty() ? "flight" + std::to_string(number) : pose.name);
        for (const core::Geodetic& point : {pose.eye, pose.look}) {
            out << ',' << point.latitude * kDegreesPerRadian << ',' << point.longitude * kDegreesPerRadian << ','
                << point.altitude;
        }
        out << ',' << pose.verticalFov * kDegreesPerRadian;
        if (havePlanes) out << ',' << pose.nearPlane << ',' << pose.farPlane;
        out << ',' << pose.time << ',' << pose.roll * kDegreesPerRadian << '\n';
    }
}

bool writeCameraPathFile(const std::string& fileName, const std::vector<CameraPose>& path, std::string& error) {
    std::ostringstream text;
    writeCameraPath(text, path);
    return support::replaceFile(fileName, text.str(), error);
}

}  // namespace osgAnalyticBin::flight
