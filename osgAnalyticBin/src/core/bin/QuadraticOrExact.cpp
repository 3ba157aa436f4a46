// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>

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

QuadraticOrExact quadraticOrExact(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept {
    const GeodeticMapping mapping(ellipsoid);
    const ParameterBox box = parameterBox(bin);
    const bool isTight = mapping.remainder(box) <= kLargestRelativeRemainder * largestExtent(mapping, box);
    if (!isTight && ExactGeodeticBin::holds(ellipsoid, bin)) return ExactGeodeticBin(ellipsoid, bin, margin);
    return QuadraticBin(mapping, box, margin);
}

}  // namespace osgAnalyticBin::core
