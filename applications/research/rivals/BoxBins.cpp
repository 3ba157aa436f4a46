// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxBins.h"

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <glm/common.hpp>
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

// `radius`: half of what the box measures across the plane. A number that is not finite decides nothing.
core::Side sideOf(double distance, double radius, double slack, const core::Plane& plane) {
    if (!core::isUsable(plane)) return core::Side::Straddling;
    const double reach = radius + slack + kOffsetRounding * std::abs(plane.offset);
    if (distance + reach < 0.0) return core::Side::Outside;
    return distance - reach >= 0.0 ? core::Side::Inside : core::Side::Straddling;
}

// Faces 0 to 2 are the lower ends of the axes, 3 to 5 the upper ones.
core::Plane faceOf(const glm::dvec3& axis, std::size_t i, double center, double halfSize, double slack) {
    const double sign = i < 3 ? 1.0 : -1.0;
    return {sign * axis, halfSize - sign * center + slack};
}

template <class Box>
bool isBeyondAFace(const Box& box, const FrustumHull& frustum) {
    if (frustum.cornerCount() == 0) return false;
    for (std::size_t i = 0; i < Box::kFaces; ++i) {
        if (frustum.isBehind(box.face(i), box.reach())) return true;
    }
    return false;
}

}  // namespace

BoxBin::BoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) noexcept {
    const Extents extents = extentsAlong(ecefAxes(), ellipsoid, bin, margin);
    _center = extents.center;
    _halfSize = extents.halfSize;
    _slack = kRounding * extents.reach;
    _reach = extents.reach;
}

core::Side BoxBin::classify(const core::Plane& plane) const noexcept {
    return sideOf(plane.distance(_center), glm::dot(glm::abs(plane.normal), _halfSize), _slack, plane);
}

core::Plane BoxBin::face(std::size_t i) const noexcept {
    const auto k = static_cast<glm::length_t>(i % 3);
    return faceOf(ecefAxes()[i % 3], i, _center[k], _halfSize[k], _slack);
}

OrientedBoxBin::OrientedBoxBin(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, double margin) noexcept
    : _center(0.0), _axes(eastNorthUp(ellipsoid, bin.center())) {
    const Extents extents = extentsAlong(_axes, ellipsoid, bin, margin);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto k = static_cast<glm::length_t>(i);
        _center += extents.center[k] * _axes[i];
        _halfAxes[i] = extents.halfSize[k] * _axes[i];
    }
    _slack = kRounding * extents.reach;
    _reach = extents.reach;
}

core::Side OrientedBoxBin::classify(const core::Plane& plane) const noexcept {
    const double radius = std::abs(glm::dot(plane.normal, _halfAxes[0])) +
                          std::abs(glm::dot(plane.normal, _halfAxes[1])) +
                          std::abs(glm::dot(plane.normal, _halfAxes[2]));
    return sideOf(plane.distance(_center), radius, _slack, plane);
}

core::Plane OrientedBoxBin::face(std::size_t i) const noexcept {
    const glm::dvec3& axis = _axes[i % 3];
    return faceOf(axis, i, glm::dot(axis, _center), glm::dot(axis, _halfAxes[i % 3]), _slack);
}

bool isSeparated(const BoxBin& box, const FrustumHull& frustum) noexcept {
    return isBeyondAFace(box, frustum);
}

bool isSeparated(const OrientedBoxBin& box, const FrustumHull& frustum) noexcept {
    return isBeyondAFace(box, frustum);
}

}  // namespace osgAnalyticBin::rivals
