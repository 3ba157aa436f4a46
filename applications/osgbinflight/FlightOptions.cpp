// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FlightOptions.h"

#include <limits>

namespace osgAnalyticBin::flight {

std::vector<Parameter> FlightOptions::parameters() {
    const auto takeFolder = [this](const std::string& value) {
        out = value;
        return !value.empty();
    };
    return {
        {"out=FOLDER", "Folder of the pictures and of poses.csv (default: binflight)", takeFolder},
        {"frames=1..1000", "Frames whose cull time is measured at each pose (default: 15)", wholeInto(frames, 1, 1000)},
        {"timeout=SECONDS", "Longest time that one pose may take (default: 120)",
         numberInto(timeout, std::numeric_limits<double>::min(), 86400.0)}};
}

}  // namespace osgAnalyticBin::flight
