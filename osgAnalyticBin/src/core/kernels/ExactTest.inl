// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The frustum test of a geodetic bin in closed form, after the test of its sphere: corners, then the support function.
// Source: doc/theory/derivation.md, section 8. Included after QuadraticTest.inl.

template <class Real>
struct Range {
    Real lower, upper;
};

template <class Real, class Bin>
INLINE Real alongCorner(const Bin& bin, std::size_t corner, Real c, Real nz) {
    return bin[row::Corners + 2 * corner] * c + bin[row::Corners + 2 * corner + 1] * nz;
}

template <class Real, class Bin>
INLINE Range<Real> rangeOfCorners(const Bin& bin, const Range<Real>& c, Real nz) {
    return {smaller(smaller(alongCorner(bin, 0, c.lower, nz), alongCorner(bin, 1, c.lower, nz)),
                    smaller(alongCorner(bin, 2, c.lower, nz), alongCorner(bin, 3, c.lower, nz))),
            larger(larger(alongCorner(bin, 0, c.upper, nz), alongCorner(bin, 1, c.upper, nz)),
                   larger(alongCorner(bin, 2, c.upper, nz), alongCorner(bin, 3, c.upper, nz)))};
}

template <class Real, class Bin>
INLINE Real slackOf(const Bin& bin, const PlaneLanes<Real>& plane) {
    // a quarter of 128 epsilon |offset|: doc/theory/derivation.md, section 8
    return bin[row::Slack] + broadcast<Real>(0.25) * plane.rounding;
}

// 2. The corners, attained, and exceeded by no more than the bulge.
struct CornerHull {
    template <class Real, class Bin>
    static INLINE Sides<Real> sides(const Bin& bin, const PlaneLanes<Real>& plane) {
        const Real west = plane.nx * bin[row::CosWest] + plane.ny * bin[row::SinWest];
        const Real east = plane.nx * bin[row::CosEast] + plane.ny * bin[row::SinEast];
        const Range<Real> corners = rangeOfCorners(bin, Range<Real>{smaller(west, east), larger(west, east)}, plane.nz);
        const Real lower = plane.offset + corners.lower;
        const Real upper = plane.offset + corners.upper;
        const Real bulge = bin[row::Bulge];
        return sidesOf<Real>(lower - bulge, upper + bulge, lower, upper, slackOf(bin, plane));
    }
};

// Value and slope of nx cos l + ny sin l at a longitude.
template <class Real>
struct AtLongitude {
    INLINE AtLongitude(Real nx, Real ny, Real cosine, Real sine)
        : value(nx * cosine + ny * sine), slope(ny * cosine - nx * sine) {}
    Real value, slope;
};

template <class Real>
INLINE Truth<Real> hasPeakBetween(const AtLongitude<Real>& west, const AtLongitude<Real>& east) {
    return both(west.slope > broadcast<Real>(0.0), east.slope < broadcast<Real>(0.0));
}
template <class Real>
INLINE Truth<Real> hasDipBetween(const AtLongitude<Real>& west, const AtLongitude<Real>& east) {
    return both(west.slope<broadcast<Real>(0.0), east.slope> broadcast<Real>(0.0));
}

// The smallest and the largest value of nx cos l + ny sin l over the longitudes.
template <class Real, class Bin>
INLINE Range<Real> rangeAlongParallel(const Bin& bin, Real nx, Real ny) {
    const AtLongitude<Real> west(nx, ny, bin[row::CosWest], bin[row::SinWest]);
    const AtLongitude<Real> east(nx, ny, bin[row::CosEast], bin[row::SinEast]);
    Range<Real> range{smaller(west.value, east.value), larger(west.value, east.value)};
    // Over at most half a turn, an extremum lies within when the slope changes its sign.
    Truth<Real> hasPeak = hasPeakBetween(west, east);
    Truth<Real> hasDip = hasDipBetween(west, east);
    const Real longitudes = bin[row::Longitudes];
    if (anyWhere<Real>(longitudes > broadcast<Real>(row::kNarrow))) {
        // Wide bins: two arcs, or all.
        const Truth<Real> isWide = longitudes == broadcast<Real>(row::kWide);
        const Truth<Real> isFull = longitudes == broadcast<Real>(row::kFullCircle);
        const AtLongitude<Real> middle(nx, ny, bin[row::CosMiddle], bin[row::SinMiddle]);
        range.lower = select(isWide, smaller(range.lower, middle.value), range.lower);
        range.upper = select(isWide, larger(range.upper, middle.value), range.upper);
        const Truth<Real> peaks = either(hasPeakBetween(west, middle), hasPeakBetween(middle, east));
        const Truth<Real> dips = either(hasDipBetween(west, middle), hasDipBetween(middle, east));
        hasPeak = either(isFull, either(both(isWide, peaks), without(hasPeak, isWide)));
        hasDip = either(isFull, either(both(isWide, dips), without(hasDip, isWide)));
    }
    // The extremum of the whole circle. The root is ready before the truths are: a branch would not save it.
    const Real length = root(nx * nx + ny * ny);
    range.upper = select(hasPeak, length, range.upper);
    range.lower = select(hasDip, negated(length), range.lower);
    return range;
}

// The ellipsoid's own support, raised by the upper altitude: the value where the surface normal is the direction.
template <class Real, class Bin>
INLINE Real surfaceSupport(const Bin& bin, Real c, Real nz) {
    const Real cc = c * c;
    const Real zz = nz * nz;
    return root(bin[row::SquaredEquatorialRadius] * cc + bin[row::SquaredPolarRadius] * zz) +
           bin[row::TopAltitude] * root(cc + zz);
}

// The smallest value for c.lower and the largest for c.upper along the meridian.
template <class Real, class Bin>
INLINE Range<Real> rangeAlongMeridian(const Bin& bin, const Range<Real>& c, Real nz) {
    const Real zero = broadcast<Real>(0.0);
    const Real cosSouth = bin[row::CosSouth];
    const Real sinSouth = bin[row::SinSouth];
    const Real cosNorth = bin[row::CosNorth];
    const Real sinNorth = bin[row::SinNorth];
    const Truth<Real> peak = both(cosSouth * nz - sinSouth * c.upper > zero, cosNorth * nz - sinNorth * c.upper < zero);
    const Truth<Real> dip = both(cosSouth * nz - sinSouth * c.lower<zero, cosNorth * nz - sinNorth * c.lower> zero);
    Range<Real> range = rangeOfCorners(bin, c, nz);
    if (anyWhere<Real>(either(peak, dip))) {
        range.upper = select(peak, surfaceSupport(bin, c.upper, nz), range.upper);
        range.lower = select(dip, negated(surfaceSupport(bin, c.lower, nz)), range.lower);
    }
    return range;
}

// The range of n.x over the bin, without margin.
template <class Real, class Bin>
INLINE Range<Real> supportRange(const Bin& bin, Real nx, Real ny, Real nz) {
    return rangeAlongMeridian(bin, rangeAlongParallel(bin, nx, ny), nz);
}

// 3. The closed form, which leaves nothing open.
struct ClosedForm {
    template <class Real, class Bin>
    static INLINE Sides<Real> sides(const Bin& bin, const PlaneLanes<Real>& plane) {
        const Range<Real> support = supportRange(bin, plane.nx, plane.ny, plane.nz);
        const Real slack = slackOf(bin, plane);
        const Truth<Real> outside = isOutside<Real>(plane.offset + support.upper, slack);
        const Truth<Real> inside = isInside<Real>(plane.offset + support.lower, slack);
        return {outside, inside, without(outside, outside)};
    }
};

// The stages behind the sphere.
struct ExactForm {
    using Coarse = CornerHull;
    using Fine = ClosedForm;
};
