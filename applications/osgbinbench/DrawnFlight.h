// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CullMethod.h"
#include "Figures.h"
#include "MethodScene.h"
#include "Settings.h"

#include <vector>

namespace osgAnalyticBin::bench {

/// Flies every method along a path in a viewer that draws, with paging live, one frame after the other as fast as they
/// come. Each method flies the whole path from the root file alone, several times; the methods take turns flight by
/// flight, starting with another one each round. The reference and the oracle are left out, with one line that says so.
/// Throws: Failure when the database cannot be read, or there is nothing to draw on. Progress goes to stderr.
[[nodiscard]] std::vector<DrawnFigures> flyDrawn(const Settings& settings, const std::vector<CullMethod>& methods,
                                                 const std::vector<flight::CameraPose>& frames, FileWatch& watch);

}  // namespace osgAnalyticBin::bench
