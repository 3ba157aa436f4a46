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
                             const Interval& across, double drawing)
    : _eye(eye),
      _forward(forward),
      _right(glm::cross(forward, up)),
      _up(up),
      _across(across),
      _step(across.width() / static_cast<double>(kStrips)),
      _drawing(drawing) {
    _covered.fill({kInfinity, -kInfinity});
}

double HorizonBuffer::nearest(const BinHull& body) const noexcept {
    double nearest = kInfinity;
    for (const glm::dvec3& corner : body.corners) nearest = std::min(nearest, glm::dot(corner - _eye, _forward));
    return nearest - body.reach;
}

void HorizonBuffer::add(const EarthColumn& column) {
    constexpr double kSteepest = 1e3;
    Pending earth{0.0, {}, {}, 0.0, -kInfinity};
    double nearest = kInfinity, left = kInfinity, right = -kInfinity, largest = 0.0;
    const auto place = [&](const glm::dvec3& corner, glm::dvec2& spot) {
        const glm::dvec3 from = corner - _eye;
        const double forward = glm::dot(from, _forward), inverse = 1.0 / forward;
        spot = {glm::dot(from, _right) * inverse, glm::dot(from, _up) * inverse};
        nearest = std::min(nearest, forward);
        earth.farthest = std::max(earth.farthest, forward);
        left = std::min(left, spot.x);
        right = std::max(right, spot.x);
        largest = std::max({largest, std::abs(spot.x), std::abs(spot.y)});
        // written so that NaN is left out; rays near the picture's plane would make positions as large as one likes
        return forward > 0.0 && std::abs(spot.x) < kSteepest && std::abs(spot.y) < kSteepest;
    };
    for (std::size_t i = 0; i < 4; ++i) {
        if (!place(column.top[i], earth.top[i])) return;
        earth.highest = std::max(earth.highest, earth.top[i].y);
    }
    // what is no higher than earth in front of it covers nothing more
    if (!(right - left > _step) || !isAboveKnown(stripAt(left, 0.0), stripAt(right, 1.0), earth.highest)) return;
    for (std::size_t i = 0; i < 4; ++i) {
        if (!place(column.bottom[i], earth.bottom[i])) return;
    }
    // the length of a vector from the eye is at most forward (1 + |x| + |y|)
    const double longest = glm::length(_eye) + earth.farthest * (1.0 + 2.0 * largest);
    const double error = column.error + kVectorRounding * longest;
    if (!(column.error >= 0.0 && nearest > 4.0 * error)) return;
    earth.farthest += error;
    earth.error = pictureError(error, nearest, largest);
    if (!(earth.error < 0.5 * _step)) return;
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

namespace {

// The upper side of the hull of four points, as the lowest of some lines that are lowered by `error` in both
// directions. doc/occlusion.md, section 4.
struct UpperSide {
    UpperSide(std::array<glm::dvec2, 4> points, double error) {
        std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
        across = {points[0].x + error, points[3].x - error};
        lines.fill({0.0, 0.0});
        if (!(across.lower < across.upper)) return;
        std::array<glm::dvec2, 4> hull;
        std::size_t size = 0;
        for (const glm::dvec2& point : points) {
            if (size > 0 && point.x == hull[size - 1].x) {
                if (point.y <= hull[size - 1].y) continue;
                --size;
            }
            while (size > 1 && isBelow(hull[size - 1], hull[size - 2], point)) --size;
            hull[size++] = point;
        }
        for (std::size_t i = 0; i < lines.size(); ++i) {
            // unused lines repeat the last one
            const std::size_t k = std::min(i + 1, size - 1);
            const double slope = (hull[k].y - hull[k - 1].y) / (hull[k].x - hull[k - 1].x);
            const double size2 = std::abs(slope) * (1.0 + std::abs(hull[k].x)) + 1.0 + std::abs(hull[k].y);
            lines[i] = {slope,
                        hull[k].y - slope * hull[k].x - (1.0 + std::abs(slope)) * error - 16.0 * kEpsilon * size2};
        }
    }

    [[nodiscard]] double at(double x) const {
        return std::min({lines[0].x * x + lines[0].y, lines[1].x * x + lines[1].y, lines[2].x * x + lines[2].y});
    }

    Interval across;
    std::array<glm::dvec2, 3> lines;  // slope and height at zero

private:
    // Whether a point is not above the line through others on its left and on its right.
    static bool isBelow(const glm::dvec2& point, const glm::dvec2& left, const glm::dvec2& right) {
        return (point.x - left.x) * (right.y - left.y) >= (point.y - left.y) * (right.x - left.x);
    }
};

}  // namespace

// A column of earth is convex and so is its picture: at each x it has all between the lower side of its bottom and the
// upper side of its top. The upper side is concave: over a strip it is lowest at one of the ends.
void HorizonBuffer::raise(const Pending& earth) {
    const UpperSide top(earth.top, earth.error);
    std::array<glm::dvec2, 4> mirrored = earth.bottom;
    for (glm::dvec2& point : mirrored) point.y = -point.y;
    const UpperSide bottom(mirrored, earth.error);
    const Interval across{std::max(top.across.lower, bottom.across.lower),
                          std::min(top.across.upper, bottom.across.upper)};
    constexpr double kRounding = 1e-6;  // of the strips' edges
    const std::size_t first = stripAt(across.lower, 1.0 + kRounding), last = stripAt(across.upper, -kRounding);
    if (first >= last || !isAboveKnown(first, last, earth.highest)) return;
    double top0 = top.at(edge(first)), bottom0 = -bottom.at(edge(first));
    for (std::size_t strip = first; strip < last; ++strip) {
        const double x1 = edge(strip + 1), top1 = top.at(x1), bottom1 = -bottom.at(x1);
        const Interval heights{std::max(bottom0, bottom1), std::min(top0, top1)};
        if (!isEmpty(heights)) cover(strip, heights);
        top0 = top1;
        bottom0 = bottom1;
    }
}

// The strip with this x, or another as many strips to the right; kStrips: none.
std::size_t HorizonBuffer::stripAt(double x, double toRight) const noexcept {
    const double strip = std::floor((x - _across.lower) / _step + toRight);
    return static_cast<std::size_t>(std::clamp(strip, 0.0, static_cast<double>(kStrips)));
}

// Whether something of this height would stand above what is covered.
bool HorizonBuffer::isAboveKnown(std::size_t first, std::size_t last, double height) const noexcept {
    return std::any_of(_covered.begin() + static_cast<std::ptrdiff_t>(first),
                       _covered.begin() + static_cast<std::ptrdiff_t>(last),
                       [height](const Interval& covered) { return covered.upper < height; });
}

// Puts the earth that is no farther than `distance` into the strips.
void HorizonBuffer::use(double distance) {
    while (!_pending.empty() && _pending.front().farthest <= distance) {
        std::pop_heap(_pending.begin(), _pending.end());
        _reached = std::max(_reached, _pending.back().farthest);
        raise(_pending.back());
        _pending.pop_back();
    }
}

bool HorizonBuffer::hides(const BinHull& body) {
    double size2 = glm::dot(_eye, _eye), forward[8];
    double nearest = kInfinity;
    for (std::size_t i = 0; i < 8; ++i) {
        size2 = std::max(size2, glm::dot(body.corners[i], body.corners[i]));
        forward[i] = glm::dot(body.corners[i] - _eye, _forward);
        nearest = std::min(nearest, forward[i]);
    }
    const double reach = body.reach + kVectorRounding * std::sqrt(size2);
    if (!(nearest - reach > 0.0 && body.reach >= 0.0) || nearest - reach < _reached) return false;
    use(nearest - reach);
    Interval across{kInfinity, -kInfinity}, heights{kInfinity, -kInfinity};
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3 from = body.corners[i] - _eye;
        const double x = glm::dot(from, _right) / forward[i], y = glm::dot(from, _up) / forward[i];
        const double error = pictureError(reach, forward[i], std::max(std::abs(x), std::abs(y))) + _drawing;
        if (!std::isfinite(x + y + error)) return false;
        across = {std::min(across.lower, x - error), std::max(across.upper, x + error)};
        heights = {std::min(heights.lower, y - error), std::max(heights.upper, y + error)};
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
