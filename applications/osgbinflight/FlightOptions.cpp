// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightOptions.h"

#include "CsvTable.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace osgAnalyticBin::flight {

namespace {

constexpr double kMostFrames = 1000.0;
constexpr double kLongestTimeout = 86400.0;

enum class Applied { Yes, Unknown, Malformed };

bool setFrames(FlightOptions& options, const std::string& value) {
    const auto frames = numberFrom(value);
    if (!frames || *frames < 1.0 || *frames > kMostFrames || *frames != std::floor(*frames)) return false;
    options.frames = static_cast<int>(*frames);
    return true;
}

bool setTimeout(FlightOptions& options, const std::string& value) {
    const auto timeout = numberFrom(value);
    if (!timeout || *timeout <= 0.0 || *timeout > kLongestTimeout) return false;
    options.timeout = *timeout;
    return true;
}

bool setOut(FlightOptions& options, const std::string& value) {
    options.out = value;
    return !value.empty();
}

Applied applyItem(const std::string& item, FlightOptions& options) {
    const std::size_t equals = item.find('=');
    const std::string key = trimmed(item.substr(0, equals));
    const std::string value = equals == std::string::npos ? std::string() : trimmed(item.substr(equals + 1));
    const auto applied = [](bool success) { return success ? Applied::Yes : Applied::Malformed; };
    if (key == "out") return applied(setOut(options, value));
    if (key == "frames") return applied(setFrames(options, value));
    if (key == "timeout") return applied(setTimeout(options, value));
    return Applied::Unknown;
}

std::string complaint(const std::string& item, const char* what) {
    return std::string(what) + " parameter \"" + item + "\"; allowed are out=FOLDER, frames=1..1000, timeout=SECONDS";
}

}  // namespace

FlightName flightNameOf(const std::string& fileName) {
    const std::string stem = fileName.substr(0, fileName.rfind('.'));
    const std::size_t open = stem.rfind(".(");
    if (open == std::string::npos || stem.back() != ')') return {stem, {}};
    return {stem.substr(0, open), stem.substr(open + 2, stem.size() - open - 3)};
}

bool applyParameters(const std::string& parameters, FlightOptions& options, std::string& error) {
    std::istringstream items(parameters);
    for (std::string item; std::getline(items, item, ',');) {
        const Applied applied = applyItem(item, options);
        if (applied == Applied::Yes) continue;
        error = complaint(trimmed(item), applied == Applied::Unknown ? "unknown" : "malformed");
        return false;
    }
    return true;
}

bool applyOptionString(const std::string& optionString, FlightOptions& options, std::string& error) {
    std::string blanks = optionString;
    std::replace(blanks.begin(), blanks.end(), ',', ' ');
    std::istringstream items(blanks);
    for (std::string item; items >> item;) {
        if (applyItem(item, options) != Applied::Malformed) continue;
        error = complaint(item, "malformed");
        return false;
    }
    return true;
}

}  // namespace osgAnalyticBin::flight
