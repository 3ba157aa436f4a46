// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Handlers.h"

#include <osgViewer/Viewer>

#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

/// Runs a viewer without a camera manipulator by a script, for pictures: see --steps. `poses` may be empty.
/// Throws: std::runtime_error with one line for a step that cannot be understood or done.
void runSteps(osgViewer::Viewer& viewer, SpyViewHandler& spy, const std::vector<flight::CameraPose>& poses,
              const std::string& text);

}  // namespace osgAnalyticBin::viewer
