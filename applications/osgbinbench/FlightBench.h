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

/// Flies every method once along a path with paging live: frame after frame at the settings' rate, whether the files
/// wanted have come or not. Methods take turns of some frames each, starting with another one every time; in the turns
/// of others a method's pager and clock stand still. Frames are culled, not drawn, as drawing by software would set
/// the pace. The oracle is left out, with one line that says so. How many files a flight takes depends on the machine
/// too. Throws: Failure when the database cannot be read. Progress goes to stderr.
[[nodiscard]] std::vector<MethodFigures> flyContinuously(const Settings& settings,
                                                         const std::vector<CullMethod>& methods,
                                                         const std::vector<flight::CameraPose>& frames,
                                                         FileWatch& watch);

/// Has every method jump from pose to pose with paging live, from the root file alone on, and stand at each until
/// nothing is missing. Methods take turns, pose by pose. Throws: Failure also when a pose takes longer than the
/// timeout.
[[nodiscard]] std::vector<MethodFigures> jump(const Settings& settings, const std::vector<CullMethod>& methods,
                                              const std::vector<flight::CameraPose>& poses, FileWatch& watch);

/// Flies every method along a path in a viewer that draws, with paging live, one frame after the other as fast as they
/// come. Each method flies the whole path from the root file alone, several times; the methods take turns flight by
/// flight, starting with another one each round. The reference and the oracle are left out, with one line that says so.
/// Throws: Failure when the database cannot be read, or there is nothing to draw on. Progress goes to stderr.
[[nodiscard]] std::vector<MethodFigures> flyDrawn(const Settings& settings, const std::vector<CullMethod>& methods,
                                                  const std::vector<flight::CameraPose>& frames, FileWatch& watch);

}  // namespace osgAnalyticBin::bench
