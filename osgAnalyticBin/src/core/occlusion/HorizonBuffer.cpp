// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The rounding of a vector from the eye, in units of the longest vector from the centre.
constexpr double kVectorRounding = 16.0 * kEpsilon;

// The error of a position in the picture, for a point that is wrong by `metres`; doc/occlusion.md, section 4.
double pictureError(double metres, double forward, double largest) {
    return metres / (forward - metres) * (1.0 + largest) + 16.0 * kEpsilon * (1.0 + largest);
}

bool isEmpty(const Interval& interval) {
    return !(interval.lower <= interval.upper);
}

}  // namespace

HorizonBuffer::HorizonBuffer(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up,
                             const Interval& across)
    : _eye(eye),
      _forward(forward),
      _right(glm::cross(forward, up)),
      _up(up),
      _across(across),
      _step(across.width() / static_cast<double>(kStrips)),
      _lowest(-kInfinity) {
    _covered.fill({kInfinity, -kInfinity});
}

double HorizonBuffer::forwardOf(const glm::dvec3& ecef) const noexcept {
    return glm::dot(ecef - _eye, _forward);
}

HorizonBuffer::Spot HorizonBuffer::spotOf(const glm::dvec3& ecef) const noexcept {
    const glm::dvec3 from = ecef - _eye;
    const double forward = forwardOf(ecef);
    return {glm::dot(from, _right) / forward, glm::dot(from, _up) / forward};
}

double HorizonBuffer::nearest(const BinHull& body) const noexcept {
    double nearest = kInfinity;
    for (const glm::dvec3& corner : body.corners) nearest = std::min(nearest, forwardOf(corner));
    return nearest - body.reach;
}

void HorizonBuffer::add(const EarthColumn& column) {
    constexpr double kSteepest = 1e3;
    Pending earth{0.0, {}, {}, 0.0};
    double nearest = kInfinity, left = kInfinity, right = -kInfinity, largest = 0.0;
    double size = glm::length(_eye);
    for (std::size_t i = 0; i < 4; ++i)
        size = std::max({size, glm::length(column.top[i]), glm::length(column.bottom[i])});
    const double error = column.error + kVectorRounding * size;
    if (!(column.error >= 0.0)) return;
    const auto place = [&](const glm::dvec3& corner, Spot& spot) {
        const double forward = forwardOf(corner);
        spot = spotOf(corner);
        nearest = std::min(nearest, forward);
        earth.farthest = std::max(earth.farthest, forward + error);
        left = std::min(left, spot.x);
        right = std::max(right, spot.x);
        largest = std::max({largest, std::abs(spot.x), std::abs(spot.y)});
        // written so that NaN is left out; rays near the picture's plane would make positions as large as one likes
        return forward > 4.0 * error && std::abs(spot.x) < kSteepest && std::abs(spot.y) < kSteepest;
    };
    for (std::size_t i = 0; i < 4; ++i) {
        if (!place(column.top[i], earth.top[i]) || !place(column.bottom[i], earth.bottom[i])) return;
    }
    if (!(right - left > _step) || right < _across.lower || left > _across.upper) return;
    earth.error = pictureError(error, nearest, largest);
    // a chord is at least a strip long: the error of its ends has to be small in comparison
    if (!(earth.error < 0.01 * _step)) return;
    _pending.push_back(earth);
    std::push_heap(_pending.begin(), _pending.end());
}

// Both intervals are covered; where they meet, so is what they cover together, and else only the higher one is kept.
void HorizonBuffer::cover(std::size_t strip, const Interval& heights) {
    Interval& known = _covered[strip];
    const bool meet = !isEmpty(known) && heights.lower <= known.upper && known.lower <= heights.upper;
    if (meet) {
        known = {std::min(known.lower, heights.lower), std::max(known.upper, heights.upper)};
    } else if (isEmpty(known) || heights.upper > known.upper) {
        known = heights;
    }
}

// A column of earth is convex and so is its picture: at each x it has all between what a chord of its bottom and a
// chord of its top have there. doc/occlusion.md, section 4.
void HorizonBuffer::raise(const Pending& earth) {
    struct Chord {
        double left, right, slope, start, room;
    };
    std::array<Chord, 12> chords{};
    std::size_t count = 0, topCount = 0;
    double left = kInfinity, right = -kInfinity;
    for (const auto* corners : {&earth.top, &earth.bottom}) {
        for (const Spot& a : *corners) {
            for (const Spot& b : *corners) {
                const double from = a.x + earth.error, to = b.x - earth.error;
                if (!(to - from >= _step)) continue;
                const double slope = (b.y - a.y) / (b.x - a.x);
                chords[count++] = {from, to, slope, a.y - slope * a.x, 2.0 * earth.error * (1.0 + std::abs(slope))};
                left = std::min(left, from);
                right = std::max(right, to);
            }
        }
        if (corners == &earth.top) topCount = count;
    }
    if (count == 0) return;
    const auto stripAt = [this](double strips) {
        return static_cast<std::size_t>(std::clamp(strips, 0.0, static_cast<double>(kStrips)));
    };
    const std::size_t last = stripAt(std::floor((right - _across.lower) / _step));
    for (std::size_t strip = stripAt(std::ceil((left - _across.lower) / _step)); strip < last; ++strip) {
        const double x0 = edge(strip), x1 = edge(strip + 1);
        Interval heights{kInfinity, -kInfinity};
        for (std::size_t i = 0; i < count; ++i) {
            const Chord& chord = chords[i];
            if (!(chord.left <= x0 && x1 <= chord.right)) continue;
            const double y0 = chord.start + chord.slope * x0, y1 = chord.start + chord.slope * x1;
            if (i < topCount) {
                heights.upper = std::max(heights.upper, std::min(y0, y1) - chord.room);
            } else {
                heights.lower = std::min(heights.lower, std::max(y0, y1) + chord.room);
            }
        }
        if (!isEmpty(heights)) cover(strip, heights);
    }
}

bool HorizonBuffer::hides(const BinHull& body) {
    double size = glm::length(_eye);
    for (const glm::dvec3& corner : body.corners) size = std::max(size, glm::length(corner));
    const double rounding = kVectorRounding * size;
    const double near = nearest(body) - rounding;
    if (!(near > 0.0 && body.reach >= 0.0) || near < _reached) return false;
    while (!_pending.empty() && _pending.front().farthest <= near) {
        std::pop_heap(_pending.begin(), _pending.end());
        _reached = std::max(_reached, _pending.back().farthest);
        raise(_pending.back());
        _pending.pop_back();
    }
    Interval across{kInfinity, -kInfinity}, heights{kInfinity, -kInfinity};
    const double drawing = kDrawing * _across.width();
    for (const glm::dvec3& corner : body.corners) {
        const Spot spot = spotOf(corner);
        const double error =
            pictureError(body.reach + rounding, forwardOf(corner), std::max(std::abs(spot.x), std::abs(spot.y))) +
            drawing;
        if (!std::isfinite(spot.x + spot.y + error)) return false;
        across = {std::min(across.lower, spot.x - error), std::max(across.upper, spot.x + error)};
        heights = {std::min(heights.lower, spot.y - error), std::max(heights.upper, spot.y + error)};
    }
    const bool isBeside = across.upper < _across.lower || across.lower > _across.upper;
    if (isBeside || !(heights.lower >= _lowest)) return false;
    // the rounding of the quotient; that of the strips' edges is in the errors of the corners
    constexpr double kRoom = 1e-6;
    const double from = std::floor((across.lower - _across.lower) / _step - kRoom);
    const double to = std::floor((across.upper - _across.lower) / _step + kRoom);
    const auto first = static_cast<std::size_t>(std::clamp(from, 0.0, static_cast<double>(kStrips - 1)));
    const auto last = static_cast<std::size_t>(std::clamp(to, 0.0, static_cast<double>(kStrips - 1)));
    for (std::size_t strip = first; strip <= last; ++strip) {
        if (!(_covered[strip].lower <= heights.lower && heights.upper <= _covered[strip].upper)) return false;
    }
    return true;
}

}  // namespace osgAnalyticBin::core
