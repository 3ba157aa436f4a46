// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "kernels/ScalarKernels.h"

#include <osgAnalyticBin/core/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

constexpr double kPi = 3.14159265358979323846;
// Rounding of one signed distance, in units of epsilon times the magnitudes that enter; doc/derivation.md, section 8.
constexpr double kRounding = 32.0 * std::numeric_limits<double>::epsilon();
// Normals are of unit length to 1e-9 only; margin and sphere are meant for exactly one.
constexpr double kNormalTolerance = 1.0 + 1e-9;

// Bounds over all latitudes, by doc/derivation.md, section 2.
struct CurvatureBounds {
    explicit CurvatureBounds(const Ellipsoid& ellipsoid) noexcept
        : smallestRadius(std::min(ellipsoid.meridionalRadius(0.0, 1.0), ellipsoid.meridionalRadius(1.0, 0.0))),
          largestRadius(std::max(ellipsoid.meridionalRadius(0.0, 1.0), ellipsoid.meridionalRadius(1.0, 0.0))),
          // M' = 3 M e2 sp cp / w with |sp cp| <= 1/2
          slope(1.5 * largestRadius * std::abs(ellipsoid.eccentricitySquared()) /
                std::min(1.0, ellipsoid.squaredRatio())) {}

    double smallestRadius, largestRadius, slope;
};

// The cosine and sine of the longitude of the bin at which nx cos + ny sin is largest.
glm::dvec2 farthestAlongParallel(const ExactBinData& data, double nx, double ny) {
    const double length = std::sqrt(nx * nx + ny * ny);
    const glm::dvec2 within = length > 0.0 ? glm::dvec2(nx, ny) / length : glm::dvec2(data.cosMiddle, data.sinMiddle);
    if (data.longitudes == ExactBinData::FullCircle) return within;
    const auto slope = [&](double cosine, double sine) { return ny * cosine - nx * sine; };
    const double west = slope(data.cosWest, data.sinWest);
    const double middle = slope(data.cosMiddle, data.sinMiddle);
    const double east = slope(data.cosEast, data.sinEast);
    // The maximum lies within an arc of at most half a turn when the value rises at its start and falls at its end.
    if ((west > 0.0 && middle < 0.0) || (middle > 0.0 && east < 0.0)) return within;
    glm::dvec2 best(data.cosMiddle, data.sinMiddle);
    for (const glm::dvec2& end : {glm::dvec2(data.cosWest, data.sinWest), glm::dvec2(data.cosEast, data.sinEast)}) {
        if (nx * end.x + ny * end.y > nx * best.x + ny * best.y) best = end;
    }
    return best;
}

double farthestAltitude(const Interval& altitude) {
    return std::max(std::abs(altitude.lower), std::abs(altitude.upper));
}

}  // namespace

bool ExactGeodeticBin::holds(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    return !bin.empty() && bin.altitude().lower > -CurvatureBounds(ellipsoid).smallestRadius;
}

ExactGeodeticBin::ExactGeodeticBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept
    : _data(), _farthest(0.0) {
    assert(holds(ellipsoid, bin));
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    _data.squaredEquatorialRadius = a * a;
    _data.squaredPolarRadius = b * b;
    _data.topAltitude = bin.altitude().upper;
    _data.slack = margin * kNormalTolerance + kRounding * (std::max(a, b) + farthestAltitude(bin.altitude()));
    _farthest = (std::max(a, b) + farthestAltitude(bin.altitude()) + margin) * kNormalTolerance;
    setMeridian(ellipsoid, bin);
    setParallel(bin);
    setSphere(ellipsoid, bin);
}

ExactGeodeticBin::ExactGeodeticBin(const ExactBinData& data) noexcept
    : _data(data),
      _farthest((std::hypot(data.sphere.center[0], data.sphere.center[1], data.sphere.center[2]) +
                 static_cast<double>(data.sphere.reach)) *
                kNormalTolerance) {}

void ExactGeodeticBin::setMeridian(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    // Never negative: the latitudes end at the doubles nearest to the poles, which lie before them.
    _data.sinSouth = std::sin(bin.latitude().lower);
    _data.cosSouth = std::cos(bin.latitude().lower);
    _data.sinNorth = std::sin(bin.latitude().upper);
    _data.cosNorth = std::cos(bin.latitude().upper);
    const auto point = [&](double sine, double cosine, double altitude) -> MeridianPoint {
        const double n = ellipsoid.primeVerticalRadius(sine, cosine);
        return {(n + altitude) * cosine, (n * ellipsoid.squaredRatio() + altitude) * sine};
    };
    _data.topSouth = point(_data.sinSouth, _data.cosSouth, bin.altitude().upper);
    _data.bottomSouth = point(_data.sinSouth, _data.cosSouth, bin.altitude().lower);
    _data.topNorth = point(_data.sinNorth, _data.cosNorth, bin.altitude().upper);
    _data.bottomNorth = point(_data.sinNorth, _data.cosNorth, bin.altitude().lower);
}

void ExactGeodeticBin::setParallel(const GeodeticBin& bin) noexcept {
    const Interval& longitude = bin.longitude();
    _data.longitudes = bin.isFullCircle()         ? ExactBinData::FullCircle
                       : longitude.width() <= kPi ? ExactBinData::Narrow
                                                  : ExactBinData::Wide;
    _data.cosWest = std::cos(longitude.lower);
    _data.sinWest = std::sin(longitude.lower);
    _data.cosEast = std::cos(longitude.upper);
    _data.sinEast = std::sin(longitude.upper);
    _data.cosMiddle = std::cos(longitude.middle());
    _data.sinMiddle = std::sin(longitude.middle());
}

// A sphere about a centre in the middle meridian plane. The distance from there grows with the longitude's distance
// from the middle and is convex in the altitude: it is largest on one of the four edges along the meridians west and
// east. Along these it is convex too when the bin is small enough; doc/derivation.md, section 8.
void ExactGeodeticBin::setSphere(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    const std::array<MeridianPoint, 4> ends{_data.topSouth, _data.bottomSouth, _data.topNorth, _data.bottomNorth};
    const double spread = _data.longitudes == ExactBinData::FullCircle
                              ? 0.0
                              : std::max(0.0, _data.cosEast * _data.cosMiddle + _data.sinEast * _data.sinMiddle);
    double largestAxisDistance = 0.0;
    double axisDistance = 0.0;
    double z = 0.0;
    for (const MeridianPoint& end : ends) {
        largestAxisDistance = std::max(largestAxisDistance, end.axisDistance);
        axisDistance += 0.25 * spread * end.axisDistance;
        z += 0.25 * end.z;
    }
    const glm::dvec3 center(axisDistance * _data.cosMiddle, axisDistance * _data.sinMiddle, z);
    double farthest = 0.0;
    for (const MeridianPoint& end : ends) {
        const glm::dvec3 west(end.axisDistance * _data.cosWest, end.axisDistance * _data.sinWest, end.z);
        const glm::dvec3 east(end.axisDistance * _data.cosEast, end.axisDistance * _data.sinEast, end.z);
        farthest = std::max({farthest, glm::distance(center, west), glm::distance(center, east)});
    }
    // Between its ends, an edge leaves its chord by at most an eighth of its second derivative.
    const CurvatureBounds bounds(ellipsoid);
    const double bend = bounds.slope + bounds.largestRadius + farthestAltitude(bin.altitude());
    const double width = bin.latitude().width();
    const double sag = 0.125 * width * width * bend;
    const double tangent = bounds.smallestRadius + bin.altitude().lower;
    const bool convex = (farthest + sag) * bend * kNormalTolerance < tangent * tangent;
    _data.sphere.center[0] = center.x;
    _data.sphere.center[1] = center.y;
    _data.sphere.center[2] = center.z;
    const double reach = (convex ? farthest : farthest + sag) * kNormalTolerance + 4.0 * _data.slack;
    _data.sphere.reach = std::nextafter(static_cast<float>(reach), std::numeric_limits<float>::infinity());
    _data.sphere.curvature = SphereData::kExactForm;
    // A parallel leaves its chord by r (1 - cos(width / 2)).
    const double parallelSag = (largestAxisDistance + sag) * (1.0 - spread);
    _data.bulge = _data.longitudes == ExactBinData::Narrow ? (sag + parallelSag) * kNormalTolerance + _data.slack
                                                           : std::numeric_limits<double>::infinity();
}

double ExactGeodeticBin::support(const glm::dvec3& direction) const noexcept {
    return kernels::supportRange(_data, direction.x, direction.y, direction.z).upper;
}

glm::dvec3 ExactGeodeticBin::supportPoint(const glm::dvec3& direction) const noexcept {
    const glm::dvec2 radial = farthestAlongParallel(_data, direction.x, direction.y);
    const double c = direction.x * radial.x + direction.y * radial.y;
    const double nz = direction.z;
    const auto placed = [&](double axisDistance, double z) {
        return glm::dvec3(axisDistance * radial.x, axisDistance * radial.y, z);
    };
    const double rise = _data.cosSouth * nz - _data.sinSouth * c;
    const double fall = _data.cosNorth * nz - _data.sinNorth * c;
    if (rise > 0.0 && fall < 0.0) {
        // The normal of the surface there is the direction.
        const double a2 = _data.squaredEquatorialRadius;
        const double b2 = _data.squaredPolarRadius;
        const double surface = std::sqrt(a2 * c * c + b2 * nz * nz);
        const double up = _data.topAltitude / std::sqrt(c * c + nz * nz);
        return placed(c * (a2 / surface + up), nz * (b2 / surface + up));
    }
    const MeridianPoint* best = &_data.topSouth;
    for (const MeridianPoint* end : {&_data.bottomSouth, &_data.topNorth, &_data.bottomNorth}) {
        if (c * end->axisDistance + nz * end->z > c * best->axisDistance + nz * best->z) best = end;
    }
    return placed(best->axisDistance, best->z);
}

Side ExactGeodeticBin::classify(const Plane& plane) const noexcept {
    const kernels::Lane lane{plane.normal.x, plane.normal.y, plane.normal.z, plane.offset, roundingOf(plane)};
    kernels::LaneSide side = kernels::sphereSide(_data.sphere, lane);
    if (side == kernels::LaneSide::Open) side = kernels::hullSide(_data, lane);
    if (side == kernels::LaneSide::Open) side = kernels::fullSide(_data, lane);
    if (side == kernels::LaneSide::Outside) return Side::Outside;
    if (side == kernels::LaneSide::Inside) return Side::Inside;
    return Side::Straddling;
}

Interval ExactGeodeticBin::distanceRange(const Plane& plane) const noexcept {
    const kernels::Lane lane{plane.normal.x, plane.normal.y, plane.normal.z, plane.offset, roundingOf(plane)};
    const kernels::Range along = kernels::supportRange(_data, lane.nx, lane.ny, lane.nz);
    const double slack = kernels::slackOf(_data, lane);
    return {(plane.offset + along.lower) - slack, (plane.offset + along.upper) + slack};
}

}  // namespace osgAnalyticBin::core
