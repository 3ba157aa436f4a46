// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CullMethod.h"
#include "Figures.h"
#include "Settings.h"

#include <vector>

namespace osgAnalyticBin::bench {

/// Flies every method, one after the other, once along a path with the pager loading as it can: frame after frame at
/// the settings' rate, or slower where drawing takes longer. How many files that takes depends on the machine too.
/// Throws: Failure when the database cannot be read or there is nothing to draw on. Progress goes to stderr.
[[nodiscard]] std::vector<FlightFigures> flyContinuously(const Settings& settings,
                                                         const std::vector<CullMethod>& methods,
                                                         const std::vector<flight::CameraPose>& frames);

}  // namespace osgAnalyticBin::bench
