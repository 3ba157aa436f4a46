// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "kernels/ScalarKernels.h"

#include <osgAnalyticBin/core/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>

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
        : smallestRadius(std::min(ellipsoid.meridionalRadius(0.0), ellipsoid.meridionalRadius(1.0))),
          largestRadius(std::max(ellipsoid.meridionalRadius(0.0), ellipsoid.meridionalRadius(1.0))),
          // M' = 3 M e2 sp cp / w with |sp cp| <= 1/2
          slope(1.5 * largestRadius * std::abs(ellipsoid.eccentricitySquared()) /
                std::min(1.0, 1.0 - ellipsoid.eccentricitySquared())) {}

    double smallestRadius, largestRadius, slope;
};

double farthestAltitude(const Interval& altitude) {
    return std::max(std::abs(altitude.lower), std::abs(altitude.upper));
}

}  // namespace

bool ExactGeodeticBin::holds(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    return !bin.empty() && bin.altitude().lower > -CurvatureBounds(ellipsoid).smallestRadius;
}

ExactGeodeticBin::ExactGeodeticBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept
    : _data() {
    assert(holds(ellipsoid, bin));
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    _data.squaredEquatorialRadius = a * a;
    _data.squaredPolarRadius = b * b;
    _data.topAltitude = bin.altitude().upper;
    _data.slack = margin * kNormalTolerance + kRounding * (std::max(a, b) + farthestAltitude(bin.altitude()));
    setMeridian(ellipsoid, bin);
    setParallel(bin);
    setSphere(ellipsoid, bin);
}

void ExactGeodeticBin::setMeridian(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    // Never negative: the latitudes end at the doubles nearest to the poles, which lie before them.
    _data.sinSouth = std::sin(bin.latitude().lower);
    _data.cosSouth = std::cos(bin.latitude().lower);
    _data.sinNorth = std::sin(bin.latitude().upper);
    _data.cosNorth = std::cos(bin.latitude().upper);
    const auto point = [&](double sine, double cosine, double altitude) -> MeridianPoint {
        const double n = ellipsoid.primeVerticalRadius(sine);
        return {(n + altitude) * cosine, (n * (1.0 - ellipsoid.eccentricitySquared()) + altitude) * sine};
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
    double axisDistance = 0.0;
    double z = 0.0;
    for (const MeridianPoint& end : ends) {
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
    _data.center[0] = center.x;
    _data.center[1] = center.y;
    _data.center[2] = center.z;
    _data.reach = (convex ? farthest : farthest + sag) * kNormalTolerance + 4.0 * _data.slack;
}

Side ExactGeodeticBin::classify(const Plane& plane) const noexcept {
    const kernels::Lane lane{plane.normal.x, plane.normal.y, plane.normal.z, plane.offset, roundingOf(plane)};
    kernels::LaneSide side = kernels::sphereSide(_data.center, _data.reach, lane);
    if (side == kernels::LaneSide::Straddling) side = kernels::exactSide(_data, lane);
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
