// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/IntervalNumber.h>
#include <osgAnalyticBin/mappings/Vec3.h>

#include <array>
#include <cstddef>

namespace osgAnalyticBin::core {

/// A number of the kind that formulas are written for, which carries enclosures of its Taylor coefficients up to the
/// third order in three variables: evaluated with it over a box, a formula encloses its own third derivatives there.
/// It has +, -, *, /, sqrt, exp, log, sin, cos, tan, atan and pow with an integer, found by argument-dependent lookup
/// (write `using std::sin; sin(u)`). It has no other functions, no comparisons and no way to a double: a formula that
/// cannot be enclosed does not compile.
/// Source: doc/theory/mappings.md, section 3.
/// Guarantee: coefficient i holds the derivative by monomial i, divided by the monomial's factorials, at every position
/// in the ranges of the variables; tests: AutodiffMapping.*.
class TaylorInterval final {
public:
    /// Monomials of degree 0; 1: u, v, w; 2: uu, vv, ww, uv, uw, vw; 3: uuu, vvv, www, uuv, uuw, uvv, vvw, uww, vww,
    /// uvw.
    static constexpr std::size_t kCoefficients = 20;
    /// Where the monomials of degree 3 begin.
    static constexpr std::size_t kFirstOfDegree3 = 10;

    /// A constant, exactly this number.
    TaylorInterval(double constant = 0.0) noexcept { _coefficients[0] = IntervalNumber(constant); }

    /// Variable 0, 1 or 2 over a range. A step of 1 in the Taylor series is `scale` in the variable.
    [[nodiscard]] static TaylorInterval variable(std::size_t index, const IntervalNumber& range, double scale) noexcept;

    /// Requires: i < kCoefficients.
    [[nodiscard]] const IntervalNumber& coefficient(std::size_t i) const noexcept { return _coefficients[i]; }

    /// @{
    /// By the rules of derivatives, monomial by monomial; undefined where a divisor may be zero.
    TaylorInterval operator-() const noexcept;
    TaylorInterval& operator+=(const TaylorInterval& other) noexcept { return *this = *this + other; }
    TaylorInterval& operator-=(const TaylorInterval& other) noexcept { return *this = *this - other; }
    TaylorInterval& operator*=(const TaylorInterval& other) noexcept { return *this = *this * other; }
    TaylorInterval& operator/=(const TaylorInterval& other) noexcept { return *this = *this / other; }

    friend TaylorInterval operator+(const TaylorInterval& a, const TaylorInterval& b) noexcept;
    friend TaylorInterval operator-(const TaylorInterval& a, const TaylorInterval& b) noexcept { return a + -b; }
    friend TaylorInterval operator*(const TaylorInterval& a, const TaylorInterval& b) noexcept;
    friend TaylorInterval operator/(const TaylorInterval& a, const TaylorInterval& b) noexcept;

    /// @}

    /// @{
    /// The function's own series at the value, composed; undefined outside of its domain.
    friend TaylorInterval sqrt(const TaylorInterval& x) noexcept;
    friend TaylorInterval exp(const TaylorInterval& x) noexcept;
    friend TaylorInterval log(const TaylorInterval& x) noexcept;
    friend TaylorInterval sin(const TaylorInterval& x) noexcept;
    friend TaylorInterval cos(const TaylorInterval& x) noexcept;
    friend TaylorInterval tan(const TaylorInterval& x) noexcept;
    friend TaylorInterval atan(const TaylorInterval& x) noexcept;
    friend TaylorInterval pow(const TaylorInterval& x, int exponent) noexcept;
    /// @}

    // Not with a real exponent, nor rounded to an integer behind the caller's back.
    friend TaylorInterval pow(const TaylorInterval& x, double exponent) = delete;

private:
    // A function's own Taylor coefficients, of degree 0 .. 3, over the range of its argument.
    using Series = std::array<IntervalNumber, 4>;

    [[nodiscard]] static TaylorInterval composed(const Series& outer, const TaylorInterval& inner) noexcept;

    std::array<IntervalNumber, kCoefficients> _coefficients{};
};

/// An upper bound of |D3f[s, s, s]| for |s_i| <= 1, from the enclosure of f's coefficients.
/// Returns: infinity when a coefficient is undefined.
[[nodiscard]] double thirdDifferentialBound(const Vec3<TaylorInterval>& f) noexcept;

/// How far a model with these derivatives, computed at the centre of a box, can be from the exact Taylor polynomial of
/// second order that `atCenter` encloses, anywhere in the box.
/// Requires: atCenter made of variables whose scales are the half sizes.
[[nodiscard]] double modelRounding(const Vec3<TaylorInterval>& atCenter, const glm::dvec3& value,
                                   const glm::dmat3& jacobian, const Hessians& hessians,
                                   const glm::dvec3& halfSize) noexcept;

}  // namespace osgAnalyticBin::core
