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
#include <tuple>
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
    _lower.fill(kInfinity);
    _upper.fill(-kInfinity);
    _lists.fill(kNone);
    _walls.reserve(512);
}

void HorizonBuffer::add(const EarthColumns& columns) {
    constexpr std::size_t kMost = EarthColumns::kMost;
    static_assert(kMost % kernels::kMostLanes == 0);
    std::array<double, WallRow::kCount * kMost> rows;
    const kernels::Walls walls = kernels::activeOcclusion.walls(
        _picture, {columns._corners.data(), columns._error.data(), kMost, columns._size}, rows.data());
    _nearestEarth2 = std::min(_nearestEarth2, walls.nearest2);
    for (std::uint64_t left = walls.bits; left != 0; left &= left - 1) {
        const double* const numbers = rows.data() + firstBit(left);
        Wall wall;
        for (std::size_t row = 0; row < WallRow::kCount; ++row) wall[row] = numbers[row * kMost];
        const Strips strips = stripsOf(wall);
        // what is no higher than earth in front of it covers nothing more
        if (strips.first >= strips.last || !isAboveKnown(strips, wall[WallRow::Highest])) continue;
        const std::size_t range = rangeOf(wall[WallRow::Farthest]);
        _walls.push_back({wall, std::exchange(_lists[range], static_cast<std::int32_t>(_walls.size()))});
        _nearestList = std::min(_nearestList, range);
    }
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

bool HorizonBuffer::hides(const Outline& body) {
    // Earth up to here is nearer than the body by a step of the depth buffer. That is hardest for the eye that is
    // farthest back.
    const double ahead = _picture.eyes[1], fromBack = body.nearest + ahead;
    const double farthest = fromBack / (1.0 + _depthStep * fromBack) - ahead;
    // written so that NaN is not hidden
    if (!(body.nearest > ahead && farthest >= _reached)) return false;
    use(farthest);
    if (body.isBeside || !(body.heights.lower >= _lowest)) return false;
    // the rounding of the quotient; that of the strips' edges is in the errors of the corners
    constexpr double kRoom = 1e-6;
    const std::size_t first = stripAt(body.across.lower, -kRoom), last = stripAt(body.across.upper, 1.0 + kRoom);
    return kernels::activeOcclusion.covers(_lower.data(), _upper.data(), first, last, body.heights.lower,
                                           body.heights.upper);
}

}  // namespace osgAnalyticBin::core
