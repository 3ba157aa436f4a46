// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Bench.h"
#include "Failure.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// Reads flights over one database along one path, each with a culling method, as binflight leaves them in folders, and
/// compares their pictures with those of the first, the reference.
/// Returns: methods with the folders' names; columns as in poses.csv, and differing_pixels.
/// Throws: Failure when a flight is missing or broken, or its poses are not the reference's.
[[nodiscard]] Measurement readFlights(const std::vector<std::string>& folders);

/// A line for each picture that should not differ from the reference's but does: of all methods but "paper" and
/// "corners".
[[nodiscard]] std::vector<std::string> mismatchesOf(const Measurement& flown);

/// `osgbinbench report`: compares flights over a database that binflight left.
/// `argv[0]` is the name of the command. Returns: the exit code. Throws: Failure, UsageError.
[[nodiscard]] support::ExitCode runReport(int argc, char** argv);

}  // namespace osgAnalyticBin::bench
