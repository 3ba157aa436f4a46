// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../kernels/OcclusionKernels.h"
#include "../kernels/PlaneKernels.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace osgAnalyticBin::core {

using kernels::kInfinity;
using kernels::WallRow;

HorizonBuffer::HorizonBuffer(double eyeToCentre, const Interval& across, double drawing, double depthStep,
                             const glm::dvec3& eyes)
    : _picture{eyeToCentre,  across.lower,
               across.upper, across.width() / static_cast<double>(kStrips),
               drawing,      {eyes.x, eyes.y, eyes.z}},
      _perStep(1.0 / _picture.step),
      _depthStep(depthStep) {
    static_assert(kStrips == kernels::StripNumbers::kStrips && std::tuple_size_v<Wall> == WallRow::kCount);
    coverNothing();
    _lists.fill(kNone);
    _walls.reserve(1024);
}

void HorizonBuffer::add(const EarthColumns& columns, std::uint32_t owner) {
    constexpr std::size_t kMost = EarthColumns::kMost;
    static_assert(kMost % kernels::kMostLanes == 0);
    std::array<double, WallRow::kCount * kMost> rows;
    const kernels::Walls walls = kernels::activeOcclusion.walls(
        _picture, {columns.corners.data(), columns.error.data(), kMost, columns.size}, rows.data());
    _nearestEarth2 = std::min(_nearestEarth2, walls.nearest2);
    for (std::uint64_t left = walls.bits; left != 0; left &= left - 1) {
        const double* const numbers = rows.data() + firstBit(left);
        Wall wall;
        for (std::size_t row = 0; row < WallRow::kCount; ++row) wall[row] = numbers[row * kMost];
        const Strips strips = stripsOf(wall);
        // what is no higher than earth in front of it covers nothing more
        if (strips.first >= strips.last || !isAboveKnown(strips, wall[WallRow::Highest])) continue;
        _walls.push_back({wall, kNone, owner});
        wait(_walls.back());
    }
}

void HorizonBuffer::coverNothing() {
    _lower.fill(kInfinity);
    _upper.fill(-kInfinity);
}

void HorizonBuffer::wait(Waiting& waiting) {
    const std::size_t range = rangeOf(waiting.wall[WallRow::Farthest]);
    waiting.next = std::exchange(_lists[range], static_cast<std::int32_t>(&waiting - _walls.data()));
    _nearestList = std::min(_nearestList, range);
}

void HorizonBuffer::restart(const std::vector<std::uint32_t>& without) {
    const auto isTakenAway = [&](const Waiting& waiting) {
        return std::find(without.begin(), without.end(), waiting.owner) != without.end();
    };
    _walls.erase(std::remove_if(_walls.begin(), _walls.end(), isTakenAway), _walls.end());
    coverNothing();
    _lists.fill(kNone);
    _firstSteps.clear();
    _reached = 0.0;
    for (Waiting& waiting : _walls) wait(waiting);
}

// The strips that lie wholly within a wall.
HorizonBuffer::Strips HorizonBuffer::stripsOf(const Wall& wall) const noexcept {
    constexpr double kRounding = 1e-6;  // of the strips' edges
    return {stripAt(wall[WallRow::From], 1.0 + kRounding), stripAt(wall[WallRow::To], -kRounding)};
}

// The strip with this x, or another as many strips to the right; kStrips: none.
std::size_t HorizonBuffer::stripAt(double x, double toRight) const noexcept {
    const double strip = (x - _picture.left) * _perStep + toRight;
    return static_cast<std::size_t>(std::clamp(strip, 0.0, static_cast<double>(kStrips)));
}

// Whether something of this height would stand above what is covered.
bool HorizonBuffer::isAboveKnown(const Strips& strips, double height) const noexcept {
    return kernels::activeOcclusion.isAbove(_upper.data(), strips.first, strips.last, height);
}

// The list of a distance. Each power of two has 64 of them; what is nearer than the first or farther than the last is
// in these.
std::size_t HorizonBuffer::rangeOf(double distance) noexcept {
    constexpr unsigned kFractionBits = 52, kListBits = 6;
    constexpr std::int64_t kFirst = (std::int64_t{1023} - 8) << kListBits;  // 2^-8
    std::int64_t bits;
    std::memcpy(&bits, &distance, sizeof bits);
    const std::int64_t range = (bits >> (kFractionBits - kListBits)) - kFirst;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(range, 0, kRanges - 1));
}

// Puts the walls that are no farther than `distance` into the strips.
void HorizonBuffer::use(double distance) {
    const std::size_t last = rangeOf(distance);
    for (std::size_t range = _nearestList; range <= last; ++range) {
        if (_lists[range] != kNone) useList(range, distance);
    }
    // farther walls may be left in the last list
    _nearestList = std::max(_nearestList, last);
}

void HorizonBuffer::useList(std::size_t range, double distance) {
    std::int32_t* from = &_lists[range];
    while (*from != kNone) {
        Waiting& waiting = _walls[static_cast<std::size_t>(*from)];
        if (waiting.wall[WallRow::Farthest] <= distance) {
            _reached = std::max(_reached, waiting.wall[WallRow::Farthest]);
            const Strips strips = stripsOf(waiting.wall);
            kernels::activeOcclusion.raise(_picture, waiting.wall.data(), strips.first, strips.last, _lower.data(),
                                           _upper.data());
            *from = waiting.next;
        } else {
            from = &waiting.next;
        }
    }
}

HorizonBuffer::Outline HorizonBuffer::outlineOf(const BinHull& body) const noexcept {
    static_assert(std::tuple_size_v<decltype(body.x)> == kernels::kMostLanes);
    kernels::OutlineData data;
    kernels::activeOcclusion.outline(_picture, {body.x.data(), body.y.data(), body.z.data(), body.reach}, data);
    return {data.nearest, {data.left, data.right}, {data.low, data.high}, std::sqrt(data.distance2), data.isBeside};
}

// Beyond the planes through the eye and the sides of the picture: as kernels::outlineOf().
bool HorizonBuffer::isBeside(const BinBall& ball) const noexcept {
    const double length = glm::length(ball.centre) + ball.radius;
    const double radius = ball.radius + 32.0 * kEpsilon * (_picture.eyeToCentre + length);
    const auto isBeyond = [&](double x, double side) {
        const double room = radius * std::hypot(1.0, x) + _picture.eyes[0] + std::abs(x) * _picture.eyes[1];
        return side * (ball.centre.x - x * ball.centre.y) > 1.001 * room;
    };
    return ball.centre.y < -(radius + _picture.eyes[1]) || isBeyond(_picture.left, -1.0) ||
           isBeyond(_picture.right, 1.0);
}

// A half-space r <= X f through the eye holds a ball if its centre is inside by radius * sqrt(1 + X²) and the motion of
// the eye. With X = x + q, sqrt(1 + X²) <= sqrt(1 + x²) + q: doc/theory/occlusion.md, section 8.
HorizonBuffer::Outline HorizonBuffer::outlineOf(const BinBall& ball) const noexcept {
    const double length = glm::length(ball.centre);
    const double radius = ball.radius + 32.0 * kEpsilon * (_picture.eyeToCentre + length + ball.radius);
    Outline outline{-kInfinity, {-kInfinity, kInfinity}, {-kInfinity, kInfinity}, length, false};
    // written so that NaN and infinite numbers tell nothing
    if (!(radius >= 0.0 && length <= kernels::kLargest && radius <= kernels::kLargest)) return outline;
    outline.nearest = ball.centre.y - radius;
    if (!(outline.nearest > _picture.eyes[1])) {
        outline.isBeside = isBeside(ball);
        return outline;
    }
    const double inverse = 1.0 / (ball.centre.y - radius - _picture.eyes[1]);
    const auto around = [&](double across, double eyes) {
        const double at = across / ball.centre.y, size = std::abs(at);
        const double metres = radius * std::sqrt(1.0 + at * at) + eyes + size * _picture.eyes[1];
        const double room = metres * inverse + 16.0 * kEpsilon * (1.0 + size) + _picture.drawing;
        return Interval{at - room, at + room};
    };
    outline.across = around(ball.centre.x, _picture.eyes[0]);
    outline.heights = around(ball.centre.z, _picture.eyes[2]);
    outline.isBeside = outline.across.upper < _picture.left || outline.across.lower > _picture.right;
    return outline;
}

// Earth up to here is nearer than the body by a step of the depth buffer. That is hardest for the eye that is farthest
// back.
double HorizonBuffer::farthestBefore(const Outline& body) const noexcept {
    const double ahead = _picture.eyes[1], fromBack = body.nearest + ahead;
    return fromBack / (1.0 + _depthStep * fromBack) - ahead;
}

// The strips that a body reaches into.
HorizonBuffer::Strips HorizonBuffer::stripsOf(const Outline& body) const noexcept {
    // the rounding of the quotient; that of the strips' edges is in the errors of the corners
    constexpr double kRoom = 1e-6;
    return {stripAt(body.across.lower, -kRoom), stripAt(body.across.upper, 1.0 + kRoom)};
}

bool HorizonBuffer::hides(const Outline& body) {
    const double farthest = farthestBefore(body);
    // written so that NaN is not hidden
    if (!(body.nearest > _picture.eyes[1] && farthest >= _reached)) return false;
    use(farthest);
    if (body.isBeside || !isAboveLowest(body)) return false;
    const Strips strips = stripsOf(body);
    return kernels::activeOcclusion.covers(_lower.data(), _upper.data(), strips.first, strips.last, body.heights.lower,
                                           body.heights.upper);
}

void HorizonBuffer::sort() {
    std::sort(_walls.begin(), _walls.end(),
              [](const Waiting& a, const Waiting& b) { return a.wall[WallRow::Farthest] < b.wall[WallRow::Farthest]; });
    coverNothing();
    _firstSteps.assign(kStrips + 1, 0);
    std::vector<std::pair<std::size_t, Step>> steps;  // with their strips, by distance
    for (const auto& [wall, next, owner] : _walls) {
        const auto [first, last] = stripsOf(wall);
        const auto lowerBefore = _lower, upperBefore = _upper;
        kernels::activeOcclusion.raise(_picture, wall.data(), first, last, _lower.data(), _upper.data());
        for (std::size_t i = first; i < last; ++i) {
            if (_lower[i] == lowerBefore[i] && _upper[i] == upperBefore[i]) continue;
            steps.push_back({i, {wall[WallRow::Farthest], {_lower[i], _upper[i]}}});
            ++_firstSteps[i + 1];
        }
    }
    for (std::size_t i = 0; i < kStrips; ++i) _firstSteps[i + 1] += _firstSteps[i];
    _steps.resize(steps.size());
    auto end = _firstSteps;
    for (const auto& [strip, step] : steps) _steps[end[strip]++] = step;
}

bool HorizonBuffer::hidesInAnyOrder(const Outline& body) const noexcept {
    // written so that NaN is not hidden
    if (body.isBeside || !(body.nearest > _picture.eyes[1]) || !isAboveLowest(body)) return false;
    const double farthest = farthestBefore(body);
    const auto [first, last] = stripsOf(body);
    for (std::size_t i = first; i < last; ++i) {
        const Step *const begin = _steps.data() + _firstSteps[i], *const end = _steps.data() + _firstSteps[i + 1];
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
