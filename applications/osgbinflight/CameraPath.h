// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// One stop of a camera path. Radians and metres.
struct CameraPose {
    std::string name;          ///< letters, digits, `_` and `-`: it names the picture's file too
    core::Geodetic eye;        ///< where the camera stands
    core::Geodetic look;       ///< a point on the line of sight
    double verticalFov = 0.0;  ///< the whole angle
    double nearPlane = 0.0;    ///< from the eye along the line of sight; 0: OSG computes near and far planes
    double farPlane = 0.0;     ///< as nearPlane
    double time = 0.0;         ///< seconds
    double roll = 0.0;         ///< of up, clockwise about the line of sight, from the local vertical
    /// How far the eye stands to the right of `eye`: the view's direction stays, the frustum is sheared so that the
    /// plane through the look point is shown unchanged. Plus and minus half a base make a stereo pair.
    double eyeRight = 0.0;

    [[nodiscard]] bool hasPlanes() const { return farPlane > 0.0; }
};

/// Reads a camera path: comma-separated values with the columns name, eyeLatDeg, eyeLonDeg, eyeAlt, lookLatDeg,
/// lookLonDeg, lookAlt, fovDeg in any order, and, where wanted, near and far (without both OSG computes these planes),
/// time (seconds, growing; without it each pose is one second after the one before, from 0), rollDeg and eyeRight (both
/// 0 without). Angles are in degrees, the rest in metres, altitudes above the ellipsoid. For a map eyeX, eyeY, lookX
/// and lookY, in map units, stand for longitudes and latitudes (core::Ellipsoid::plane()). `#` starts a comment line.
/// The file name is used in messages only. Returns: at least one pose. Throws: Failure that names the file and the
/// line, when a column is missing or unknown, a number is malformed or out of range, time does not grow, a name is used
/// twice, or there is no pose.
[[nodiscard]] std::vector<CameraPose> readCameraPath(std::istream& input, const std::string& fileName);

/// A continuous flight from the first pose of a path to the last, its time evenly divided into frames: eye and look
/// point run along great circles, altitudes above zero, fields of view, near and far grow by equal ratios, roll and the
/// way of the eye aside by equal steps.
/// Requires: a path with a pose; frames > 0. Returns: that many poses, the path's first and last among them (with one
/// frame the first alone), without names.
[[nodiscard]] std::vector<CameraPose> continuousPath(const std::vector<CameraPose>& path, int frames);

/// From each pose of a path a flight straight ahead: eye and look point move by `step` radians a frame along the great
/// circle through both (north where the view goes straight down), at their altitudes. Requires: frames > 0. Returns:
/// that many poses for each one, itself the first of them, without names.
[[nodiscard]] std::vector<CameraPose> flightsAhead(const std::vector<CameraPose>& path, int frames, double step);

}  // namespace osgAnalyticBin::flight
