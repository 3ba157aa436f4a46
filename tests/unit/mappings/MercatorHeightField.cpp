// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MercatorHeightField.h"

#include <osgAnalyticBin/mappings/FormulaRounding.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::test {

double MercatorHeightField::remainder(const core::ParameterBox& box) const noexcept {
    const double south = (box.center.y - box.halfSize.y) / _radius;
    const double north = (box.center.y + box.halfSize.y) / _radius;
    // Latitudes nearest to and farthest from the equator, and upper bounds of cosine, sine and |cos 2 latitude|
    const double nearest = south <= 0.0 && north >= 0.0 ? 0.0 : std::min(std::abs(south), std::abs(north));
    const double farthest = std::max(std::abs(south), std::abs(north));
    const double c = 1.0 / std::cosh(nearest);
    const double s = std::tanh(farthest);
    const double least = 1.0 / std::cosh(farthest);
    const double cos2 = std::max(std::abs(1.0 - 2.0 * c * c), std::abs(1.0 - 2.0 * least * least));
    const double distance = std::abs(box.center.z + _radius) + box.halfSize.z;
    const double l = box.halfSize.x / _radius;
    const double y = box.halfSize.y / _radius;
    const double h = box.halfSize.z;
    // doc/theory/mappings.md, section 6: along east, and in the meridian plane
    const double east = distance * c * (3.0 * cos2 * y * y * l + l * l * l) + 6.0 * c * s * y * l * h;
    const double meridian =
        distance * c * (std::sqrt(1.0 + 3.0 * c * c) * y * y * y + 3.0 * s * y * l * l) + 3.0 * c * h * (y * y + l * l);
    // Easting and northing are angles times the radius: their rounding is one of the angle.
    const double angles = (1.0 + l + y) * (1.0 + l + y) * (1.0 + std::abs(box.center.x) / _radius + farthest);
    return core::withRounding(std::hypot(east, meridian) / 6.0, (distance + _radius) * angles);
}

}  // namespace osgAnalyticBin::test
