// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Random scenes, and their parts.

#pragma once

#include "Description.h"

namespace osgAnalyticBin::test {

/// A random scene: the same for the same seed on every machine.
[[nodiscard]] Description randomDescription(std::uint64_t seed);

/// A random database; `number`: of the scene's.
[[nodiscard]] DatabaseSpec randomDatabase(Random& random, int number);

/// Random options that promise to cull nothing that is seen, and declare nothing false of the database.
[[nodiscard]] CullOptions randomOptions(Random& random, const DatabaseSpec& database);

/// A tile that the database shows at some time.
[[nodiscard]] TileKey randomTile(Random& random, const DatabaseSpec& database, int number, int level);

/// Altitude, in metres, within stored bins and below the heights that any options of randomOptions() declare.
[[nodiscard]] double highestWithinBins(const DatabaseSpec& database);

/// Adds what applications do with meshes, states, callbacks, files and visitors: one or two subjects for a scene, each
/// with parts that go together. `frames`: of the scene.
void addApplication(Random& random, Description& description, int frames);

/// Adds a pick in some frame, a vertical line somewhere.
void addPick(Random& random, Description& description, int frames);

/// A random view of a scene in a frame: of its parts more often than of anything else.
[[nodiscard]] ViewSpec randomView(Random& random, const Description& description, int frame);

/// The view that a camera has a frame later, if it goes on a little and turns a little.
[[nodiscard]] ViewSpec nextView(Random& random, const ViewSpec& view);

}  // namespace osgAnalyticBin::test
