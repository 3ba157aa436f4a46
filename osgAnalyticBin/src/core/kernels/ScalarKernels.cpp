// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ScalarKernels.h"

#include "PlaneKernels.h"

#include <cmath>

namespace osgAnalyticBin::core::kernels {

namespace {

// As the vector units do it.
double larger(double a, double b) noexcept {
    return a > b ? a : b;
}
double smaller(double a, double b) noexcept {
    return a < b ? a : b;
}

double alongPoint(const MeridianPoint& point, double c, double nz) noexcept {
    return point.axisDistance * c + point.z * nz;
}

// The largest and the smallest value of nx cos l + ny sin l over the longitudes.
Range rangeAlongParallel(const ExactBinData& bin, double nx, double ny) noexcept {
    // Value and slope at both ends.
    const double west = nx * bin.cosWest + ny * bin.sinWest;
    const double east = nx * bin.cosEast + ny * bin.sinEast;
    const double westSlope = ny * bin.cosWest - nx * bin.sinWest;
    const double eastSlope = ny * bin.cosEast - nx * bin.sinEast;
    Range range{smaller(west, east), larger(west, east)};
    // Over at most half a turn, an extremum lies within when the slope changes its sign.
    bool hasPeak = westSlope > 0.0 && eastSlope < 0.0;
    bool hasDip = westSlope < 0.0 && eastSlope > 0.0;
    // Wide bins: two arcs, or all.
    if (bin.longitudes == ExactBinData::Wide) {
        const double middle = nx * bin.cosMiddle + ny * bin.sinMiddle;
        const double middleSlope = ny * bin.cosMiddle - nx * bin.sinMiddle;
        range = {smaller(range.lower, middle), larger(range.upper, middle)};
        hasPeak = (westSlope > 0.0 && middleSlope < 0.0) || (middleSlope > 0.0 && eastSlope < 0.0);
        hasDip = (westSlope < 0.0 && middleSlope > 0.0) || (middleSlope < 0.0 && eastSlope > 0.0);
    } else if (bin.longitudes == ExactBinData::FullCircle) {
        hasPeak = true;
        hasDip = true;
    }
    // The extremum of the whole circle.
    if (hasPeak || hasDip) {
        const double length = std::sqrt(nx * nx + ny * ny);
        if (hasPeak) range.upper = length;
        if (hasDip) range.lower = -length;
    }
    return range;
}

// The ellipsoid's own support, raised by the upper altitude: the value where the surface normal is the direction.
double surfaceSupport(const ExactBinData& bin, double c, double nz) noexcept {
    const double cc = c * c;
    const double zz = nz * nz;
    return std::sqrt(bin.squaredEquatorialRadius * cc + bin.squaredPolarRadius * zz) +
           bin.topAltitude * std::sqrt(cc + zz);
}

double largestAlongMeridian(const ExactBinData& bin, double c, double nz) noexcept {
    const double rise = bin.cosSouth * nz - bin.sinSouth * c;
    const double fall = bin.cosNorth * nz - bin.sinNorth * c;
    if (rise > 0.0 && fall < 0.0) return surfaceSupport(bin, c, nz);
    return larger(larger(alongPoint(bin.topSouth, c, nz), alongPoint(bin.bottomSouth, c, nz)),
                  larger(alongPoint(bin.topNorth, c, nz), alongPoint(bin.bottomNorth, c, nz)));
}

double smallestAlongMeridian(const ExactBinData& bin, double c, double nz) noexcept {
    const double rise = bin.cosSouth * nz - bin.sinSouth * c;
    const double fall = bin.cosNorth * nz - bin.sinNorth * c;
    if (rise < 0.0 && fall > 0.0) return -surfaceSupport(bin, c, nz);
    return smaller(smaller(alongPoint(bin.topSouth, c, nz), alongPoint(bin.bottomSouth, c, nz)),
                   smaller(alongPoint(bin.topNorth, c, nz), alongPoint(bin.bottomNorth, c, nz)));
}

// Written so that NaN is Straddling.
LaneSide sideOf(double lower, double upper, double slack) noexcept {
    if (upper + slack < 0.0) return LaneSide::Outside;
    if (lower - slack >= 0.0) return LaneSide::Inside;
    return LaneSide::Straddling;
}

double dot(const Lane& plane, const double (&v)[3]) noexcept {
    return plane.nx * v[0] + plane.ny * v[1] + plane.nz * v[2];
}

void note(Verdict& verdict, LaneSide side, std::uint32_t bit) noexcept {
    if (side == LaneSide::Outside) verdict.outside |= bit;
    if (side == LaneSide::Inside) verdict.inside |= bit;
    if (side == LaneSide::Open) verdict.open |= bit;
}

template <class Test>
Verdict forEachPlane(const PlaneBlock* blocks, std::uint32_t mask, const Test& test) noexcept {
    Verdict verdict{};
    for (std::size_t i = 0; i < 32 && mask >> i != 0; ++i) {
        const std::uint32_t bit = std::uint32_t{1} << i;
        if (mask & bit) note(verdict, test(laneOf(blocks[i / PlaneBlock::kLanes], i % PlaneBlock::kLanes)), bit);
    }
    return verdict;
}

// The sphere over all planes, then the finer test over those it left.
template <class SphereTest, class FineTest>
Verdict inStages(const PlaneBlock* blocks, std::uint32_t undecided, const SphereTest& sphere,
                 const FineTest& fine) noexcept {
    const Verdict coarse = forEachPlane(blocks, undecided, sphere);
    if (coarse.outside != 0) return coarse;
    Verdict verdict = forEachPlane(blocks, undecided & ~coarse.inside, fine);
    verdict.inside |= coarse.inside;
    return verdict;
}

}  // namespace

Range supportRange(const ExactBinData& bin, double nx, double ny, double nz) noexcept {
    const Range c = rangeAlongParallel(bin, nx, ny);
    return {smallestAlongMeridian(bin, c.lower, nz), largestAlongMeridian(bin, c.upper, nz)};
}

double slackOf(const ExactBinData& bin, const Lane& plane) noexcept {
    // a quarter of 128 epsilon |offset|: doc/derivation.md, section 8
    return bin.slack + 0.25 * plane.rounding;
}

LaneSide sphereSide(const double (&center)[3], double reach, const Lane& plane) noexcept {
    const double distance = dot(plane, center) + plane.offset;
    if (distance - plane.rounding >= reach) return LaneSide::Inside;
    if (distance + plane.rounding < -reach) return LaneSide::Outside;
    return LaneSide::Straddling;
}

LaneSide exactSide(const ExactBinData& bin, const Lane& plane) noexcept {
    const Range along = supportRange(bin, plane.nx, plane.ny, plane.nz);
    return sideOf(plane.offset + along.lower, plane.offset + along.upper, slackOf(bin, plane));
}

LaneSide quadraticSide(const QuadraticBinData& bin, const Lane& plane) noexcept {
    enum : std::size_t { kUU, kVV, kWW, kUV, kUW, kVW };
    // The polynomial, [JJ] eq. (3).
    const double value = dot(plane, bin.value) + plane.offset;
    const double g[3] = {dot(plane, bin.first[0]), dot(plane, bin.first[1]), dot(plane, bin.first[2])};
    double h[6];
    for (std::size_t i = 0; i < 6; ++i) h[i] = dot(plane, bin.second[i]);
    const double slack = bin.remainder + plane.rounding;
    // Every term by itself; a square lies in [0, 1].
    const double spread =
        std::abs(g[0]) + std::abs(g[1]) + std::abs(g[2]) + std::abs(h[kUV]) + std::abs(h[kUW]) + std::abs(h[kVW]);
    const double below = 0.5 * smaller(h[kUU], 0.0) + 0.5 * smaller(h[kVV], 0.0) + 0.5 * smaller(h[kWW], 0.0);
    const double above = 0.5 * larger(h[kUU], 0.0) + 0.5 * larger(h[kVV], 0.0) + 0.5 * larger(h[kWW], 0.0);
    const LaneSide bounded = sideOf(value - spread + below, value + spread + above, slack);
    if (bounded != LaneSide::Straddling) return bounded;
    // The corners along and against the gradient: values that are attained. When the plane passes between them, the
    // exact range could not say anything else.
    const double u = std::copysign(1.0, g[0]);
    const double v = std::copysign(1.0, g[1]);
    const double w = std::copysign(1.0, g[2]);
    const double slope = std::abs(g[0]) + std::abs(g[1]) + std::abs(g[2]);
    const double even = 0.5 * (h[kUU] + h[kVV] + h[kWW]) + (h[kUV] * (u * v) + h[kUW] * (u * w) + h[kVW] * (v * w));
    const LaneSide attained = sideOf(value - slope + even, value + slope + even, slack);
    return attained == LaneSide::Straddling ? LaneSide::Straddling : LaneSide::Open;
}

Verdict exactScalar(const ExactBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(
        blocks, undecided, [&](const Lane& plane) { return sphereSide(bin.center, bin.reach, plane); },
        [&](const Lane& plane) { return exactSide(bin, plane); });
}

Verdict quadraticScalar(const QuadraticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(
        blocks, undecided, [&](const Lane& plane) { return sphereSide(bin.value, bin.reach, plane); },
        [&](const Lane& plane) { return quadraticSide(bin, plane); });
}

#ifndef OSGANALYTICBIN_SIMD
PlaneKernels activeKernels{exactScalar, quadraticScalar};

void chooseKernels() noexcept {}
#endif

}  // namespace osgAnalyticBin::core::kernels
