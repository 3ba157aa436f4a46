// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Diagram.h"
#include "Figures.h"
#include "Settings.h"
#include "Table.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

// `poses` are the names of the methods' rows; empty: of flights.

/// One line for each pose and method, after a line of column names.
[[nodiscard]] std::string csvOf(const std::vector<std::string>& poses, const std::vector<MethodFigures>& methods);

/// An object: how it was measured; "methods", by name, with sums over the poses or the flight; of poses also "paths",
/// by name, with "methods" as above over the poses of one path, "by_pose", by method and column, what was measured at
/// each of "pose_names". "interrupted" is there after Ctrl-C: what was measured until then.
[[nodiscard]] std::string jsonOf(const Settings& settings, const std::vector<std::string>& poses,
                                 const std::vector<MethodFigures>& methods);

/// Sums for people, with times over those of "oracle" where that was measured, then their ratios to "sphere" and
/// "cluster" where these were flown, then the most telling sums path by path, if there are several.
[[nodiscard]] std::vector<report::TextTable> tablesOf(const std::vector<std::string>& poses,
                                                      const std::vector<MethodFigures>& methods);

/// Tiles drawn, files requested and cull time by method, path by path.
/// The reference method is left out where there are others: it dwarfs them all.
/// Requires: figures for each of the poses, of one method at least.
[[nodiscard]] std::vector<report::Diagram> diagramsOf(const std::vector<std::string>& poses,
                                                      const std::vector<MethodFigures>& methods);

/// One below the other.
void print(std::ostream& output, const std::vector<report::TextTable>& tables);

/// Whether bins are worth it for a database, in three sentences: tiles drawn, files and cull time against the better of
/// spheres and cluster callbacks; and where they do not help. Empty where bins, or both of the others, were not
/// measured. Requires: figures for each of the poses.
[[nodiscard]] std::vector<std::string> adviceOf(const std::vector<std::string>& poses,
                                                const std::vector<MethodFigures>& methods);

}  // namespace osgAnalyticBin::bench
