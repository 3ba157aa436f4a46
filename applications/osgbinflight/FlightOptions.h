// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

namespace osgAnalyticBin::flight {

/// How a camera path is flown.
struct FlightOptions {
    std::string out = "binflight";  ///< folder of the pictures and of poses.csv; made if missing
    int frames = 15;                ///< frames whose cull time is measured at each pose, 1 to 1000
    double timeout = 120.0;         ///< seconds that one pose may take to load and draw
};

/// Reads "out=DIR,frames=15,timeout=120" into `options`. A folder's name may hold blanks, but no comma.
/// Returns: false, with one line in `error`, when an item is unknown or malformed.
[[nodiscard]] bool applyParameters(const std::string& parameters, FlightOptions& options, std::string& error);

/// The same from a plugin option string, whose items are parted by blanks and commas; because every plugin reads that
/// string, items that are not ours are passed over.
[[nodiscard]] bool applyOptionString(const std::string& optionString, FlightOptions& options, std::string& error);

}  // namespace osgAnalyticBin::flight
