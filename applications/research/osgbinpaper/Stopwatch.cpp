// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Stopwatch.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace osgAnalyticBin::paper {

double nanosecondsPerTile(const std::vector<TimedTree>& trees, Method method) {
    using Clock = std::chrono::steady_clock;
    constexpr int kRounds = 9;
    std::vector<std::vector<Verdict>> verdicts;
    for (const TimedTree& tree : trees) verdicts.emplace_back(tree.tree.tiles.size(), Verdict::Untested);
    double fastest = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
        const Clock::time_point start = Clock::now();
        for (std::size_t i = 0; i < trees.size(); ++i) cull(trees[i].tree, trees[i].frustum, method, verdicts[i]);
        fastest = std::min(fastest, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    }
    std::ptrdiff_t tested = 0;
    for (const std::vector<Verdict>& tree : verdicts) tested += std::count_if(tree.begin(), tree.end(), isTested);
    return tested > 0 ? fastest / static_cast<double>(tested) : 0.0;
}

}  // namespace osgAnalyticBin::paper
