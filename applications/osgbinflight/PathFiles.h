// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraView.h"

#include <functional>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// Reads camera paths, one file or more, and joins them to one path: the first pose of each is one second after the
/// last of the file before. A file that ends in .path is an animation path of OpenSceneGraph, as key z of its viewers
/// records it: of that, a pose every half second while the camera moves, with their field of view, 29.15 degrees. All
/// others are read by readCameraPath(). `globe`: asked for with the first .path, which is given in world coordinates.
/// Throws: Failure when a file cannot be opened, or is broken, or two share a pose's name.
[[nodiscard]] std::vector<CameraPose> readCameraPathFiles(const std::vector<std::string>& fileNames,
                                                          const std::function<Globe()>& globe);

/// The same of files over a globe, none of them a .path.
[[nodiscard]] std::vector<CameraPose> readCameraPathFiles(const std::vector<std::string>& fileNames);

}  // namespace osgAnalyticBin::flight
