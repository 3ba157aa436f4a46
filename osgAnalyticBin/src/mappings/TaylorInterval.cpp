// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/mappings/TaylorInterval.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

constexpr std::size_t kSize = TaylorInterval::kCoefficients;
// Bounds below are sums and products of some forty rounded terms.
constexpr double kRoundUp = 1.0 + 1e-13;

struct Monomial {
    int u, v, w;
    [[nodiscard]] constexpr int degree() const { return u + v + w; }
};

constexpr std::array<Monomial, kSize> kMonomials{
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1},
     {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {0, 2, 1}, {1, 0, 2}, {0, 1, 2}, {1, 1, 1}}};

using ProductTable = std::array<std::array<std::size_t, kSize>, kSize>;

// Index of the product of two monomials; kSize beyond the third degree.
constexpr ProductTable makeProductTable() {
    ProductTable table{};
    for (std::size_t i = 0; i < kSize; ++i) {
        for (std::size_t j = 0; j < kSize; ++j) {
            table[i][j] = kSize;
            for (std::size_t k = 0; k < kSize; ++k) {
                if (kMonomials[k].u == kMonomials[i].u + kMonomials[j].u &&
                    kMonomials[k].v == kMonomials[i].v + kMonomials[j].v &&
                    kMonomials[k].w == kMonomials[i].w + kMonomials[j].w) {
                    table[i][j] = k;
                }
            }
        }
    }
    return table;
}

constexpr ProductTable kProducts = makeProductTable();

// The largest distance of a point of the interval from a number.
double deviation(const IntervalNumber& enclosure, double computed) {
    return std::max(std::abs(enclosure.lower() - computed), std::abs(enclosure.upper() - computed));
}

double deviation(const Vec3<TaylorInterval>& f, std::size_t i, const glm::dvec3& computed) {
    return deviation(f.x.coefficient(i), computed.x) + deviation(f.y.coefficient(i), computed.y) +
           deviation(f.z.coefficient(i), computed.z);
}

}  // namespace

TaylorInterval TaylorInterval::variable(std::size_t index, const IntervalNumber& range, double scale) noexcept {
    TaylorInterval result;
    result._coefficients[0] = range;
    result._coefficients[1 + index] = IntervalNumber(scale);
    return result;
}

TaylorInterval TaylorInterval::operator-() const noexcept {
    TaylorInterval result;
    for (std::size_t i = 0; i < kSize; ++i) result._coefficients[i] = -_coefficients[i];
    return result;
}

TaylorInterval operator+(const TaylorInterval& a, const TaylorInterval& b) noexcept {
    TaylorInterval result;
    for (std::size_t i = 0; i < kSize; ++i) result._coefficients[i] = a._coefficients[i] + b._coefficients[i];
    return result;
}

TaylorInterval operator*(const TaylorInterval& a, const TaylorInterval& b) noexcept {
    TaylorInterval result;
    for (std::size_t i = 0; i < kSize; ++i) {
        for (std::size_t j = 0; j < kSize; ++j) {
            const std::size_t k = kProducts[i][j];
            if (k < kSize) result._coefficients[k] = result._coefficients[k] + a._coefficients[i] * b._coefficients[j];
        }
    }
    return result;
}

TaylorInterval operator/(const TaylorInterval& a, const TaylorInterval& b) noexcept {
    const IntervalNumber r = 1.0 / b._coefficients[0];
    const IntervalNumber r2 = pow(r, 2);
    return a * TaylorInterval::composed({r, -r2, pow(r, 3), -pow(r, 4)}, b);
}

TaylorInterval TaylorInterval::composed(const Series& outer, const TaylorInterval& inner) noexcept {
    // Without its value, the inner number is nilpotent: its fourth power has no term of degree 3 or less.
    TaylorInterval step = inner;
    step._coefficients[0] = IntervalNumber(0.0);
    TaylorInterval result;
    result._coefficients[0] = outer[0];
    TaylorInterval power = step;
    for (std::size_t k = 1; k < outer.size(); ++k) {
        for (std::size_t i = 1; i < kSize; ++i) {
            result._coefficients[i] = result._coefficients[i] + outer[k] * power._coefficients[i];
        }
        if (k + 1 < outer.size()) power = power * step;
    }
    return result;
}

TaylorInterval sqrt(const TaylorInterval& x) noexcept {
    const IntervalNumber& a = x._coefficients[0];
    const IntervalNumber s = sqrt(a);
    const IntervalNumber r = 1.0 / s;
    return TaylorInterval::composed({s, r * 0.5, pow(r, 3) * -0.125, pow(r, 5) * 0.0625}, x);
}

TaylorInterval exp(const TaylorInterval& x) noexcept {
    const IntervalNumber e = exp(x._coefficients[0]);
    return TaylorInterval::composed({e, e, e * 0.5, e / 6.0}, x);
}

TaylorInterval log(const TaylorInterval& x) noexcept {
    const IntervalNumber& a = x._coefficients[0];
    const IntervalNumber r = 1.0 / a;
    return TaylorInterval::composed({log(a), r, pow(r, 2) * -0.5, pow(r, 3) / 3.0}, x);
}

TaylorInterval sin(const TaylorInterval& x) noexcept {
    const IntervalNumber s = sin(x._coefficients[0]);
    const IntervalNumber c = cos(x._coefficients[0]);
    return TaylorInterval::composed({s, c, s * -0.5, c / -6.0}, x);
}

TaylorInterval cos(const TaylorInterval& x) noexcept {
    const IntervalNumber s = sin(x._coefficients[0]);
    const IntervalNumber c = cos(x._coefficients[0]);
    return TaylorInterval::composed({c, -s, c * -0.5, s / 6.0}, x);
}

TaylorInterval tan(const TaylorInterval& x) noexcept {
    const IntervalNumber t = tan(x._coefficients[0]);
    const IntervalNumber slope = pow(t, 2) + 1.0;
    return TaylorInterval::composed({t, slope, t * slope, slope * (pow(t, 2) * 3.0 + 1.0) / 3.0}, x);
}

TaylorInterval atan(const TaylorInterval& x) noexcept {
    const IntervalNumber& a = x._coefficients[0];
    const IntervalNumber slope = 1.0 / (pow(a, 2) + 1.0);
    return TaylorInterval::composed({atan(a), slope, -a * pow(slope, 2), (pow(a, 2) * 3.0 - 1.0) * pow(slope, 3) / 3.0},
                                    x);
}

TaylorInterval pow(const TaylorInterval& x, int exponent) noexcept {
    TaylorInterval::Series series{};
    IntervalNumber binomial(1.0);
    for (int k = 0; k < 4 && (exponent < 0 || k <= exponent); ++k) {
        series[static_cast<std::size_t>(k)] = binomial * pow(x._coefficients[0], exponent - k);
        binomial = binomial * (static_cast<double>(exponent) - k) / (k + 1.0);
    }
    return TaylorInterval::composed(series, x);
}

double thirdDifferentialBound(const Vec3<TaylorInterval>& f) noexcept {
    // Both are bounds: coordinate by coordinate, and monomial by monomial.
    glm::dvec3 coordinates(0.0);
    double monomials = 0.0;
    for (std::size_t i = TaylorInterval::kFirstOfDegree3; i < kSize; ++i) {
        const glm::dvec3 size(f.x.coefficient(i).magnitude(), f.y.coefficient(i).magnitude(),
                              f.z.coefficient(i).magnitude());
        coordinates += size;
        monomials += std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z);
    }
    const double coordinatewise =
        std::sqrt(coordinates.x * coordinates.x + coordinates.y * coordinates.y + coordinates.z * coordinates.z);
    // A differential is the factorial, 6, times the sum of Taylor terms. NaN must not be lost in the minimum.
    if (std::isnan(coordinatewise + monomials)) return std::numeric_limits<double>::infinity();
    return 6.0 * std::min(coordinatewise, monomials) * kRoundUp;
}

double modelRounding(const Vec3<TaylorInterval>& atCenter, const glm::dvec3& value, const glm::dmat3& jacobian,
                     const Hessians& hessians, const glm::dvec3& halfSize) noexcept {
    const glm::dvec3& e = halfSize;
    const std::array<glm::dvec3, TaylorInterval::kFirstOfDegree3> computed{value,
                                                                           jacobian[0] * e.x,
                                                                           jacobian[1] * e.y,
                                                                           jacobian[2] * e.z,
                                                                           hessians.uu * (0.5 * e.x * e.x),
                                                                           hessians.vv * (0.5 * e.y * e.y),
                                                                           hessians.ww * (0.5 * e.z * e.z),
                                                                           hessians.uv * (e.x * e.y),
                                                                           hessians.uw * (e.x * e.z),
                                                                           hessians.vw * (e.y * e.z)};
    double sum = 0.0;
    for (std::size_t i = 0; i < computed.size(); ++i) sum += deviation(atCenter, i, computed[i]);
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum * kRoundUp;
}

}  // namespace osgAnalyticBin::core
