// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Diagram.h"
#include "Experiment.h"

#include <vector>

namespace osgAnalyticBin::paper {

/// figure1: a bin in both of its coordinate systems; figure2: a bin that straddles a side of the frustum, and the
/// ranges of its distances to the sides; figure3: the 128 start tiles and their heights; figure4: the recursion on a
/// map; figure5: the terrain of the tiles drawn, with their outlines; wrong_cull_corners, wrong_cull_paper: the tile,
/// the frustum and the witness, where the cameras met such a cull. Their gnuplot commands are in the folder figures.
[[nodiscard]] std::vector<report::Diagram> figuresOf(Terrain& terrain, const Results& results);

}  // namespace osgAnalyticBin::paper
