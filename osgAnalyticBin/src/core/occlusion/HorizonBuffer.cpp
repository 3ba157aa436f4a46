// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace osgAnalyticBin::core {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The rounding of a vector from the eye, in units of the longest vector from the centre.
constexpr double kVectorRounding = 16.0 * kEpsilon;

// The error of a position in the picture, for a point that is wrong by up to `metres` along each axis;
// doc/theory/occlusion.md, section 4. `spot`: how far the position is from the middle of the picture, at most.
glm::dvec2 pictureError(const glm::dvec3& metres, double forward, const glm::dvec2& spot) {
    const double inverse = 1.0 / (forward - metres.y);
    const auto [x, y] = std::make_pair(std::abs(spot.x), std::abs(spot.y));
    return {(metres.x + x * metres.y) * inverse + 16.0 * kEpsilon * (1.0 + x),
            (metres.z + y * metres.y) * inverse + 16.0 * kEpsilon * (1.0 + y)};
}

}  // namespace

HorizonBuffer::HorizonBuffer(double eyeToCentre, const Interval& across, double drawing, double depthStep,
                             const glm::dvec3& eyes)
    : _eyeToCentre(eyeToCentre),
      _across(across),
      _step(across.width() / static_cast<double>(kStrips)),
      _perStep(1.0 / _step),
      _drawing(drawing),
      _depthStep(depthStep),
      _eyes(eyes) {
    _lower.fill(kInfinity);
    _upper.fill(-kInfinity);
}

// Uses only a wall of the column, between its leftmost and its rightmost corner. The picture of the wall is hardly
// smaller than that of the column, and it ends in straight lines.
void HorizonBuffer::add(const EarthColumn& column) {
    constexpr double kSteepest = 1e3;
    double nearest = kInfinity, farthest = 0.0;
    glm::dvec2 largest(0.0);
    const auto place = [&](const glm::dvec3& corner, glm::dvec2& spot) {
        const double forward = corner.y, inverse = 1.0 / forward;
        spot = {corner.x * inverse, corner.z * inverse};
        nearest = std::min(nearest, forward);
        farthest = std::max(farthest, forward);
        largest = glm::max(largest, glm::abs(spot));
        // written so that NaN is left out; rays near the picture's plane would make positions as large as one likes
        return forward > 0.0 && std::abs(spot.x) < kSteepest && std::abs(spot.y) < kSteepest;
    };
    std::array<glm::dvec2, 4> top;
    for (std::size_t i = 0; i < 4; ++i) {
        if (!place(column.top[i], top[i])) return;
    }
    for (const glm::dvec3& corner : column.top) _nearestEarth = std::min(_nearestEarth, glm::length(corner));
    const auto [leftmost, rightmost] =
        std::minmax_element(top.begin(), top.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    const std::size_t first = stripAt(leftmost->x, 0.0), last = stripAt(rightmost->x, 1.0);
    // what is no higher than earth in front of it covers nothing more
    const double highest = std::max(leftmost->y, rightmost->y);
    if (!(rightmost->x - leftmost->x > _step) || !isAboveKnown(first, last, highest)) return;
    std::array<glm::dvec2, 2> bottom;
    const auto below = [&](const auto& corner) {
        return column.bottom[static_cast<std::size_t>(corner - top.begin())];
    };
    if (!place(below(leftmost), bottom[0]) || !place(below(rightmost), bottom[1])) return;
    // the length of a vector from the eye is at most forward (1 + |x| + |y|)
    const double longest = _eyeToCentre + farthest * (1.0 + largest.x + largest.y);
    const double error = column.error + kVectorRounding * longest;
    if (!(column.error >= 0.0 && nearest > 4.0 * error && nearest > 1.5 * (_eyes.y + error))) return;
    const glm::dvec2 inPicture = pictureError(_eyes + error, nearest, largest);
    if (!(bottom[0].x < bottom[1].x)) return;
    Wall wall;
    wall.highest = highest;
    wall.across = {std::max(leftmost->x, bottom[0].x) + inPicture.x, std::min(rightmost->x, bottom[1].x) - inPicture.x};
    wall.top = Line(*leftmost, *rightmost, -1.0, inPicture);
    wall.bottom = Line(bottom[0], bottom[1], 1.0, inPicture);
    _waiting.push_back({farthest + error, _walls.size()});
    std::push_heap(_waiting.begin(), _waiting.end());
    _walls.push_back(wall);
}

// The line through two points that may be elsewhere by `error`, no lower than the true one (`side` 1) or no higher
// (-1). Units of the picture. doc/theory/occlusion.md, section 4.
HorizonBuffer::Line::Line(const glm::dvec2& a, const glm::dvec2& b, double side, const glm::dvec2& error) {
    slope = (b.y - a.y) / (b.x - a.x);
    const double rounding = 16.0 * kEpsilon * (std::abs(slope) * (1.0 + std::abs(a.x)) + 1.0 + std::abs(a.y));
    offset = a.y - slope * a.x + side * (error.y + std::abs(slope) * error.x + rounding);
}

// A wall is convex, and so is its picture: at each x the wall covers the interval between its two lines. Within a strip
// a line is lowest at one end and highest at the other.
// Where the wall's interval meets the one that is known, their union is covered. Where they do not meet, only the
// higher one is kept.
void HorizonBuffer::raise(const Wall& wall) {
    constexpr double kRounding = 1e-6;  // of the strips' edges
    const std::size_t first = stripAt(wall.across.lower, 1.0 + kRounding),
                      last = stripAt(wall.across.upper, -kRounding);
    if (first >= last || !isAboveKnown(first, last, wall.highest)) return;
    const double left = _across.lower, right = _across.lower + _step;
    const double topEnd = wall.top.slope < 0.0 ? right : left, bottomEnd = wall.bottom.slope < 0.0 ? left : right;
    for (std::size_t strip = first; strip < last; ++strip) {
        const double toRight = _step * static_cast<double>(static_cast<int>(strip));
        const double lower = wall.bottom.slope * (bottomEnd + toRight) + wall.bottom.offset;
        const double upper = wall.top.slope * (topEnd + toRight) + wall.top.offset;
        const double knownLower = _lower[strip], knownUpper = _upper[strip];
        const bool isHigher = upper > knownUpper, isWall = lower <= upper;
        const bool meet = lower <= knownUpper && knownLower <= upper;
        const double least = lower < knownLower ? lower : knownLower;
        const double separate = isHigher ? lower : knownLower;
        const double joined = meet ? least : separate;
        const double most = isHigher ? upper : knownUpper;
        _lower[strip] = isWall ? joined : knownLower;
        _upper[strip] = isWall ? most : knownUpper;
    }
}

// The strip with this x, or another as many strips to the right; kStrips: none.
std::size_t HorizonBuffer::stripAt(double x, double toRight) const noexcept {
    const double strip = (x - _across.lower) * _perStep + toRight;
    return static_cast<std::size_t>(std::clamp(strip, 0.0, static_cast<double>(kStrips)));
}

// Whether something of this height would stand above what is covered, in these strips or in some beside them.
bool HorizonBuffer::isAboveKnown(std::size_t first, std::size_t last, double height) const noexcept {
    // lanes, so that the compiler can use vectors
    constexpr std::size_t kLanes = 8;
    static_assert(kStrips % kLanes == 0);
    double least[kLanes];
    std::fill(least, least + kLanes, kInfinity);
    for (std::size_t strip = first / kLanes * kLanes; strip < last; strip += kLanes) {
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            least[lane] = _upper[strip + lane] < least[lane] ? _upper[strip + lane] : least[lane];
    }
    return *std::min_element(least, least + kLanes) < height;
}

// Puts the walls that are no farther than `distance` into the strips.
void HorizonBuffer::use(double distance) {
    while (!_waiting.empty() && _waiting.front().farthest <= distance) {
        std::pop_heap(_waiting.begin(), _waiting.end());
        _reached = std::max(_reached, _waiting.back().farthest);
        raise(_walls[_waiting.back().wall]);
        _waiting.pop_back();
    }
}

HorizonBuffer::Outline HorizonBuffer::outlineOf(const BinHull& body) const noexcept {
    Outline outline{kInfinity, {kInfinity, -kInfinity}, {kInfinity, -kInfinity}, false};
    double farthest = -kInfinity, size2 = 0.0, sum = body.reach;
    for (const glm::dvec3& corner : body.corners) {
        sum += corner.x + corner.y + corner.z;
        outline.nearest = std::min(outline.nearest, corner.y);
        farthest = std::max(farthest, corner.y);
        size2 = std::max(size2, glm::dot(corner, corner));
    }
    const double reach = body.reach + kVectorRounding * (_eyeToCentre + std::sqrt(size2));
    const glm::dvec3 reachAndEyes = _eyes + reach;
    outline.nearest -= reach;
    if (!(std::isfinite(sum) && body.reach >= 0.0)) {
        outline.nearest = -kInfinity;
        return outline;
    }
    if (!(outline.nearest > _eyes.y)) {
        // beyond the planes through the eye and the sides of the picture
        const auto isBeyond = [&](double x, double side) {
            const double room = 1.001 * (reachAndEyes.x + std::abs(x) * reachAndEyes.y);
            return std::all_of(body.corners.begin(), body.corners.end(),
                               [&](const glm::dvec3& corner) { return side * (corner.x - x * corner.y) > room; });
        };
        outline.isBeside = farthest < -reachAndEyes.y || isBeyond(_across.lower, -1.0) || isBeyond(_across.upper, 1.0);
        return outline;
    }
    for (const glm::dvec3& corner : body.corners) {
        const double inverse = 1.0 / corner.y, x = corner.x * inverse, y = corner.z * inverse;
        const glm::dvec2 error = pictureError(reachAndEyes, corner.y, {x, y}) + _drawing;
        outline.across = {std::min(outline.across.lower, x - error.x), std::max(outline.across.upper, x + error.x)};
        outline.heights = {std::min(outline.heights.lower, y - error.y), std::max(outline.heights.upper, y + error.y)};
    }
    outline.isBeside = outline.across.upper < _across.lower || outline.across.lower > _across.upper;
    return outline;
}

bool HorizonBuffer::hides(const Outline& body) {
    // Earth up to here is nearer than the body by a step of the depth buffer. That is hardest for the eye that is
    // farthest back.
    const double fromBack = body.nearest + _eyes.y;
    const double farthest = fromBack / (1.0 + _depthStep * fromBack) - _eyes.y;
    // written so that NaN is not hidden
    if (!(body.nearest > _eyes.y && farthest >= _reached)) return false;
    use(farthest);
    if (body.isBeside || !(body.heights.lower >= _lowest)) return false;
    // the rounding of the quotient; that of the strips' edges is in the errors of the corners
    constexpr double kRoom = 1e-6;
    const std::size_t first = stripAt(body.across.lower, -kRoom), last = stripAt(body.across.upper, 1.0 + kRoom);
    for (std::size_t strip = first; strip < last; ++strip) {
        if (!(_lower[strip] <= body.heights.lower && body.heights.upper <= _upper[strip])) return false;
    }
    return true;
}

}  // namespace osgAnalyticBin::core
