// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osgAnalyticBin::core {

/// A number known to lie between two doubles. Arithmetic and functions return an interval that holds every result for
/// arguments within the given ones, rounding included. Where a result has no finite bounds (division by an interval
/// with zero, the logarithm of a negative number, overflow) it is undefined, and so is all that is computed from it.
/// Source: doc/theory/mappings.md, section 2.
/// Guarantee: holds with a C library whose elementary functions are right to 4 ulps (glibc states at most 2);
/// tests: IntervalNumber.*.
class IntervalNumber final {
public:
    /// A point; undefined unless finite. Implicit, so that formulas may mix numbers.
    IntervalNumber(double value = 0.0) noexcept : IntervalNumber(value, value) {}

    /// Undefined unless lower <= upper and both are finite.
    IntervalNumber(double lower, double upper) noexcept;

    /// The number without bounds: NaN at both ends.
    [[nodiscard]] static IntervalNumber undefined() noexcept;

    /// NaN when undefined.
    [[nodiscard]] double lower() const noexcept { return _lower; }
    /// NaN when undefined.
    [[nodiscard]] double upper() const noexcept { return _upper; }
    /// Whether it has finite bounds.
    [[nodiscard]] bool isDefined() const noexcept { return _lower <= _upper; }
    /// Whether it is exactly the number 0.
    [[nodiscard]] bool isZero() const noexcept { return _lower == 0.0 && _upper == 0.0; }

    /// The largest absolute value; NaN when undefined.
    [[nodiscard]] double magnitude() const noexcept;

    /// Exact.
    IntervalNumber operator-() const noexcept;

    /// @{
    /// Encloses the result for every number of either operand; undefined where a divisor may be zero.
    friend IntervalNumber operator+(const IntervalNumber& a, const IntervalNumber& b) noexcept;
    friend IntervalNumber operator-(const IntervalNumber& a, const IntervalNumber& b) noexcept { return a + -b; }
    friend IntervalNumber operator*(const IntervalNumber& a, const IntervalNumber& b) noexcept;
    friend IntervalNumber operator/(const IntervalNumber& a, const IntervalNumber& b) noexcept;

    /// @}

    /// @{
    /// Encloses the function over all numbers of the argument; undefined outside of its domain.
    friend IntervalNumber sqrt(const IntervalNumber& x) noexcept;
    friend IntervalNumber exp(const IntervalNumber& x) noexcept;
    friend IntervalNumber log(const IntervalNumber& x) noexcept;
    friend IntervalNumber sin(const IntervalNumber& x) noexcept;
    friend IntervalNumber cos(const IntervalNumber& x) noexcept;
    friend IntervalNumber tan(const IntervalNumber& x) noexcept;
    friend IntervalNumber atan(const IntervalNumber& x) noexcept;
    friend IntervalNumber pow(const IntervalNumber& x, int exponent) noexcept;
    /// @}

private:
    double _lower;
    double _upper;
};

}  // namespace osgAnalyticBin::core
