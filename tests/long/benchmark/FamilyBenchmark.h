// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin::test {

/// Registers BM_Family and BM_FamilyHalf: four siblings at once, on every instruction set of the machine.
/// Returns: false when a method culls what it must not.
[[nodiscard]] bool addFamilyBenchmarks();

}  // namespace osgAnalyticBin::test
