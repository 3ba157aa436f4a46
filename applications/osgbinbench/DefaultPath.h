// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "MethodScene.h"

#include <vector>

namespace osgAnalyticBin::bench {

/// A camera path around a database that has none, made from its extents: the whole of it from above (overview), down
/// onto the place with the highest terrain from four sides (oblique), level across the ground there (low), and a turn
/// of the head there (turning). OSG computes near and far planes, as in the stock osgviewer.
/// Throws: Failure when the database cannot be read or has no tiles, Interrupted. Progress goes to stderr.
[[nodiscard]] std::vector<flight::CameraPose> defaultPath(const Settings& settings, FileWatch& watch);

}  // namespace osgAnalyticBin::bench
