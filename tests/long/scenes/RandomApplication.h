// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Description.h"

#include <support/Random.h>

namespace osgAnalyticBin::test {

/// Adds what applications do with meshes, states, callbacks, files and visitors: one or two subjects for a scene, each
/// with parts that go together. `frames`: of the scene.
void addApplication(Random& random, Description& description, int frames);

/// Adds a pick in some frame, a vertical line somewhere.
void addPick(Random& random, Description& description, int frames);

}  // namespace osgAnalyticBin::test
