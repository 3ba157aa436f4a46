// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RivalBins.h"

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>

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

// A plane with a number that is not finite decides nothing.
core::Side sideOf(const core::Plane& plane, const core::Interval& distances) {
    if (std::isnan(core::roundingOf(plane))) return core::Side::Straddling;
    if (distances.upper < 0.0) return core::Side::Outside;
    return distances.lower >= 0.0 ? core::Side::Inside : core::Side::Straddling;
}

// Corner i of the unit cube: bit k of i chooses the sign of coordinate k.
glm::dvec3 unitCorner(std::size_t i) {
    return {i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0};
}

// Where the gradient of q vanishes; NaN where it has no such point.
glm::dvec3 stationaryPoint(const core::Quadratic& q) {
    const auto& h = q.hessian;
    const glm::dmat3 matrix(h[0], h[3], h[4], h[3], h[1], h[5], h[4], h[5], h[2]);
    return -(glm::inverse(matrix) * glm::dvec3(q.gradient[0], q.gradient[1], q.gradient[2]));
}

namespace row = core::row;

// Outward rounding of products and quotients of a few factors; doc/theory/horizon.md, section 5.
constexpr double kDown = 1.0 - 16.0 * kEpsilon;
// Of one cosine that is compared; likewise.
constexpr double kCosineSlack = 64.0 * kEpsilon;
// Error bound of the cosine that the spread is computed from; doc/theory/horizon.md, section 9.
constexpr double kSpreadSlack = 16.0 * kEpsilon;

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

PaperBin::PaperBin(const core::AnalyticMapping& mapping, const core::ParameterBox& box, double growth) noexcept
    : _model(mapping, {box.center, box.halfSize * growth}) {}

core::Side PaperBin::classify(const core::Plane& plane) const noexcept {
    const core::Quadratic q = _model.distanceModel(plane);
    core::Interval distances = core::Interval::none();
    const auto take = [&](const glm::dvec3& x) { distances.expandBy(q(x.x, x.y, x.z)); };
    for (std::size_t i = 0; i < 8; ++i) take(unitCorner(i));
    const glm::dvec3 stationary = stationaryPoint(q);
    // [JJ] section 3: the ninth point
    if (glm::all(glm::lessThanEqual(glm::abs(stationary), glm::dvec3(1.0)))) take(stationary);
    return sideOf(plane, distances);
}

CornersBin::CornersBin(const core::AnalyticMapping& mapping, const core::ParameterBox& box) noexcept : _corners() {
    for (std::size_t i = 0; i < 8; ++i) _corners[i] = mapping.value(box.center + unitCorner(i) * box.halfSize);
}

core::Side CornersBin::classify(const core::Plane& plane) const noexcept {
    core::Interval distances = core::Interval::none();
    for (const glm::dvec3& corner : _corners) distances.expandBy(plane.distance(corner));
    return sideOf(plane, distances);
}

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
