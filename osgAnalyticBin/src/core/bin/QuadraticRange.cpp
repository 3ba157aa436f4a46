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

void include(Interval& range, double value) {
    range.lower = std::min(range.lower, value);
    range.upper = std::max(range.upper, value);
}

Interval hullOf(const Interval& a, const Interval& b) {
    return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

Interval rangeOf(const Quadratic1& q) {
    const double middle = q.a + 0.5 * q.c;
    Interval range{middle - std::abs(q.b), middle + std::abs(q.b)};
    // stationary at x = -b/c, value a - b2/(2c); within the interval when |b| < |c|
    if (std::abs(q.b) < std::abs(q.c)) include(range, q.a - 0.5 * q.b * (q.b / q.c));
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
    Interval range =
        hullOf(hullOf(rangeOf(q.atU(-1.0)), rangeOf(q.atU(1.0))), hullOf(rangeOf(q.atV(-1.0)), rangeOf(q.atV(1.0))));
    double u = 0.0;
    double v = 0.0;
    if (definiteStationary(q.cuu, q.cvv, q.cuv, q.bu, q.bv, u, v) && acceptOntoBox(u) && acceptOntoBox(v)) {
        include(range, q(u, v));
    }
    return range;
}

Quadratic2 atU(const Quadratic& q, double u) {
    const auto& g = q.gradient;
    const auto& h = q.hessian;
    return {q.value + g[0] * u + 0.5 * h[kUU] * u * u, g[1] + h[kUV] * u, g[2] + h[kUW] * u, h[kVV], h[kWW], h[kVW]};
}

Quadratic2 atV(const Quadratic& q, double v) {
    const auto& g = q.gradient;
    const auto& h = q.hessian;
    return {q.value + g[1] * v + 0.5 * h[kVV] * v * v, g[0] + h[kUV] * v, g[2] + h[kVW] * v, h[kUU], h[kWW], h[kUW]};
}

Quadratic2 atW(const Quadratic& q, double w) {
    const auto& g = q.gradient;
    const auto& h = q.hessian;
    return {q.value + g[2] * w + 0.5 * h[kWW] * w * w, g[0] + h[kUW] * w, g[1] + h[kVW] * w, h[kUU], h[kVV], h[kUV]};
}

// q with its parameters renamed so that the largest square comes first: the pivot of the elimination.
Quadratic largestSquareFirst(const Quadratic& q) {
    const auto& g = q.gradient;
    const auto& h = q.hessian;
    const double uu = std::abs(h[kUU]);
    const double vv = std::abs(h[kVV]);
    const double ww = std::abs(h[kWW]);
    if (uu >= vv && uu >= ww) return q;
    if (vv >= ww) return {q.value, {g[1], g[0], g[2]}, {h[kVV], h[kUU], h[kWW], h[kUV], h[kVW], h[kUW]}};
    return {q.value, {g[2], g[1], g[0]}, {h[kWW], h[kVV], h[kUU], h[kVW], h[kUW], h[kUV]}};
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
    if (acceptOntoBox(u) && acceptOntoBox(v) && acceptOntoBox(w)) include(range, q(u, v, w));
}

}  // namespace

double Quadratic::operator()(double u, double v, double w) const noexcept {
    return value + gradient[0] * u + gradient[1] * v + gradient[2] * w +
           0.5 * (hessian[kUU] * u * u + hessian[kVV] * v * v + hessian[kWW] * w * w) + hessian[kUV] * u * v +
           hessian[kUW] * u * w + hessian[kVW] * v * w;
}

Interval exactRange(const Quadratic& q) noexcept {
    Interval range = hullOf(rangeOf(atW(q, -1.0)), rangeOf(atW(q, 1.0)));
    // For given u and v, q without a square of w is linear in w: its extrema are on the two faces done.
    if (q.hessian[kWW] == 0.0) return range;
    range = hullOf(range, hullOf(rangeOf(atU(q, -1.0)), rangeOf(atU(q, 1.0))));
    range = hullOf(range, hullOf(rangeOf(atV(q, -1.0)), rangeOf(atV(q, 1.0))));
    includeInterior(q, range);
    return range;
}

}  // namespace osgAnalyticBin::core
