// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Measurement.h"

#include "Failure.h"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

namespace osgAnalyticBin::bench {

using support::Failure;

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 10> kConditions{"database", "path",      "options",   "vertical_scale", "width",
                                                  "height",   "threading", "flush_mib", "expiry",         "osg"};

const Json& member(const Json& object, const char* key) {
    static const Json absent;
    return object.is_object() && object.contains(key) ? object[key] : absent;
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
    throw Failure(file + ": " + what + "; give a file that osgbinbench --json wrote");
}

std::vector<double> numbersOf(const Json& array, std::size_t count, const std::string& file, const std::string& where) {
    bool isGood = array.is_array() && array.size() == count;
    std::vector<double> numbers;
    for (const Json& number : array) {
        isGood = isGood && number.is_number();
        if (isGood) numbers.push_back(number.get<double>());
    }
    if (!isGood) refuse(file, where + " does not hold a number for each pose");
    return numbers;
}

std::vector<MeasuredMethod> methodsOf(const Json& methods, const std::string& file, const std::string& where) {
    std::vector<MeasuredMethod> measured;
    for (const auto& [name, figures] : methods.items()) {
        MeasuredMethod& method = measured.emplace_back();
        method.name = name;
        if (!figures.is_object()) refuse(file, where + "." + name + " holds no figures");
        for (const auto& [column, number] : figures.items()) {
            if (!number.is_number()) refuse(file, where + "." + name + "." + column + " is no number");
            method.sums[column] = number.get<double>();
        }
    }
    return measured;
}

void readPoses(const Json& json, Measurement& measurement) {
    for (const Json& name : member(json, "pose_names")) {
        if (!name.is_string()) refuse(measurement.file, "pose_names holds something that is no name");
        measurement.poseNames.push_back(name.get<std::string>());
    }
    for (MeasuredMethod& method : measurement.methods) {
        const Json& columns = member(member(json, "by_pose"), method.name.c_str());
        for (const auto& [column, numbers] : columns.items())
            method.byPose[column] = numbersOf(numbers, measurement.poseNames.size(), measurement.file,
                                              "by_pose." + method.name + "." + column);
    }
}

}  // namespace

Measurement measurementFromFile(const std::string& file) {
    std::ifstream input(file);
    if (!input) throw Failure(file + ": cannot be opened");
    const Json json = Json::parse(input, nullptr, false);
    if (json.is_discarded()) refuse(file, "is no JSON");
    const Json& mode = member(json, "mode");
    const Json& methods = member(json, "methods");
    if (!mode.is_string() || !methods.is_object() || methods.empty()) refuse(file, "has no \"mode\" or no \"methods\"");
    Measurement measurement;
    measurement.file = file;
    measurement.mode = mode.get<std::string>();
    for (const char* const key : kConditions) measurement.conditions.emplace_back(key, member(json, key).dump());
    measurement.methods = methodsOf(methods, file, "methods");
    const Json& live = member(member(json, "live"), "methods");
    if (live.is_object()) measurement.live = methodsOf(live, file, "live.methods");
    readPoses(json, measurement);
    return measurement;
}

}  // namespace osgAnalyticBin::bench
