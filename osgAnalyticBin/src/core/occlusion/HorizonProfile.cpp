// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kernels/OcclusionKernels.h"

#include <osgAnalyticBin/core/occlusion/HorizonProfile.h>

#include <algorithm>
#include <utility>

namespace osgAnalyticBin::core {

using kernels::WallRow;

HorizonProfile::HorizonProfile(HorizonBuffer buffer) : _buffer(std::move(buffer)) {
    constexpr std::size_t kStrips = HorizonBuffer::kStrips;
    std::vector<HorizonBuffer::Waiting>& walls = _buffer._walls;
    std::sort(walls.begin(), walls.end(),
              [](const auto& a, const auto& b) { return a.wall[WallRow::Farthest] < b.wall[WallRow::Farthest]; });
    std::array<double, kStrips> lower, upper;
    lower.fill(kernels::kInfinity);
    upper.fill(-kernels::kInfinity);
    std::vector<std::pair<std::size_t, Step>> steps;  // with their strips, by distance
    for (const auto& [wall, next] : walls) {
        const auto [first, last] = _buffer.stripsOf(wall);
        const auto lowerBefore = lower, upperBefore = upper;
        kernels::activeOcclusion.raise(_buffer._picture, wall.data(), first, last, lower.data(), upper.data());
        for (std::size_t i = first; i < last; ++i) {
            if (lower[i] == lowerBefore[i] && upper[i] == upperBefore[i]) continue;
            steps.push_back({i, {wall[WallRow::Farthest], {lower[i], upper[i]}}});
            ++_first[i + 1];
        }
    }
    for (std::size_t i = 0; i < kStrips; ++i) _first[i + 1] += _first[i];
    _steps.resize(steps.size());
    auto end = _first;
    for (const auto& [strip, step] : steps) _steps[end[strip]++] = step;
}

bool HorizonProfile::hides(const HorizonBuffer::Outline& body) const noexcept {
    // written so that NaN is not hidden
    if (body.isBeside || !(body.nearest > _buffer._picture.eyes[1]) || !isAboveLowest(body)) return false;
    const double farthest = _buffer.farthestBefore(body);
    const auto [first, last] = _buffer.stripsOf(body);
    for (std::size_t i = first; i < last; ++i) {
        const Step *const begin = _steps.data() + _first[i], *const end = _steps.data() + _first[i + 1];
        // the upper end grows with the distance
        if (begin == end || !(body.heights.upper <= end[-1].heights.upper)) return false;
        const Step* const behind = std::upper_bound(
            begin, end, farthest, [](double distance, const Step& step) { return distance < step.farthest; });
        if (behind == begin) return false;
        const Interval& covered = behind[-1].heights;
        if (!(covered.lower <= body.heights.lower && body.heights.upper <= covered.upper)) return false;
    }
    return first < last;
}

}  // namespace osgAnalyticBin::core
