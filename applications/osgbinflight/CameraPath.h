// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// One stop of a camera path. Radians and metres.
struct CameraPose {
    std::string name;  ///< letters, digits, `_` and `-`: it names the picture's file too
    core::Geodetic eye;
    core::Geodetic look;  ///< a point on the line of sight
    double verticalFov = 0.0;
    double nearPlane = 0.0;
    double farPlane = 0.0;
};

/// Reads a camera path: comma-separated values with the columns name, eyeLatDeg, eyeLonDeg, eyeAlt, lookLatDeg,
/// lookLonDeg, lookAlt, fovDeg, near, far in any order. Angles are in degrees, the rest in metres, altitudes above the
/// ellipsoid. `#` starts a comment line. The file name only serves the messages.
/// Returns: at least one pose; nullopt, with one line in `error` that names the file and the line, when a column is
/// missing or unknown, a number is malformed or out of range, a name is used twice, or there is no pose.
[[nodiscard]] std::optional<std::vector<CameraPose>> readCameraPath(std::istream& input, const std::string& fileName,
                                                                    std::string& error);

/// Opens and reads a file.
[[nodiscard]] std::optional<std::vector<CameraPose>> readCameraPathFile(const std::string& fileName,
                                                                        std::string& error);

}  // namespace osgAnalyticBin::flight
