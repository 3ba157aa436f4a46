// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "HorizonPoint.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::rivals {

namespace {

namespace row = core::row;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Outward rounding of products and quotients of a few factors; doc/theory/horizon.md, section 5.
constexpr double kDown = 1.0 - 16.0 * kEpsilon;
// Of one cosine that is compared; likewise.
constexpr double kCosineSlack = 64.0 * kEpsilon;
// Error bound of the cosine that the spread is computed from; doc/theory/horizon.md, section 9.
constexpr double kSpreadSlack = 16.0 * kEpsilon;

}  // namespace

HorizonPoint::HorizonPoint(const core::HorizonBin& bin) noexcept {
    const auto& rows = bin.numbers();
    const glm::dvec2 sum(rows[row::CosSouthern] + rows[row::CosNorthern],
                         rows[row::SinSouthern] + rows[row::SinNorthern]);
    const glm::dvec2 middle = glm::length(sum) > 0.0 ? glm::normalize(sum) : glm::dvec2(1.0, 0.0);
    // In longitude the cosine is least at the ends; along them it is least at the south or the north end, unless it
    // falls and rises again, which it does beyond a quarter turn only.
    const double radial = middle.x * rows[row::CosHalfWidth];
    const bool falls = middle.y * rows[row::CosSouthern] - radial * rows[row::SinSouthern] < 0.0;
    const bool rises = middle.y * rows[row::CosNorthern] - radial * rows[row::SinNorthern] > 0.0;
    if (falls && rises) return;
    const double cosine = std::min(radial * rows[row::CosSouthern] + middle.y * rows[row::SinSouthern],
                                   radial * rows[row::CosNorthern] + middle.y * rows[row::SinNorthern]) -
                          kSpreadSlack;
    if (!(cosine > 0.0)) return;
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    _cosSpread = cosine * rows[row::CosMargin] - sine * rows[row::SinMargin];
    _sinSpread = sine * rows[row::CosMargin] + cosine * rows[row::SinMargin];
    if (!(_cosSpread > 0.0)) return;
    _direction = {middle.x * rows[row::CosMiddleLongitude], middle.x * rows[row::SinMiddleLongitude], middle.y};
    _inverseRadius = rows[row::InverseRadius];
}

// As the horizon test of bins: doc/theory/horizon.md, section 3.
bool HorizonPoint::isHiddenFrom(const core::HorizonEye& eye) const noexcept {
    const core::HorizonEyeData& data = eye.data();
    const double cosine = glm::dot({data.x, data.y, data.z}, _direction);
    if (cosine >= data.cosDip) return false;
    const double cosB = std::min(1.0, data.scale * _inverseRadius * kDown);
    const double sinB = std::sqrt(1.0 - cosB * cosB + 4.0 * kEpsilon);
    const double cosC = cosB * _cosSpread - sinB * _sinSpread;
    const double sinC = sinB * _cosSpread + cosB * _sinSpread;
    return cosC > 0.0 && cosine < data.cosDip * cosC - data.sinDip * sinC - kCosineSlack;
}

}  // namespace osgAnalyticBin::rivals
