// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The quadratic frustum test from top to bottom: sphere, linear part, second-order terms. Each stage tests what the one
// before leaves open. The exact range of the polynomial decides the rest, one bin and one plane at a time:
// QuadraticBin::classifyByExactRange().
//
// Included within the namespace of one kind of number: ScalarNumbers.inl or VectorNumbers.inl. `Real` is a double or a
// vector of doubles. Its lanes are planes, with a bin's numbers in all of them, or bins, with a plane's numbers in all.
// `bin[row]` is a number of the bin, in the order of KernelData.h.

template <class Real>
struct PlaneLanes {
    Real nx, ny, nz, offset, rounding;
};

// Open: this test cannot tell. The three exclude each other. A lane in none of them straddles the plane for certain.
template <class Real>
struct Sides {
    Truth<Real> outside, inside, open;
};

// Written so that NaN is neither outside nor inside.
template <class Real>
INLINE Truth<Real> isOutside(Real upper, Real slack) {
    return upper + slack < broadcast<Real>(0.0);
}
template <class Real>
INLINE Truth<Real> isInside(Real lower, Real slack) {
    return lower - slack >= broadcast<Real>(0.0);
}

// The outer interval holds all distances of the bin; the ends of the inner one are distances of points of the bin. A
// plane between the ends of the inner one straddles the bin, and no finer test is needed.
template <class Real>
INLINE Sides<Real> sidesOf(Real lower, Real upper, Real attainedLower, Real attainedUpper, Real slack) {
    const Truth<Real> outside = isOutside<Real>(upper, slack);
    const Truth<Real> inside = isInside<Real>(lower, slack);
    const Truth<Real> attained = either(isOutside<Real>(attainedUpper, slack), isInside<Real>(attainedLower, slack));
    return {outside, inside, without(attained, either(outside, inside))};
}

// Summed as a tree: the first test's result is waited for.
template <class Real, class Bin>
INLINE Real distanceOfCenter(const Bin& bin, const PlaneLanes<Real>& plane) {
    return (plane.nx * bin[row::CenterX] + plane.ny * bin[row::CenterY]) +
           (plane.nz * bin[row::CenterZ] + plane.offset);
}

// The normal times a vector in three rows.
template <class Real, class Bin>
INLINE Real along(const Bin& bin, std::size_t x, const PlaneLanes<Real>& plane) {
    return plane.nx * bin[x] + plane.ny * bin[x + 1] + plane.nz * bin[x + 2];
}

// 1. The sphere about the bin, of either form: decides most planes.
struct Sphere {
    template <class Real, class Bin>
    static INLINE Sides<Real> sides(const Bin& bin, const PlaneLanes<Real>& plane) {
        const Real distance = distanceOfCenter(bin, plane);
        // The threshold either way; negation does not round.
        const Truth<Real> outside = distance < negated(bin[row::Reach]) - plane.rounding;
        const Truth<Real> inside = distance >= bin[row::Reach] + plane.rounding;
        return {outside, inside, neither<Real>(outside, inside)};
    }
};

// The sum of the gradient's magnitudes: [JJ] eq. (3).
template <class Real, class Bin>
INLINE Real slopeOf(const Bin& bin, const PlaneLanes<Real>& plane) {
    return magnitude(along(bin, row::First, plane)) + magnitude(along(bin, row::First + 3, plane)) +
           magnitude(along(bin, row::First + 6, plane));
}

// 2. The linear part of the polynomial, give or take the curvature: decides most planes that cross the bin, and most of
// those beside it. The corners along and against the gradient are attained to the curvature, and exceeded by no more.
struct LinearPart {
    template <class Real, class Bin>
    static INLINE Sides<Real> sides(const Bin& bin, const PlaneLanes<Real>& plane) {
        const Real value = distanceOfCenter(bin, plane);
        const Real slope = slopeOf(bin, plane);
        const Real slack = bin[row::Remainder] + plane.rounding;
        const Real curvature = bin[row::Curvature];
        const Real lower = value - slope;
        const Real upper = value + slope;
        return sidesOf<Real>(lower - curvature, upper + curvature, lower + curvature, upper - curvature, slack);
    }
};

// 3. The second-order terms of the polynomial, [JJ] eq. (3), each by itself; a square lies in [0, 1]. The corners along
// and against the gradient are attained to the mixed terms.
struct SecondOrderTerms {
    template <class Real, class Bin>
    static INLINE Sides<Real> sides(const Bin& bin, const PlaneLanes<Real>& plane) {
        const Real value = distanceOfCenter(bin, plane);
        const Real slope = slopeOf(bin, plane);
        const Real uu = along(bin, row::Second, plane);
        const Real vv = along(bin, row::Second + 3, plane);
        const Real ww = along(bin, row::Second + 6, plane);
        const Real uv = along(bin, row::Second + 9, plane);
        const Real uw = along(bin, row::Second + 12, plane);
        const Real vw = along(bin, row::Second + 15, plane);
        const Real zero = broadcast<Real>(0.0);
        const Real half = broadcast<Real>(0.5);
        const Real mixed = magnitude(uv) + magnitude(uw) + magnitude(vw);
        const Real below = half * (smaller(uu, zero) + smaller(vv, zero) + smaller(ww, zero));
        const Real above = half * (larger(uu, zero) + larger(vv, zero) + larger(ww, zero));
        const Real squares = half * (uu + vv + ww);
        const Real slack = bin[row::Remainder] + plane.rounding;
        const Real lower = value - slope;
        const Real upper = value + slope;
        return sidesOf<Real>(lower - mixed + below, upper + mixed + above, lower + mixed + squares,
                             upper - mixed + squares, slack);
    }
};

// 4. The exact range of the polynomial: one plane in a thousand, by itself. sidesByExactRange() in QuadraticBin.cpp.

// The stages behind the sphere.
struct QuadraticForm {
    using Coarse = LinearPart;
    using Fine = SecondOrderTerms;
};
