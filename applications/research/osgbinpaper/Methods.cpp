// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Methods.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/edge/HullSeparation.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgAnalyticBin::paper {

namespace {

using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::GeodeticBin;
using core::Side;

// Middle and half size of the box along the axes.
std::pair<glm::dvec3, glm::dvec3> boxAround(const Ellipsoid& ellipsoid, const GeodeticBin& bin) {
    const ExactGeodeticBin exact(ellipsoid, bin);
    glm::dvec3 center(0.0);
    glm::dvec3 half(0.0);
    for (glm::length_t i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        const core::Interval range = exact.distanceRange({axis, 0.0});
        center[i] = range.middle();
        half[i] = 0.5 * range.width();
    }
    return {center, half};
}

// Between the samples the distance from the middle exceeds the largest by less than a hundredth.
double radiusAround(const glm::dvec3& center, const Ellipsoid& ellipsoid, const GeodeticBin& bin) {
    constexpr int kGridSteps = 4;
    constexpr double kAllowance = 1.01;
    double most = 0.0;
    for (int i = 0; i <= kGridSteps; ++i) {
        for (int j = 0; j <= kGridSteps; ++j) {
            for (const double altitude : {bin.altitude().lower, bin.altitude().upper}) {
                const core::Geodetic position{bin.latitude().lower + bin.latitude().width() * i / kGridSteps,
                                              bin.longitude().lower + bin.longitude().width() * j / kGridSteps,
                                              altitude};
                most = std::max(most, glm::distance(ellipsoid.toEcef(position), center));
            }
        }
    }
    return kAllowance * most;
}

Side sideOf(double middle, double reach) {
    if (middle + reach < 0.0) return Side::Outside;
    return middle - reach >= 0.0 ? Side::Inside : Side::Straddling;
}

}  // namespace

Frustum::Frustum(const Camera& camera) noexcept : hull(camera.planes(), camera.planes().size()) {
    for (const core::Plane& plane : camera.planes()) planes.push_back(plane);
}

SphereBin::SphereBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept
    : _center(boxAround(ellipsoid, bin).first), _radius(radiusAround(_center, ellipsoid, bin)) {}

Side SphereBin::classify(const core::Plane& plane) const noexcept {
    return sideOf(plane.distance(_center), _radius);
}

BoxBin::BoxBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    std::tie(_center, _half) = boxAround(ellipsoid, bin);
}

Side BoxBin::classify(const core::Plane& plane) const noexcept {
    return sideOf(plane.distance(_center), glm::dot(_half, glm::abs(plane.normal)));
}

Side classify(const HullBin& bin, const Frustum& frustum) noexcept {
    core::PlaneMask undecided = frustum.planes.all();
    const Side side = core::classify(bin.exact, frustum.planes, undecided);
    if (side != Side::Straddling) return side;
    const std::size_t count = frustum.planes.size();
    const bool isApart =
        isSeparated(bin.reverse, frustum.hull) || core::isSeparated(bin.exact, frustum.planes, count, undecided, count);
    return isApart ? Side::Outside : Side::Straddling;
}

MethodBins methodBins(const Ellipsoid& ellipsoid, const std::vector<GeodeticBin>& bins) {
    const core::GeodeticMapping mapping(ellipsoid);
    MethodBins result;
    for (const GeodeticBin& bin : bins) {
        const core::ParameterBox box = core::parameterBox(bin);
        std::get<indexOf(Method::Sphere)>(result).emplace_back(ellipsoid, bin);
        std::get<indexOf(Method::Box)>(result).emplace_back(ellipsoid, bin);
        std::get<indexOf(Method::Corners)>(result).emplace_back(mapping, box);
        std::get<indexOf(Method::Paper)>(result).emplace_back(mapping, box);
        std::get<indexOf(Method::Quadratic)>(result).push_back(core::quadraticOrExact(ellipsoid, bin));
        std::get<indexOf(Method::Exact)>(result).emplace_back(ellipsoid, bin);
        std::get<indexOf(Method::Hull)>(result).emplace_back(ellipsoid, bin);
    }
    return result;
}

}  // namespace osgAnalyticBin::paper
