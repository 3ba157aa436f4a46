// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightOptions.h"

#include "ParameterReader.h"

#include <osgAnalyticBin/viewer/CsvTable.h>

#include <cmath>

namespace osgAnalyticBin::flight {

namespace {

constexpr double kMostFrames = 1000.0;
constexpr double kLongestTimeout = 86400.0;

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

ParameterReader readerInto(FlightOptions& options) {
    const auto apply = [&options](const std::string& key, const std::string& value) {
        const auto applied = [](bool success) { return success ? Applied::Yes : Applied::Malformed; };
        if (key == "out") return applied(setOut(options, value));
        if (key == "frames") return applied(setFrames(options, value));
        if (key == "timeout") return applied(setTimeout(options, value));
        return Applied::Unknown;
    };
    return {apply, "out=FOLDER, frames=1..1000, timeout=SECONDS"};
}

}  // namespace

bool applyParameters(const std::string& parameters, FlightOptions& options, std::string& error) {
    return readerInto(options).readBracketed(parameters, error);
}

bool applyOptionString(const std::string& optionString, FlightOptions& options, std::string& error) {
    return readerInto(options).readOptionString(optionString, error);
}

}  // namespace osgAnalyticBin::flight
