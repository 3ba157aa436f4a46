// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileTree.h"

#include <vector>

namespace osgAnalyticBin::paper {

/// A tree and the frustum that it is culled by.
struct TimedTree {
    TileTree tree;
    Frustum frustum;
};

/// The time of a test, the recursion included: all trees are culled one after the other, several times over, and the
/// fastest time round counts. Bins are prepared beforehand, as in a database.
[[nodiscard]] double nanosecondsPerTile(const std::vector<TimedTree>& trees, Method method);

}  // namespace osgAnalyticBin::paper
