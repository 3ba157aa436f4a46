// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {

/// Whether there is such a database: "synthetic" and "bindem" always, VirtualPlanetBuilder's "terrain" and "polygonal"
/// where samples of them are.
[[nodiscard]] bool isAtHand(const std::string& kind);

/// Writes a database of that kind. Returns: its root file; empty when that fails.
[[nodiscard]] std::string makeDatabase(const std::string& kind, const TemporaryFolder& folder);

}  // namespace osgAnalyticBin::test
