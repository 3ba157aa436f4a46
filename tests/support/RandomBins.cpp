// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

namespace {

using core::Ellipsoid;
using core::Geodetic;
using core::GeodeticBin;
using core::Interval;
using core::Plane;

constexpr double kSmallestAngle = 1e-12;

Interval around(double middle, double width) {
    return {middle - 0.5 * width, middle + 0.5 * width};
}

// An interval within the poles.
Interval latitudesFrom(double south, double width) {
    return {south, std::min(south + width, kHalfPi)};
}

double anyLatitude(Random& random) {
    return random.uniform(-kHalfPi, kHalfPi);
}
double anyLongitude(Random& random) {
    return random.uniform(-kPi, kPi);
}

Interval touchingAPole(Random& random, double width) {
    return random.chance(0.5) ? Interval{kHalfPi - width, kHalfPi} : Interval{-kHalfPi, -kHalfPi + width};
}

double randomEnd(Random& random, const Interval& interval) {
    if (random.chance(1.0 / 3.0)) return random.chance(0.5) ? interval.lower : interval.upper;
    return std::clamp(random.uniform(interval.lower, interval.upper), interval.lower, interval.upper);
}

glm::dvec3 randomPoint(Random& random, const BinOracle& bin) {
    return rounded(geodeticToEcef(bin.ellipsoid(), randomPosition(random, bin.bin())));
}

Plane through(const glm::dvec3& normal, const glm::dvec3& point, double distance) {
    return {normal, distance - glm::dot(normal, point)};
}

glm::dvec3 up(const Geodetic& position) {
    const double cosLat = std::cos(position.latitude);
    return {cosLat * std::cos(position.longitude), cosLat * std::sin(position.longitude), std::sin(position.latitude)};
}

// Directions whose extremum over the bin lies inside it, on its surface, or anywhere.
glm::dvec3 interestingDirection(Random& random, const BinOracle& bin) {
    if (random.chance(0.5)) return random.direction();
    const glm::dvec3 normal = up(randomPosition(random, bin.bin()));
    if (random.chance(0.5)) return random.sign() * normal;
    const double tilt = random.logUniform(1e-9, 1.0);
    return glm::normalize(random.sign() * normal + tilt * random.direction());
}

}  // namespace

const char* nameOf(BinKind kind) noexcept {
    constexpr const char* kNames[] = {"tile", "polar", "date line", "equator", "sliver",
                                      "tiny", "point", "near axis", "wide",    "whole globe"};
    return kNames[static_cast<std::size_t>(kind)];
}

Ellipsoid wgs84() noexcept {
    return Ellipsoid(6378137.0, 6356752.314245179);
}

Ellipsoid randomEllipsoid(Random& random) noexcept {
    switch (random.integer(0, 7)) {
        case 0:
            return Ellipsoid(6378137.0, 6356752.314140356);  // GRS 80
        case 1:
            return Ellipsoid(6371000.0, 6371000.0);
        case 2:
            return Ellipsoid(6356752.0, 6378137.0);
        case 3:
            return Ellipsoid(6378137.0, 6378137.0 * random.uniform(0.95, 1.05));
        case 4:
            return Ellipsoid(3396190.0, 3376200.0);
        default:
            return wgs84();
    }
}

Interval randomAltitude(Random& random) noexcept {
    switch (random.integer(0, 4)) {
        case 0:
            return kAllAltitudes;
        case 1:
            return {-500.0, 9000.0};
        case 2:
            return around(random.uniform(-10000.0, 9000.0), random.logUniform(1e-3, 2000.0));
        case 3: {
            const double altitude = random.uniform(kAllAltitudes.lower, kAllAltitudes.upper);
            return {altitude, altitude};
        }
        default: {
            const double first = random.uniform(kAllAltitudes.lower, kAllAltitudes.upper);
            const double second = random.uniform(kAllAltitudes.lower, kAllAltitudes.upper);
            return {std::min(first, second), std::max(first, second)};
        }
    }
}

GeodeticBin randomTile(Random& random, int level, Interval altitude) noexcept {
    const double tileDeg = std::ldexp(kRootTileDeg, -level);
    const int rows = 8 << level;
    const int columns = 16 << level;
    int row = random.integer(0, rows - 1);
    int column = random.integer(0, columns - 1);
    if (random.chance(1.0 / 6.0)) row = random.chance(0.5) ? 0 : rows - 1;
    if (random.chance(1.0 / 6.0)) column = random.chance(0.5) ? 0 : columns - 1;
    return GeodeticBin::fromDegrees({-90.0 + row * tileDeg, -90.0 + (row + 1) * tileDeg},
                                    {-180.0 + column * tileDeg, -180.0 + (column + 1) * tileDeg}, altitude);
}

GeodeticBin randomBin(Random& random, BinKind kind) noexcept {
    const Interval altitude = randomAltitude(random);
    const double width = random.logUniform(1e-6, kRootTileDeg * kRadiansPerDegree);
    switch (kind) {
        case BinKind::Tile:
            return randomTile(random, random.integer(0, kDeepestLevel), altitude);
        case BinKind::Polar:
            return GeodeticBin(touchingAPole(random, width), around(anyLongitude(random), random.uniform(0.0, 0.8)),
                               altitude);
        case BinKind::DateLine: {
            const double west = kPi - random.uniform(0.0, 1.0) * width;
            return GeodeticBin(latitudesFrom(anyLatitude(random), width), {west, west + width}, altitude);
        }
        case BinKind::Equator:
            return GeodeticBin({-random.uniform(0.0, 1.0) * width, random.uniform(0.0, 1.0) * width},
                               around(anyLongitude(random), width), altitude);
        case BinKind::Sliver: {
            const double thin = random.logUniform(kSmallestAngle, 1e-3);
            const bool alongMeridian = random.chance(0.5);
            return GeodeticBin(latitudesFrom(anyLatitude(random), alongMeridian ? width : thin),
                               around(anyLongitude(random), alongMeridian ? thin : width), altitude);
        }
        case BinKind::Tiny: {
            const double tiny = random.logUniform(kSmallestAngle, 1e-6);
            return GeodeticBin(latitudesFrom(anyLatitude(random), tiny), around(anyLongitude(random), tiny), altitude);
        }
        case BinKind::Point: {
            const double latitude = anyLatitude(random);
            const double longitude = anyLongitude(random);
            return GeodeticBin({latitude, latitude}, {longitude, longitude}, {altitude.lower, altitude.lower});
        }
        case BinKind::NearAxis:
            return GeodeticBin(touchingAPole(random, random.logUniform(kSmallestAngle, 1e-3)),
                               around(anyLongitude(random), random.uniform(0.0, 2.0 * kPi)), altitude);
        case BinKind::Wide: {
            const double south = anyLatitude(random);
            return GeodeticBin({south, random.uniform(south, kHalfPi)},
                               around(anyLongitude(random), random.uniform(0.3, 2.0 * kPi)), altitude);
        }
        case BinKind::WholeGlobe:
            return GeodeticBin::wholeGlobe(altitude);
    }
    return {};
}

Geodetic randomPosition(Random& random, const GeodeticBin& bin) noexcept {
    return {randomEnd(random, bin.latitude()), randomEnd(random, bin.longitude()), randomEnd(random, bin.altitude())};
}

double sizeOf(const Ellipsoid& ellipsoid, const GeodeticBin& bin) noexcept {
    const double angle = std::max(bin.latitude().width(), bin.longitude().width());
    return std::max({angle * ellipsoid.equatorialRadius(), bin.altitude().width(), 1e-3});
}

Plane randomPlane(Random& random, const BinOracle& bin, PlaneKind kind) noexcept {
    const double size = sizeOf(bin.ellipsoid(), bin.bin());
    const auto nearlyNothing = [&] { return random.sign() * random.logUniform(1e-9, size); };
    const glm::dvec3 normal = interestingDirection(random, bin);
    switch (kind) {
        case PlaneKind::Random:
            return through(normal, randomPoint(random, bin), random.uniform(-2.0, 2.0) * size);
        case PlaneKind::NearMaximum:
            return {normal, nearlyNothing() - static_cast<double>(bin.range(normal).upper)};
        case PlaneKind::NearMinimum:
            return {normal, nearlyNothing() - static_cast<double>(bin.range(normal).lower)};
        case PlaneKind::TangentToSurface: {
            Geodetic position = randomPosition(random, bin.bin());
            position.altitude = random.chance(0.5) ? bin.bin().altitude().upper : bin.bin().altitude().lower;
            const glm::dvec3 outward = random.sign() * up(position);
            return through(outward, rounded(geodeticToEcef(bin.ellipsoid(), position)), 0.0);
        }
        case PlaneKind::ThroughVertexEdgeOrFace:
            return through(normal, randomPoint(random, bin), 0.0);
        case PlaneKind::Far:
            return {normal, random.sign() * random.logUniform(1e8, 1e12)};
    }
    return {};
}

}  // namespace osgAnalyticBin::test
