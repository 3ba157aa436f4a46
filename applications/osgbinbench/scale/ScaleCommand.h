// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Failure.h"

namespace osgAnalyticBin::scale {

/// `osgbinbench scale`: measures how culling scales with depth and with tiles in memory.
/// `argv[0]` is the name of the command. Returns: the exit code. Throws: Failure, UsageError.
[[nodiscard]] support::ExitCode run(int argc, char** argv);

}  // namespace osgAnalyticBin::scale
