// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// Writes a paged globe with stored bins: 8 x 4 tiles of 45 degrees, and two finer levels in files of four tiles.
/// Tiles are 17 x 17 posts on the default ellipsoid with smooth hills of +- 3 km.
/// Returns: the database's file; empty when it cannot be written.
[[nodiscard]] std::string writeSyntheticDatabase(const std::string& folder);

}  // namespace osgAnalyticBin::test
