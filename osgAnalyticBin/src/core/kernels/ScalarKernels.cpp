// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ScalarKernels.h"

#include "PlaneKernels.h"
#include "ScalarTests.h"

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

double largestCorner(const ExactBinData& bin, double c, double nz) noexcept {
    return larger(larger(alongPoint(bin.topSouth, c, nz), alongPoint(bin.bottomSouth, c, nz)),
                  larger(alongPoint(bin.topNorth, c, nz), alongPoint(bin.bottomNorth, c, nz)));
}

double smallestCorner(const ExactBinData& bin, double c, double nz) noexcept {
    return smaller(smaller(alongPoint(bin.topSouth, c, nz), alongPoint(bin.bottomSouth, c, nz)),
                   smaller(alongPoint(bin.topNorth, c, nz), alongPoint(bin.bottomNorth, c, nz)));
}

double largestAlongMeridian(const ExactBinData& bin, double c, double nz) noexcept {
    const double rise = bin.cosSouth * nz - bin.sinSouth * c;
    const double fall = bin.cosNorth * nz - bin.sinNorth * c;
    return rise > 0.0 && fall < 0.0 ? surfaceSupport(bin, c, nz) : largestCorner(bin, c, nz);
}

double smallestAlongMeridian(const ExactBinData& bin, double c, double nz) noexcept {
    const double rise = bin.cosSouth * nz - bin.sinSouth * c;
    const double fall = bin.cosNorth * nz - bin.sinNorth * c;
    return rise < 0.0 && fall > 0.0 ? -surfaceSupport(bin, c, nz) : smallestCorner(bin, c, nz);
}

// Written so that NaN is Straddling.
LaneSide sideOf(double lower, double upper, double slack) noexcept {
    if (upper + slack < 0.0) return LaneSide::Outside;
    if (lower - slack >= 0.0) return LaneSide::Inside;
    return LaneSide::Straddling;
}

// The same for bounds that are attained and may be exceeded by the bulge. The tests are those of the vector form:
// neither outside nor inside by the bulging bounds, and by the attained ones neither.
LaneSide hullSideOf(double lower, double upper, double bulge, double slack) noexcept {
    const LaneSide bounded = sideOf(lower - bulge, upper + bulge, slack);
    if (bounded != LaneSide::Straddling) return bounded;
    return sideOf(lower, upper, slack) == LaneSide::Straddling ? LaneSide::Straddling : LaneSide::Open;
}

double dot(const Lane& plane, const double (&v)[3]) noexcept {
    return plane.nx * v[0] + plane.ny * v[1] + plane.nz * v[2];
}

// Summed as a tree: the first test's result is waited for.
double distanceTo(const Lane& plane, const double (&v)[3]) noexcept {
    return (plane.nx * v[0] + plane.ny * v[1]) + (plane.nz * v[2] + plane.offset);
}

void note(Verdict& verdict, LaneSide side, std::uint32_t bit) noexcept {
    if (side == LaneSide::Outside) verdict.sides |= bit;
    if (side == LaneSide::Inside) verdict.sides |= std::uint64_t{bit} << 32;
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

template <class Bin>
Verdict inStages(const Bin& bin, const SphereData& sphere, const PlaneBlock* blocks, std::uint32_t undecided) noexcept {
    Verdict verdict = forEachPlane(blocks, undecided, [&](const Lane& plane) { return sphereSide(sphere, plane); });
    const auto next = [&](LaneSide (*test)(const Bin&, const Lane&) noexcept) {
        if (verdict.outside() != 0 || verdict.open == 0) return;
        const auto open = static_cast<std::uint32_t>(verdict.open);
        const Verdict finer = forEachPlane(blocks, open, [&](const Lane& plane) { return test(bin, plane); });
        verdict = {verdict.sides | finer.sides, finer.open};
    };
    next(hullSide);
    next(fullSide);
    if (verdict.outside() != 0) verdict.open = 0;
    return verdict;
}

}  // namespace

namespace scalar {

#define INLINE inline
#define NOINLINE inline
#define ATTRIBUTES
#include "FamilyStages.inl"
#undef INLINE
#undef NOINLINE
#undef ATTRIBUTES

}  // namespace scalar

void familyScalar(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict) {
    scalar::classifyFamily<double, double>(family, blocks, masks, verdict);
}

std::uint64_t hiddenScalar(const FamilyData& family, const HorizonEyeData& eye, std::uint64_t candidates) {
    return scalar::hiddenOfFamily<double, double>(family, eye, candidates);
}

Range supportRange(const ExactBinData& bin, double nx, double ny, double nz) noexcept {
    const Range c = rangeAlongParallel(bin, nx, ny);
    return {smallestAlongMeridian(bin, c.lower, nz), largestAlongMeridian(bin, c.upper, nz)};
}

double slackOf(const ExactBinData& bin, const Lane& plane) noexcept {
    // a quarter of 128 epsilon |offset|: doc/derivation.md, section 8
    return bin.slack + 0.25 * plane.rounding;
}

LaneSide sphereSide(const SphereData& sphere, const Lane& plane) noexcept {
    const double distance = distanceTo(plane, sphere.center);
    const double threshold = static_cast<double>(sphere.reach) + plane.rounding;
    if (distance >= threshold) return LaneSide::Inside;
    if (distance < -threshold) return LaneSide::Outside;
    return LaneSide::Open;
}

LaneSide hullSide(const ExactBinData& bin, const Lane& plane) noexcept {
    // The longitudes' ends, then the corners.
    const double west = plane.nx * bin.cosWest + plane.ny * bin.sinWest;
    const double east = plane.nx * bin.cosEast + plane.ny * bin.sinEast;
    const Range c{smaller(west, east), larger(west, east)};
    const Range along{smallestCorner(bin, c.lower, plane.nz), largestCorner(bin, c.upper, plane.nz)};
    return hullSideOf(plane.offset + along.lower, plane.offset + along.upper, bin.bulge, slackOf(bin, plane));
}

LaneSide fullSide(const ExactBinData& bin, const Lane& plane) noexcept {
    const Range along = supportRange(bin, plane.nx, plane.ny, plane.nz);
    return sideOf(plane.offset + along.lower, plane.offset + along.upper, slackOf(bin, plane));
}

LaneSide hullSide(const QuadraticBinData& bin, const Lane& plane) noexcept {
    // Value and gradient of the polynomial, [JJ] eq. (3).
    const double value = distanceTo(plane, bin.sphere.center);
    const double slope =
        std::abs(dot(plane, bin.first[0])) + std::abs(dot(plane, bin.first[1])) + std::abs(dot(plane, bin.first[2]));
    const double slack = bin.remainder + plane.rounding;
    // The corners along and against the gradient are attained to the curvature, and exceeded by no more.
    const auto curvature = static_cast<double>(bin.sphere.curvature);
    const LaneSide bounded = sideOf((value - slope) - curvature, (value + slope) + curvature, slack);
    if (bounded != LaneSide::Straddling) return bounded;
    const LaneSide attained = sideOf((value - slope) + curvature, (value + slope) - curvature, slack);
    return attained == LaneSide::Straddling ? LaneSide::Straddling : LaneSide::Open;
}

LaneSide fullSide(const QuadraticBinData& bin, const Lane& plane) noexcept {
    enum : std::size_t { kUU, kVV, kWW, kUV, kUW, kVW };
    // The polynomial, [JJ] eq. (3).
    const double value = distanceTo(plane, bin.sphere.center);
    const double slope =
        std::abs(dot(plane, bin.first[0])) + std::abs(dot(plane, bin.first[1])) + std::abs(dot(plane, bin.first[2]));
    double h[6];
    for (std::size_t i = 0; i < 6; ++i) h[i] = dot(plane, bin.second[i]);
    const double slack = bin.remainder + plane.rounding;
    // Every term by itself; a square lies in [0, 1].
    const double mixed = std::abs(h[kUV]) + std::abs(h[kUW]) + std::abs(h[kVW]);
    const double below = 0.5 * (smaller(h[kUU], 0.0) + smaller(h[kVV], 0.0) + smaller(h[kWW], 0.0));
    const double above = 0.5 * (larger(h[kUU], 0.0) + larger(h[kVV], 0.0) + larger(h[kWW], 0.0));
    const LaneSide bounded = sideOf(value - slope - mixed + below, value + slope + mixed + above, slack);
    if (bounded != LaneSide::Straddling) return bounded;
    // The corners along and against the gradient are attained to the mixed terms. When the plane passes between them,
    // the exact range could not say anything else.
    const double squares = 0.5 * (h[kUU] + h[kVV] + h[kWW]);
    const LaneSide attained = sideOf(value - slope + mixed + squares, value + slope - mixed + squares, slack);
    return attained == LaneSide::Straddling ? LaneSide::Straddling : LaneSide::Open;
}

LaneSide hullSide(const GeodeticBinData& bin, const Lane& plane) noexcept {
    return bin.isExact() ? hullSide(bin.exact, plane) : hullSide(bin.quadratic, plane);
}

LaneSide fullSide(const GeodeticBinData& bin, const Lane& plane) noexcept {
    return bin.isExact() ? fullSide(bin.exact, plane) : fullSide(bin.quadratic, plane);
}

Verdict exactScalar(const ExactBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin, bin.sphere, blocks, undecided);
}

Verdict quadraticScalar(const QuadraticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin, bin.sphere, blocks, undecided);
}

Verdict geodeticScalar(const GeodeticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin, bin.sphere(), blocks, undecided);
}

#ifndef OSGANALYTICBIN_SIMD
PlaneKernels activeKernels{exactScalar, quadraticScalar, geodeticScalar, familyScalar, hiddenScalar};

void chooseKernels() noexcept {}
#endif

}  // namespace osgAnalyticBin::core::kernels
