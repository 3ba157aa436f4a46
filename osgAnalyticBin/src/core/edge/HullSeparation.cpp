// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"

#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

// Rounding of a mixture of two planes, in units of epsilon times its terms; doc/theory/horizon.md, section 7.
constexpr double kRounding = 16.0 * kEpsilon;

// Mixtures of unit normals that are shorter than this consist of rounding errors.
constexpr double kShortest = 1e-100;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

WedgeSearch::WedgeSearch(const Plane& first, const Plane& second, double reach) noexcept
    : _planes{first, second}, _rounding(kRounding * (std::abs(first.offset) + std::abs(second.offset) + reach)) {
    // A plane without a unit normal proves nothing.
    if (!isUsable(first) || !isUsable(second)) _rounding = kNaN;
}

Plane WedgeSearch::candidate() const noexcept {
    const glm::dvec3 normal = _weights[0] * _planes[0].normal + _weights[1] * _planes[1].normal;
    const double offset = _weights[0] * _planes[0].offset + _weights[1] * _planes[1].offset;
    const double rounding = _rounding * (_weights[0] + _weights[1]);
    const double length = glm::length(normal);
    if (!(length > kShortest)) return {glm::dvec3(kNaN), kNaN};
    return {normal / length, (offset + rounding) / length};
}

bool WedgeSearch::learn(const glm::dvec3& point) noexcept {
    const glm::dvec2 distances(_planes[0].distance(point), _planes[1].distance(point));
    if (distances[0] >= 0.0 && distances[1] >= 0.0) return false;  // a point of the bin inside both planes
    const glm::length_t side = distances[0] >= 0.0 ? 0 : 1;
    if (!(distances[side] >= 0.0)) return false;  // rounding, or NaN
    _points[static_cast<std::size_t>(side)] = distances;
    _known[static_cast<std::size_t>(side)] = true;
    if (!_known[0] || !_known[1]) {
        _weights = _known[0] ? glm::dvec2(0.0, 1.0) : glm::dvec2(1.0, 0.0);
        return true;
    }
    // The mixture for which both points are equally far outside.
    _weights = {_points[1][1] - _points[0][1], _points[0][0] - _points[1][0]};
    return glm::dot(_weights, _points[0]) < 0.0;  // else the chord between them passes inside both planes
}

}  // namespace osgAnalyticBin::core
