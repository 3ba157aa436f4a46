// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"
#include "../FloatRounding.h"
#include "../kernels/ScalarTests.h"

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

// Rounding of one signed distance, in units of epsilon times the magnitudes that enter; doc/theory/derivation.md,
// section 8.
constexpr double kRounding = 32.0 * kEpsilon;

// Of M by latitude, a bound over all latitudes: M' = 3 M e2 sp cp / w with |sp cp| <= 1/2, doc/theory/derivation.md,
// section 2.
double largestSlope(const Ellipsoid& ellipsoid) {
    return 1.5 * largestCurvatureRadius(ellipsoid) * std::abs(ellipsoid.eccentricitySquared()) /
           std::min(1.0, ellipsoid.squaredRatio());
}

// The cosine and sine of the longitude of the bin at which nx cos + ny sin is largest.
glm::dvec2 farthestAlongParallel(const double* numbers, double nx, double ny) {
    const double length = std::sqrt(nx * nx + ny * ny);
    const glm::dvec2 within =
        length > 0.0 ? glm::dvec2(nx, ny) / length : glm::dvec2(numbers[row::CosMiddle], numbers[row::SinMiddle]);
    if (numbers[row::Longitudes] == row::kFullCircle) return within;
    const auto slope = [&](double cosine, double sine) { return ny * cosine - nx * sine; };
    const double west = slope(numbers[row::CosWest], numbers[row::SinWest]);
    const double middle = slope(numbers[row::CosMiddle], numbers[row::SinMiddle]);
    const double east = slope(numbers[row::CosEast], numbers[row::SinEast]);
    // The maximum lies within an arc of at most half a turn when the value rises at its start and falls at its end.
    if ((west > 0.0 && middle < 0.0) || (middle > 0.0 && east < 0.0)) return within;
    glm::dvec2 best(numbers[row::CosMiddle], numbers[row::SinMiddle]);
    for (const glm::dvec2& end : {glm::dvec2(numbers[row::CosWest], numbers[row::SinWest]),
                                  glm::dvec2(numbers[row::CosEast], numbers[row::SinEast])}) {
        if (nx * end.x + ny * end.y > nx * best.x + ny * best.y) best = end;
    }
    return best;
}

// Distance from the axis and z.
std::array<glm::dvec2, 4> cornersOf(const double* numbers) {
    const double* corners = numbers + row::Corners;
    return {glm::dvec2(corners[0], corners[1]), glm::dvec2(corners[2], corners[3]), glm::dvec2(corners[4], corners[5]),
            glm::dvec2(corners[6], corners[7])};
}

double farthestAltitude(const Interval& altitude) {
    return std::max(std::abs(altitude.lower), std::abs(altitude.upper));
}

}  // namespace

bool ExactGeodeticBin::holds(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    return !bin.empty() && !ellipsoid.isPlane() && bin.altitude().lower > -smallestCurvatureRadius(ellipsoid);
}

ExactGeodeticBin::ExactGeodeticBin(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin) noexcept
    : _farthest(0.0) {
    assert(holds(ellipsoid, bin));
    const double a = ellipsoid.equatorialRadius();
    const double b = ellipsoid.polarRadius();
    _numbers[row::SquaredEquatorialRadius] = a * a;
    _numbers[row::SquaredPolarRadius] = b * b;
    _numbers[row::TopAltitude] = bin.altitude().upper;
    _numbers[row::Slack] = margin * kNormalTolerance + kRounding * (std::max(a, b) + farthestAltitude(bin.altitude()));
    _farthest = (std::max(a, b) + farthestAltitude(bin.altitude()) + margin) * kNormalTolerance;
    setMeridian(ellipsoid, bin);
    setParallel(bin);
    setSphere(ellipsoid, bin);
}

ExactGeodeticBin::ExactGeodeticBin(const double* numbers, std::size_t stride) noexcept : _farthest(0.0) {
    for (std::size_t i = 0; i < _numbers.size(); ++i) _numbers[i] = numbers[i * stride];
    const double center = std::hypot(_numbers[row::CenterX], _numbers[row::CenterY], _numbers[row::CenterZ]);
    _farthest = (center + _numbers[row::Reach]) * kNormalTolerance;
}

void ExactGeodeticBin::setMeridian(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    // Never negative: the latitudes end at the doubles nearest to the poles, which lie before them.
    _numbers[row::SinSouth] = std::sin(bin.latitude().lower);
    _numbers[row::CosSouth] = std::cos(bin.latitude().lower);
    _numbers[row::SinNorth] = std::sin(bin.latitude().upper);
    _numbers[row::CosNorth] = std::cos(bin.latitude().upper);
    // In the south and in the north, the top and the bottom.
    double* corner = &_numbers[row::Corners];
    const auto addCorner = [&](double sine, double cosine, double altitude) {
        const double n = ellipsoid.primeVerticalRadius(sine, cosine);
        *corner++ = (n + altitude) * cosine;
        *corner++ = (n * ellipsoid.squaredRatio() + altitude) * sine;
    };
    addCorner(_numbers[row::SinSouth], _numbers[row::CosSouth], bin.altitude().upper);
    addCorner(_numbers[row::SinSouth], _numbers[row::CosSouth], bin.altitude().lower);
    addCorner(_numbers[row::SinNorth], _numbers[row::CosNorth], bin.altitude().upper);
    addCorner(_numbers[row::SinNorth], _numbers[row::CosNorth], bin.altitude().lower);
}

void ExactGeodeticBin::setParallel(const GeodeticBin& bin) noexcept {
    const Interval& longitude = bin.longitude();
    _numbers[row::Longitudes] = bin.isFullCircle()         ? row::kFullCircle
                                : longitude.width() <= kPi ? row::kNarrow
                                                           : row::kWide;
    _numbers[row::CosWest] = std::cos(longitude.lower);
    _numbers[row::SinWest] = std::sin(longitude.lower);
    _numbers[row::CosEast] = std::cos(longitude.upper);
    _numbers[row::SinEast] = std::sin(longitude.upper);
    _numbers[row::CosMiddle] = std::cos(longitude.middle());
    _numbers[row::SinMiddle] = std::sin(longitude.middle());
}

// A sphere about a centre in the middle meridian plane. The distance from there grows with the longitude's distance
// from the middle and is convex in the altitude: it is largest on one of the four edges along the meridians west and
// east. Along these it is convex too when the bin is small enough; doc/theory/derivation.md, section 8.
void ExactGeodeticBin::setSphere(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    const auto ends = cornersOf(_numbers.data());
    // of half the width; the middle is rounded
    const double spread = std::max(0.0, std::cos(0.5 * bin.longitude().width()));
    double largestAxisDistance = 0.0;
    double axisDistance = 0.0;
    double z = 0.0;
    for (const glm::dvec2& end : ends) {
        largestAxisDistance = std::max(largestAxisDistance, end.x);
        axisDistance += 0.25 * spread * end.x;
        z += 0.25 * end.y;
    }
    const glm::dvec3 center(axisDistance * _numbers[row::CosMiddle], axisDistance * _numbers[row::SinMiddle], z);
    double farthest = 0.0;
    for (const glm::dvec2& end : ends) {
        const glm::dvec3 west(end.x * _numbers[row::CosWest], end.x * _numbers[row::SinWest], end.y);
        const glm::dvec3 east(end.x * _numbers[row::CosEast], end.x * _numbers[row::SinEast], end.y);
        farthest = std::max({farthest, glm::distance(center, west), glm::distance(center, east)});
    }
    // Between its ends, an edge leaves its chord by at most an eighth of its second derivative.
    const double bend = largestSlope(ellipsoid) + largestCurvatureRadius(ellipsoid) + farthestAltitude(bin.altitude());
    const double width = bin.latitude().width();
    const double sag = 0.125 * width * width * bend;
    const double tangent = smallestCurvatureRadius(ellipsoid) + bin.altitude().lower;
    const bool convex = (farthest + sag) * bend * kNormalTolerance < tangent * tangent;
    _numbers[row::CenterX] = center.x;
    _numbers[row::CenterY] = center.y;
    _numbers[row::CenterZ] = center.z;
    const double reach = (convex ? farthest : farthest + sag) * kNormalTolerance + 4.0 * _numbers[row::Slack];
    _numbers[row::Reach] = roundedUp(reach);
    // A parallel leaves its chord by r (1 - cos(width / 2)).
    const double parallelSag = (largestAxisDistance + sag) * (1.0 - spread);
    _numbers[row::Bulge] = _numbers[row::Longitudes] == row::kNarrow
                               ? (sag + parallelSag) * kNormalTolerance + _numbers[row::Slack]
                               : std::numeric_limits<double>::infinity();
}

double ExactGeodeticBin::support(const glm::dvec3& direction) const noexcept {
    return kernels::scalar::supportRange(_numbers.data(), direction.x, direction.y, direction.z).upper;
}

glm::dvec3 ExactGeodeticBin::supportPoint(const glm::dvec3& direction) const noexcept {
    const glm::dvec2 radial = farthestAlongParallel(_numbers.data(), direction.x, direction.y);
    const double c = direction.x * radial.x + direction.y * radial.y;
    const double nz = direction.z;
    const auto placed = [&](double axisDistance, double z) {
        return glm::dvec3(axisDistance * radial.x, axisDistance * radial.y, z);
    };
    const double rise = _numbers[row::CosSouth] * nz - _numbers[row::SinSouth] * c;
    const double fall = _numbers[row::CosNorth] * nz - _numbers[row::SinNorth] * c;
    if (rise > 0.0 && fall < 0.0) {
        // The normal of the surface there is the direction.
        const double a2 = _numbers[row::SquaredEquatorialRadius];
        const double b2 = _numbers[row::SquaredPolarRadius];
        const double surface = std::sqrt(a2 * c * c + b2 * nz * nz);
        const double up = _numbers[row::TopAltitude] / std::sqrt(c * c + nz * nz);
        return placed(c * (a2 / surface + up), nz * (b2 / surface + up));
    }
    const auto corners = cornersOf(_numbers.data());
    glm::dvec2 best = corners[0];
    for (const glm::dvec2& corner : corners) {
        if (c * corner.x + nz * corner.y > c * best.x + nz * best.y) best = corner;
    }
    return placed(best.x, best.y);
}

Side ExactGeodeticBin::classify(const Plane& plane) const noexcept {
    using namespace kernels::scalar;
    return sideOf(sidesOf<ExactForm>(_numbers.data(), onePlane(plane)));
}

Interval ExactGeodeticBin::distanceRange(const Plane& plane) const noexcept {
    const kernels::scalar::PlaneLanes<double> one = kernels::scalar::onePlane(plane);
    const kernels::scalar::Range<double> along = kernels::scalar::supportRange(_numbers.data(), one.nx, one.ny, one.nz);
    const double slack = kernels::scalar::slackOf(_numbers.data(), one);
    return {(plane.offset + along.lower) - slack, (plane.offset + along.upper) + slack};
}

}  // namespace osgAnalyticBin::core
