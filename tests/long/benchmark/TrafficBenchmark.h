// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin::test {

/// Registers BM_HiddenByTerrain, the question of one model whether terrain hides it. Returns: whether its answers are
/// right.
[[nodiscard]] bool addTrafficBenchmark();

}  // namespace osgAnalyticBin::test
