// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ParameterReader.h"

#include <limits>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// How a camera path is flown.
struct FlightOptions {
    std::string out = "binflight";  ///< folder of the pictures and of poses.csv; made if missing
    int frames = 15;                ///< frames whose cull time is measured at each pose, 1 to 1000
    double timeout = 120.0;         ///< seconds that one pose may take to load and draw

    /// What reads "out=DIR,frames=15,timeout=120" into these. A folder's name may hold blanks, but no comma.
    [[nodiscard]] std::vector<Parameter> parameters() {
        const auto takeFolder = [this](const std::string& value) {
            out = value;
            return !value.empty();
        };
        return {{"out=FOLDER", "Folder of the pictures and of poses.csv (default: binflight)", takeFolder},
                {"frames=1..1000", "Frames whose cull time is measured at each pose (default: 15)",
                 wholeInto(frames, 1, 1000)},
                {"timeout=SECONDS", "Longest time that one pose may take (default: 120)",
                 numberInto(timeout, std::numeric_limits<double>::min(), 86400.0)}};
    }
};

}  // namespace osgAnalyticBin::flight
