// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../core/Constants.h"

#include <osgAnalyticBin/mappings/IntervalNumber.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

constexpr double kTiny = std::numeric_limits<double>::denorm_min();
// Results of +, -, *, / and sqrt are rounded once; the library's functions are accurate to 4 ulps.
constexpr double kOneRounding = kEpsilon;
constexpr double kLibraryRounding = 5.0 * kEpsilon;
// Larger arguments are not reduced: sines are then in [-1, 1], tangents undefined.
constexpr double kLargestAngle = 1e6;
// Far above the rounding error of a number of turns below kLargestAngle.
constexpr double kTurnSlack = 1e-9;
// Powers are computed as products of at most this many factors.
constexpr int kLargestExponent = 64;

// An infinite bound becomes NaN here, which the constructor turns into an undefined number.
IntervalNumber widened(double lower, double upper, double relative) noexcept {
    return {lower - (std::abs(lower) * relative + kTiny), upper + (std::abs(upper) * relative + kTiny)};
}

// Whether the interval may contain phase + k period for an integer k.
bool mayContain(const IntervalNumber& x, double phase, double period) noexcept {
    const double first = std::ceil((x.lower() - phase) / period - kTurnSlack);
    return first <= (x.upper() - phase) / period + kTurnSlack;
}

// A sine or cosine by its values at the two ends and the places of its maxima.
IntervalNumber wave(const IntervalNumber& x, double atLower, double atUpper, double maximumPhase) noexcept {
    if (!x.isDefined()) return x;
    if (std::max(std::abs(x.lower()), std::abs(x.upper())) > kLargestAngle) return {-1.0, 1.0};
    const IntervalNumber ends = widened(std::min(atLower, atUpper), std::max(atLower, atUpper), kLibraryRounding);
    const bool maximum = mayContain(x, maximumPhase, 2.0 * kPi);
    const bool minimum = mayContain(x, maximumPhase + kPi, 2.0 * kPi);
    return {minimum ? -1.0 : std::max(ends.lower(), -1.0), maximum ? 1.0 : std::min(ends.upper(), 1.0)};
}

IntervalNumber pointPower(double x, int exponent) noexcept {
    IntervalNumber result(1.0);
    const IntervalNumber factor(x);
    for (int i = 0; i < exponent; ++i) result = result * factor;
    return result;
}

}  // namespace

IntervalNumber::IntervalNumber(double lower, double upper) noexcept : _lower(lower), _upper(upper) {
    if (lower <= upper && std::isfinite(lower) && std::isfinite(upper)) return;
    _lower = _upper = std::numeric_limits<double>::quiet_NaN();
}

IntervalNumber IntervalNumber::undefined() noexcept {
    return {1.0, -1.0};
}

double IntervalNumber::magnitude() const noexcept {
    return std::max(std::abs(_lower), std::abs(_upper));
}

IntervalNumber IntervalNumber::operator-() const noexcept {
    return {-_upper, -_lower};
}

IntervalNumber operator+(const IntervalNumber& a, const IntervalNumber& b) noexcept {
    // Exact, and keeps zeros zero.
    if (a.isZero()) return b;
    if (b.isZero()) return a;
    return widened(a._lower + b._lower, a._upper + b._upper, kOneRounding);
}

IntervalNumber operator*(const IntervalNumber& a, const IntervalNumber& b) noexcept {
    if (!a.isDefined() || !b.isDefined()) return IntervalNumber::undefined();
    if (a.isZero() || b.isZero()) return {};
    const double ll = a._lower * b._lower;
    const double lu = a._lower * b._upper;
    const double ul = a._upper * b._lower;
    const double uu = a._upper * b._upper;
    return widened(std::min(std::min(ll, lu), std::min(ul, uu)), std::max(std::max(ll, lu), std::max(ul, uu)),
                   kOneRounding);
}

IntervalNumber operator/(const IntervalNumber& a, const IntervalNumber& b) noexcept {
    if (!(b._lower > 0.0 || b._upper < 0.0)) return IntervalNumber::undefined();
    return a * widened(1.0 / b._upper, 1.0 / b._lower, kOneRounding);
}

IntervalNumber sqrt(const IntervalNumber& x) noexcept {
    if (!(x._lower >= 0.0)) return IntervalNumber::undefined();
    const IntervalNumber root = widened(std::sqrt(x._lower), std::sqrt(x._upper), kOneRounding);
    return {std::max(root._lower, 0.0), root._upper};
}

IntervalNumber exp(const IntervalNumber& x) noexcept {
    const IntervalNumber power = widened(std::exp(x._lower), std::exp(x._upper), kLibraryRounding);
    return power.isDefined() ? IntervalNumber(std::max(power._lower, 0.0), power._upper) : power;
}

IntervalNumber log(const IntervalNumber& x) noexcept {
    if (!(x._lower > 0.0)) return IntervalNumber::undefined();
    return widened(std::log(x._lower), std::log(x._upper), kLibraryRounding);
}

IntervalNumber sin(const IntervalNumber& x) noexcept {
    return wave(x, std::sin(x._lower), std::sin(x._upper), 0.5 * kPi);
}

IntervalNumber cos(const IntervalNumber& x) noexcept {
    return wave(x, std::cos(x._lower), std::cos(x._upper), 0.0);
}

IntervalNumber tan(const IntervalNumber& x) noexcept {
    if (!(x.magnitude() <= kLargestAngle) || mayContain(x, 0.5 * kPi, kPi)) return IntervalNumber::undefined();
    return widened(std::tan(x._lower), std::tan(x._upper), kLibraryRounding);
}

IntervalNumber atan(const IntervalNumber& x) noexcept {
    return widened(std::atan(x._lower), std::atan(x._upper), kLibraryRounding);
}

IntervalNumber pow(const IntervalNumber& x, int exponent) noexcept {
    if (!x.isDefined()) return x;
    if (exponent < 0) return exponent < -kLargestExponent ? IntervalNumber::undefined() : 1.0 / pow(x, -exponent);
    if (exponent > kLargestExponent) return IntervalNumber::undefined();
    const IntervalNumber lower = pointPower(x._lower, exponent);
    const IntervalNumber upper = pointPower(x._upper, exponent);
    if (!lower.isDefined() || !upper.isDefined()) return IntervalNumber::undefined();
    if (exponent % 2 == 1 || exponent == 0) return {lower._lower, upper._upper};
    const bool hasZero = x._lower <= 0.0 && x._upper >= 0.0;
    const double least = hasZero ? 0.0 : std::max(0.0, std::min(lower._lower, upper._lower));
    return {least, std::max(lower._upper, upper._upper)};
}

}  // namespace osgAnalyticBin::core
