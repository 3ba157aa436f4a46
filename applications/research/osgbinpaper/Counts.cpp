// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Counts.h"

#include <numeric>

namespace osgAnalyticBin::paper {

void Counts::add(const Counts& other) noexcept {
    for (const CountColumn& column : kCountColumns) this->*column.count += other.*column.count;
}

Counts sumOf(const LevelCounts& levels) noexcept {
    Counts sum;
    for (const Counts& counts : levels) sum.add(counts);
    return sum;
}

void ViewResult::add(const ViewResult& other) noexcept {
    cameras += other.cameras;
    for (std::size_t level = 0; level < leaves.size(); ++level) {
        for (std::size_t method = 0; method < kMethods; ++method)
            methods[method][level].add(other.methods[method][level]);
        leaves[level] += other.leaves[level];
        seenLeaves[level] += other.seenLeaves[level];
    }
}

std::uint64_t ViewResult::seen() const noexcept {
    return std::accumulate(seenLeaves.begin(), seenLeaves.end(), std::uint64_t{0});
}

}  // namespace osgAnalyticBin::paper
