// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/GeodeticMapping.h>
#include <osgAnalyticBin/core/GeodeticQuadraticBin.h>

#include <glm/geometric.hpp>

#include <algorithm>

namespace osgAnalyticBin::core {

namespace {

double largestExtent(const GeodeticMapping& mapping, const ParameterBox& box) {
    const glm::dmat3 jacobian = mapping.jacobian(box.center);
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) largest = std::max(largest, 2.0 * glm::length(jacobian[i]) * box.halfSize[i]);
    return largest;
}

}  // namespace

GeodeticQuadraticBin::GeodeticQuadraticBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept
    : _data() {
    const GeodeticMapping mapping(ellipsoid);
    const ParameterBox box = parameterBox(bin);
    const double remainder = mapping.thirdDerivativeBound(box) / 6.0;
    const bool isTight = remainder <= kLargestRelativeRemainder * largestExtent(mapping, box);
    if (!isTight && ExactGeodeticBin::holds(ellipsoid, bin)) {
        _data.exact = ExactGeodeticBin(ellipsoid, bin, margin).data();
    } else {
        _data.quadratic = QuadraticBin(mapping, box, margin).data();
    }
}

Side GeodeticQuadraticBin::classify(const Plane& plane) const noexcept {
    return isExact() ? ExactGeodeticBin(_data.exact).classify(plane) : QuadraticBin(_data.quadratic).classify(plane);
}

Interval GeodeticQuadraticBin::distanceRange(const Plane& plane) const noexcept {
    return isExact() ? ExactGeodeticBin(_data.exact).distanceRange(plane)
                     : QuadraticBin(_data.quadratic).distanceRange(plane);
}

}  // namespace osgAnalyticBin::core
