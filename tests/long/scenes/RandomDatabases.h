// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Description.h"

#include <support/Random.h>

namespace osgAnalyticBin::test {

/// A random database; `number`: of the scene's.
[[nodiscard]] DatabaseSpec randomDatabase(Random& random, int number);

/// Random options that promise to cull nothing that is seen, and declare nothing false of the database.
[[nodiscard]] CullOptions randomOptions(Random& random, const DatabaseSpec& database);

/// A tile that the database shows at some time.
[[nodiscard]] TileKey randomTile(Random& random, const DatabaseSpec& database, int number, int level);

/// Altitude, in metres, that stays below the heights that any options of randomOptions() declare, and within stored
/// bins.
[[nodiscard]] double highestWithinBins(const DatabaseSpec& database);

}  // namespace osgAnalyticBin::test
