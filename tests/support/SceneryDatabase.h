// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>

namespace osgAnalyticBin::test {

/// Writes a paged database in the manner of FlightGear's scenery: 8 x 6 tiles of 0.25 x 0.125 degrees north of the
/// equator and east of the zero meridian, each with a coarse mesh in the root file and a file of its own. What is in
/// the file is one transform with a mesh of 17 x 17 posts, hills of some 300 m, and on it woods (levels of detail
/// within each other), houses (a level and a transform each), a switch, billboards, on every fourth tile a runway with
/// its lights and a light source, and on every fifth a transform that says that it moves. Nothing of it has a stored
/// bin. Returns: the database's file; empty when it cannot be written.
[[nodiscard]] std::string writeSceneryDatabase(const std::string& folder);

}  // namespace osgAnalyticBin::test
