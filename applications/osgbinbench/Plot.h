// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Diagram.h"
#include "Figures.h"

#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

using report::Diagram;
using report::plot;

/// Tiles drawn, files requested and cull time by method, path by path, and tiles, triangles and files pose by pose.
/// The reference method is left out where there are others: it dwarfs them all.
/// Requires: figures for each of the poses, of one method at least.
[[nodiscard]] std::vector<Diagram> diagramsOf(const std::vector<std::string>& poses,
                                              const std::vector<MethodFigures>& methods);

}  // namespace osgAnalyticBin::bench
