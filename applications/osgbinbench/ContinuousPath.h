// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"

#include <vector>

namespace osgAnalyticBin::bench {

/// A continuous flight from the first pose of a path to the last, its time evenly divided into frames: eye and look
/// point run along great circles, altitudes above zero, fields of view, near and far grow by equal ratios, roll and the
/// way of the eye aside by equal steps. Poses without times, all 0, are taken to be a second apart.
/// Requires: a path with a pose; frames > 0. Returns: that many poses, the path's first and last among them (with one
/// frame the first alone), without names.
[[nodiscard]] std::vector<flight::CameraPose> continuousPath(const std::vector<flight::CameraPose>& path, int frames);

}  // namespace osgAnalyticBin::bench
