// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxBins.h"

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::rivals {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Rounding of one signed distance, in units of epsilon times the bin's reach: some twenty roundings of sums and
// products of three, and axes that are of unit length and at right angles to a few epsilon.
constexpr double kRounding = 64.0 * kEpsilon;
constexpr double kOffsetRounding = 4.0 * kEpsilon;
// The reach of any bin is rounded up by as much.
constexpr double kUp = 1.0 + 1e-9;

using Axes = std::array<glm::dvec3, 3>;

struct Extents {
    glm::dvec3 center{0.0}, halfSize{0.0};
    double reach = 0.0;
};

Extents wholeGlobe(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) {
    const double altitude = std::max(std::abs(bin.altitude().lower), std::abs(bin.altitude().upper));
    const double reach = (std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius()) + altitude + margin) * kUp;
    return {glm::dvec3(0.0), glm::dvec3(reach), reach};
}

template <class Bin>
Extents extentsAlong(const Axes& axes, const Bin& bin) {
    Extents extents;
    extents.reach = bin.reach();
    for (glm::length_t i = 0; i < 3; ++i) {
        const core::Interval range = bin.distanceRange({axes[static_cast<std::size_t>(i)], 0.0});
        extents.center[i] = range.middle();
        extents.halfSize[i] = 0.5 * range.width();
    }
    return extents;
}

Extents extentsAlong(const Axes& axes, const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) {
    if (ellipsoid.isPlane())
        return extentsAlong(axes,
                            core::QuadraticBin(core::GeodeticMapping(ellipsoid), core::parameterBox(bin), margin));
    if (!core::ExactGeodeticBin::holds(ellipsoid, bin)) return wholeGlobe(ellipsoid, bin, margin);
    return extentsAlong(axes, core::ExactGeodeticBin(ellipsoid, bin, margin));
}

const Axes& ecefAxes() {
    static const Axes axes{glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)};
    return axes;
}

Axes eastNorthUp(const core::Ellipsoid& ellipsoid, const core::Geodetic& position) {
    if (ellipsoid.isPlane()) return ecefAxes();
    const double sine = std::sin(position.latitude);
    const double cosine = std::cos(position.latitude);
    const glm::dvec3 radial(std::cos(position.longitude), std::sin(position.longitude), 0.0);
    return {glm::dvec3(-radial.y, radial.x, 0.0), glm::dvec3(-sine * radial.x, -sine * radial.y, cosine),
            glm::dvec3(cosine * radial.x, cosine * radial.y, sine)};
}

}  // namespace

Box::Box(const Axes& axes, const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) noexcept
    : _axes(axes) {
    const Extents extents = extentsAlong(axes, ellipsoid, bin, margin);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto k = static_cast<glm::length_t>(i);
        _center += extents.center[k] * axes[i];
        _halfAxes[i] = extents.halfSize[k] * axes[i];
    }
    _slack = kRounding * extents.reach;
    _reach = extents.reach;
}

core::Side Box::classify(const core::Plane& plane) const noexcept {
    // a number that is not finite decides nothing
    if (!core::isUsable(plane)) return core::Side::Straddling;
    const double radius = std::abs(glm::dot(plane.normal, _halfAxes[0])) +
                          std::abs(glm::dot(plane.normal, _halfAxes[1])) +
                          std::abs(glm::dot(plane.normal, _halfAxes[2]));
    const double reach = radius + _slack + kOffsetRounding * std::abs(plane.offset);
    const double distance = plane.distance(_center);
    if (distance + reach < 0.0) return core::Side::Outside;
    return distance - reach >= 0.0 ? core::Side::Inside : core::Side::Straddling;
}

// Faces 0 to 2 are the lower ends of the axes, 3 to 5 the upper ones.
core::Plane Box::face(std::size_t i) const noexcept {
    const glm::dvec3& axis = _axes[i % 3];
    const double sign = i < 3 ? 1.0 : -1.0;
    return {sign * axis, glm::dot(axis, _halfAxes[i % 3]) - sign * glm::dot(axis, _center) + _slack};
}

BoxBin::BoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) noexcept
    : Box(ecefAxes(), ellipsoid, bin, margin) {}

OrientedBoxBin::OrientedBoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) noexcept
    : Box(eastNorthUp(ellipsoid, bin.center()), ellipsoid, bin, margin) {}

}  // namespace osgAnalyticBin::rivals
