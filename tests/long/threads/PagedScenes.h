// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// The globe of writeSyntheticDatabase(), but with stored bins that are too low for the meshes in the files below the
/// root: they are widened when the tiles are loaded. Returns: the database's file; empty when it cannot be written.
[[nodiscard]] std::string writeFalseDatabase(const std::string& folder);

/// The globe of writeSyntheticDatabase() as osgTerrain tiles with 9 x 9 posts, without stored bins. Its root is an
/// osgTerrain::Terrain. Returns: the database's file; empty when it cannot be written.
[[nodiscard]] std::string writeTerrainDatabase(const std::string& folder);

}  // namespace osgAnalyticBin::test
