// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Figures.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// Whether bins are worth it for a database, in three sentences: tiles drawn, files and cull time against the better of
/// spheres and cluster callbacks; and where they do not help. Empty where bins, or both of the others, were not
/// measured. Requires: figures for each of the poses.
[[nodiscard]] std::vector<std::string> adviceOf(const std::vector<std::string>& poses,
                                                const std::vector<MethodFigures>& methods);

}  // namespace osgAnalyticBin::bench
