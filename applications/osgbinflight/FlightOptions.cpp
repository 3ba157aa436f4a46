// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightOptions.h"

#include "ParameterReader.h"

#include <limits>

namespace osgAnalyticBin::flight {

namespace {

constexpr double kShortestTimeout = std::numeric_limits<double>::min();
constexpr double kLongestTimeout = 86400.0;

bool setOut(FlightOptions& options, const std::string& value) {
    options.out = value;
    return !value.empty();
}

ParameterReader readerInto(FlightOptions& options) {
    const auto apply = [&options](const std::string& key, const std::string& value) {
        if (key == "out") return applied(setOut(options, value));
        if (key == "frames") return applied(setWhole(options.frames, value, 1, 1000));
        if (key == "timeout") return applied(setNumber(options.timeout, value, kShortestTimeout, kLongestTimeout));
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
