// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin::test {

/// Registers BM_Occlusion: outlines, columns and picture of random terrain, time for each of its tiles.
/// Returns: false when a tile is hidden that a ray reaches.
[[nodiscard]] bool addOcclusionBenchmark();

}  // namespace osgAnalyticBin::test
