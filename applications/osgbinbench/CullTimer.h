// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "MethodScene.h"

#include <memory>
#include <vector>

namespace osgAnalyticBin::bench {

/// How long one cull traversal takes, milliseconds.
struct CullTime {
    double firstQuartile = 0.0;
    double median = 0.0;
    double spread = 0.0;  ///< from the first quartile to the third
};

/// The same with the data caches as the traversal before has left them, and as others have.
struct CullTimes {
    CullTime warm;
    CullTime cold;  ///< 0 where it was not measured
};

/// Times osgUtil's cull traversal and the sorting of what it finds, of every scene at its present pose. The
/// scenes take turns, starting with another one each round, so that what slows the machine down slows all of them;
/// every turn begins with traversals that are not timed, and every fourth, from the first on, ends with one after
/// `flushMebibytes` of other memory were touched, as drawing a frame between two cull traversals does; 0: without that
/// one. Requires: a viewer at rest. Returns: the times of each scene. Throws: Interrupted.
[[nodiscard]] std::vector<CullTimes> cullTimes(const std::vector<std::unique_ptr<MethodScene>>& scenes, int rounds,
                                               int flushMebibytes);

}  // namespace osgAnalyticBin::bench
