// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Description.h"

#include <support/Random.h>

namespace osgAnalyticBin::test {

/// A random view of a scene in a frame: of its parts more often than of anything else.
[[nodiscard]] ViewSpec randomView(Random& random, const Description& description, int frame);

/// The view that a camera has a frame later, if it goes on a little and turns a little.
[[nodiscard]] ViewSpec nextView(Random& random, const ViewSpec& view);

}  // namespace osgAnalyticBin::test
