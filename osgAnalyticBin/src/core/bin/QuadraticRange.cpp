// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <osgAnalyticBin/core/bin/QuadraticRange.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::core {

namespace {

enum : std::size_t { kUU, kVV, kWW, kUV, kUW, kVW };

// A stationary point up to this far outside the box is moved onto it: rounding may have moved it out.
constexpr double kAcceptance = 1e-6;

// a + b x + 1/2 c x2 over [-1, 1]
struct Quadratic1 {
    double a, b, c;
};

// a + b.x + 1/2 x'Cx over [-1, 1]^2
struct Quadratic2 {
    double a, bu, bv, cuu, cvv, cuv;

    double operator()(double u, double v) const {
        return a + bu * u + bv * v + 0.5 * (cuu * u * u + cvv * v * v) + cuv * u * v;
    }
    Quadratic1 atU(double u) const { return {a + bu * u + 0.5 * cuu * u * u, bv + cuv * u, cvv}; }
    Quadratic1 atV(double v) const { return {a + bv * v + 0.5 * cvv * v * v, bu + cuv * v, cuu}; }
};

Interval rangeOf(const Quadratic1& q) {
    const double middle = q.a + 0.5 * q.c;
    Interval range{middle - std::abs(q.b), middle + std::abs(q.b)};
    // stationary at x = -b/c, value a - b2/(2c); within the interval when |b| < |c|
    if (std::abs(q.b) < std::abs(q.c)) range.expandBy(q.a - 0.5 * q.b * (q.b / q.c));
    return range;
}

bool acceptOntoBox(double& x) {
    if (!(std::abs(x) <= 1.0 + kAcceptance)) return false;
    x = std::clamp(x, -1.0, 1.0);
    return true;
}

// One step of elimination keeps what is left of a definite matrix definite: pivots of one sign are the test.
bool sameSign(double a, double b) {
    return a > 0.0 ? b > 0.0 : a < 0.0 && b < 0.0;
}

// The stationary point of b.x + 1/2 x'Cx when C is definite: any other is no extremum, or one that the boundary has
// too. Elimination with the larger diagonal element as the pivot is stable for definite matrices; Cramer's rule is not,
// and loses half of the digits of the extremum when C is nearly singular.
bool definiteStationary(double cuu, double cvv, double cuv, double bu, double bv, double& u, double& v) {
    if (std::abs(cuu) < std::abs(cvv)) return definiteStationary(cvv, cuu, cuv, bv, bu, v, u);
    if (cuu == 0.0) return false;
    const double factor = cuv / cuu;
    const double pivot = cvv - factor * cuv;
    if (!sameSign(cuu, pivot)) return false;
    v = -(bv - factor * bu) / pivot;
    u = -(bu + cuv * v) / cuu;
    return true;
}

Interval rangeOf(const Quadratic2& q) {
    Interval range = rangeOf(q.atU(-1.0)).united(rangeOf(q.atU(1.0)));
    range = range.united(rangeOf(q.atV(-1.0))).united(rangeOf(q.atV(1.0)));
    double u = 0.0;
    double v = 0.0;
    if (definiteStationary(q.cuu, q.cvv, q.cuv, q.bu, q.bv, u, v) && acceptOntoBox(u) && acceptOntoBox(v)) {
        range.expandBy(q(u, v));
    }
    return range;
}

Quadratic2 atU(const Quadratic& q, double u) {
    const auto& g = q.gradient;
    const auto& h = q.hessian;
    return {q.value + g[0] * u + 0.5 * h[kUU] * u * u, g[1] + h[kUV] * u, g[2] + h[kUW] * u, h[kVV], h[kWW], h[kVW]};
}

// q with its parameters renamed so that one of them comes first and the others keep their order.
Quadratic withFirst(std::size_t first, const Quadratic& q) {
    const auto& g = q.gradient;
    const auto& h = q.hessian;
    if (first == 0) return q;
    if (first == 1) return {q.value, {g[1], g[0], g[2]}, {h[kVV], h[kUU], h[kWW], h[kUV], h[kVW], h[kUW]}};
    return {q.value, {g[2], g[0], g[1]}, {h[kWW], h[kUU], h[kVV], h[kUW], h[kVW], h[kUV]}};
}

// The range over the two faces of the cube where this parameter is -1 or 1.
Interval rangeOfFaces(std::size_t parameter, const Quadratic& given) {
    const Quadratic q = withFirst(parameter, given);
    return rangeOf(atU(q, -1.0)).united(rangeOf(atU(q, 1.0)));
}

// Puts the parameter with the largest square first: the pivot of the elimination.
Quadratic largestSquareFirst(const Quadratic& q) {
    const auto& h = q.hessian;
    const auto isSmaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const auto largest = std::max_element(h.begin(), h.begin() + 3, isSmaller);
    return withFirst(static_cast<std::size_t>(largest - h.begin()), q);
}

// The stationary point of the whole cube, when it is an extremum.
void includeInterior(const Quadratic& given, Interval& range) {
    const Quadratic q = largestSquareFirst(given);
    const auto& g = q.gradient;
    const auto& h = q.hessian;
    if (h[kUU] == 0.0) return;
    const double fv = h[kUV] / h[kUU];
    const double fw = h[kUW] / h[kUU];
    const double cvv = h[kVV] - fv * h[kUV];
    const double cww = h[kWW] - fw * h[kUW];
    const double cvw = h[kVW] - fv * h[kUW];
    if (!sameSign(h[kUU], cvv) || !sameSign(h[kUU], cww)) return;
    double v = 0.0;
    double w = 0.0;
    if (!definiteStationary(cvv, cww, cvw, g[1] - fv * g[0], g[2] - fw * g[0], v, w)) return;
    double u = -(g[0] + h[kUV] * v + h[kUW] * w) / h[kUU];
    if (acceptOntoBox(u) && acceptOntoBox(v) && acceptOntoBox(w)) range.expandBy(q(u, v, w));
}

}  // namespace

double Quadratic::operator()(double u, double v, double w) const noexcept {
    return value + gradient[0] * u + gradient[1] * v + gradient[2] * w +
           0.5 * (hessian[kUU] * u * u + hessian[kVV] * v * v + hessian[kWW] * w * w) + hessian[kUV] * u * v +
           hessian[kUW] * u * w + hessian[kVW] * v * w;
}

Interval exactRange(const Quadratic& q) noexcept {
    Interval range = rangeOfFaces(2, q);
    // For given u and v, q without a square of w is linear in w: its extrema are on the two faces done.
    if (q.hessian[kWW] == 0.0) return range;
    range = range.united(rangeOfFaces(0, q)).united(rangeOfFaces(1, q));
    includeInterior(q, range);
    return range;
}

}  // namespace osgAnalyticBin::core
