// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "MethodScene.h"

#include <memory>
#include <vector>

namespace osgAnalyticBin::bench {

/// How long one cull traversal takes, milliseconds.
struct CullTime {
    double median = 0.0;
    double spread = 0.0;  ///< from the first quartile to the third
};

/// Times osgUtil's cull traversal and the sorting of what it finds, of every scene at its present pose. The
/// scenes take turns, starting with another one each round, so that what slows the machine down slows all of them;
/// every turn begins with traversals that are not timed.
/// Requires: a viewer at rest. Returns: one time for each scene.
[[nodiscard]] std::vector<CullTime> cullTimes(const std::vector<std::unique_ptr<MethodScene>>& scenes, int rounds);

}  // namespace osgAnalyticBin::bench
