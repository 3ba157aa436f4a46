// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracle: the stationary points of the cube, its faces and its edges, solved in long double by elimination with
// pivoting, and its vertices.

#include "CoreTest.h"

#include <osgAnalyticBin/core/bin/QuadraticRange.h>

namespace osgAnalyticBin::test {
namespace {

using core::exactRange;
using core::Quadratic;

using Vector = std::array<Real, 3>;
using Matrix = std::array<Vector, 3>;

constexpr double kRangePromised = 64.0 * std::numeric_limits<double>::epsilon();  // by exactRange

Matrix matrixOf(const Quadratic& q) {
    const auto& h = q.hessian;
    return {{{h[0], h[3], h[4]}, {h[3], h[1], h[5]}, {h[4], h[5], h[2]}}};
}

Real valueAt(const Quadratic& q, const Vector& x) {
    const Matrix h = matrixOf(q);
    Real value = q.value;
    for (std::size_t i = 0; i < 3; ++i) {
        value += q.gradient[i] * x[i];
        for (std::size_t j = 0; j < 3; ++j) value += h[i][j] * x[i] * x[j] / 2;
    }
    return value;
}

double magnitudeOf(const Quadratic& q) {
    double sum = std::abs(q.value);
    for (const double g : q.gradient) sum += std::abs(g);
    for (const double h : q.hessian) sum += std::abs(h);
    return sum;
}

// Solves for the free coordinates of a stationary point, the others being fixed. False when singular.
bool stationary(const Quadratic& q, const std::array<bool, 3>& isFree, Vector& x) {
    const Matrix h = matrixOf(q);
    std::array<std::array<Real, 4>, 3> rows{};
    std::array<std::size_t, 3> unknown{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (isFree[i]) unknown[n++] = i;
    for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t c = 0; c < n; ++c) rows[r][c] = h[unknown[r]][unknown[c]];
        rows[r][n] = -static_cast<Real>(q.gradient[unknown[r]]);
        for (std::size_t j = 0; j < 3; ++j)
            if (!isFree[j]) rows[r][n] -= h[unknown[r]][j] * x[j];
    }
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < n; ++r)
            if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
        if (rows[pivot][c] == 0) return false;
        std::swap(rows[c], rows[pivot]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == c) continue;
            const Real factor = rows[r][c] / rows[c][c];
            for (std::size_t k = c; k <= n; ++k) rows[r][k] -= factor * rows[c][k];
        }
    }
    for (std::size_t r = 0; r < n; ++r) {
        x[unknown[r]] = rows[r][n] / rows[r][r];
        if (!(std::abs(x[unknown[r]]) <= 1 + 1e-6L)) return false;
        x[unknown[r]] = std::clamp<Real>(x[unknown[r]], -1, 1);
    }
    return true;
}

std::pair<Real, Real> solvedRange(const Quadratic& q) {
    Real lower = std::numeric_limits<Real>::infinity();
    Real upper = -lower;
    for (int code = 0; code < 27; ++code) {
        const std::array<int, 3> digit{code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
        Vector x{};
        std::array<bool, 3> isFree{};
        for (std::size_t i = 0; i < 3; ++i) {
            isFree[i] = digit[i] == 0;
            x[i] = static_cast<Real>(digit[i]);
        }
        if (!stationary(q, isFree, x)) continue;
        const Real value = valueAt(q, x);
        lower = std::min(lower, value);
        upper = std::max(upper, value);
    }
    return {lower, upper};
}

// H = sum of w v v', random v.
std::array<double, 6> hessianOf(Random& random, const std::array<double, 3>& weights) {
    std::array<double, 6> h{};
    for (const double weight : weights) {
        const glm::dvec3 v = random.direction();
        h[0] += weight * v.x * v.x;
        h[1] += weight * v.y * v.y;
        h[2] += weight * v.z * v.z;
        h[3] += weight * v.x * v.y;
        h[4] += weight * v.x * v.z;
        h[5] += weight * v.y * v.z;
    }
    return h;
}

// Definite; of rank one, two; nearly singular, as a whole and in a face; general; without a square of w; scaled; none.
constexpr int kShapes = 9;

std::array<double, 6> hessianOf(Random& random, int shape) {
    const double sign = random.sign();
    const auto weight = [&] { return random.logUniform(1e-3, 10.0); };
    const auto tiny = [&] { return sign * random.logUniform(1e-18, 1e-3); };
    if (shape == 0) return hessianOf(random, {sign * weight(), sign * weight(), sign * weight()});
    if (shape == 1) return hessianOf(random, {sign * weight(), 0.0, 0.0});
    if (shape == 2) return hessianOf(random, {sign * weight(), random.sign() * weight(), 0.0});
    if (shape == 3) return hessianOf(random, {sign * weight(), tiny(), tiny()});
    std::array<double, 6> h{};
    if (shape == 4) {
        h = hessianOf(random, {sign * weight(), tiny(), 0.0});
        h[2] = h[4] = h[5] = 0.0;
    }
    if (shape == 4 || shape == 8) return h;
    for (double& x : h) x = random.uniform(-1.0, 1.0) * (shape == 7 ? random.logUniform(1e-12, 1e6) : 1.0);
    if (random.chance(0.2)) h[static_cast<std::size_t>(random.integer(0, 5))] = 0.0;
    if (shape == 6) h[2] = 0.0;
    return h;
}

// Half of the polynomials have their stationary point at a chosen place: inside, on, or just beside the box.
Quadratic randomQuadratic(Random& random) {
    Quadratic q;
    q.value = random.uniform(-1.0, 1.0);
    q.hessian = hessianOf(random, random.integer(0, kShapes - 1));
    if (random.chance(0.05)) return q;
    if (random.chance(0.5)) {
        for (double& g : q.gradient) g = random.uniform(-1.0, 1.0) * random.logUniform(1e-3, 3.0);
        return q;
    }
    Vector x{};
    for (Real& c : x)
        c = random.chance(0.3) ? random.sign() * (1.0 + random.sign() * random.logUniform(1e-17, 1e-3))
                               : random.uniform(-1.2, 1.2);
    const Matrix h = matrixOf(q);
    for (std::size_t i = 0; i < 3; ++i)
        q.gradient[i] = -static_cast<double>(h[i][0] * x[0] + h[i][1] * x[1] + h[i][2] * x[2]);
    return q;
}

TEST(QuadraticRange, MatchesAllStationaryPointsInLongDouble) {
    Random random(51);
    Real worst = 0;
    for (int trial = 0; trial < 200000; ++trial) {
        const Quadratic q = randomQuadratic(random);
        const Interval range = exactRange(q);
        const auto [lower, upper] = solvedRange(q);
        const Real error = std::max(std::abs(range.lower - lower), std::abs(range.upper - upper));
        worst = std::max(worst, error / magnitudeOf(q));
        ASSERT_LE(error, kRangePromised * magnitudeOf(q))
            << "hessian " << q.hessian[0] << ' ' << q.hessian[1] << ' ' << q.hessian[2] << ' ' << q.hessian[3] << ' '
            << q.hessian[4] << ' ' << q.hessian[5];
    }
    std::printf("exact range: off by at most %.2f epsilon times the magnitude (promised 64)\n",
                static_cast<double>(worst) / std::numeric_limits<double>::epsilon());
}

}  // namespace
}  // namespace osgAnalyticBin::test
