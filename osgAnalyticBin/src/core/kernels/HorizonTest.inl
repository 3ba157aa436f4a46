// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The horizon test: doc/theory/horizon.md, section 3. `bin[row]` counts from the first row of the horizon.
// Included behind a namespace's numbers.

// Of one cosine that is compared; doc/theory/horizon.md, section 5.
constexpr double kCosineSlack = 64.0 * kEpsilon;
// Outward rounding of products and quotients of a few factors; doc/theory/horizon.md, section 5.
constexpr double kRoundDown = 1.0 - 16.0 * kEpsilon;

// A direction of the bin before the horizon is seen: most tiles that are in view end here.
template <class Real, class Bin>
INLINE Truth<Real> showsAnEnd(const Bin& bin, const HorizonEyeData& eye) {
    const Real z = broadcast<Real>(eye.z);
    const Real cosDip = broadcast<Real>(eye.cosDip);
    const Real toward =
        bin[row::CosMiddleLongitude] * broadcast<Real>(eye.x) + bin[row::SinMiddleLongitude] * broadcast<Real>(eye.y);
    return either(bin[row::CosSouthern] * toward + bin[row::SinSouthern] * z >= cosDip,
                  bin[row::CosNorthern] * toward + bin[row::SinNorthern] * z >= cosDip);
}

// The cosine of the angle from the eye beyond which a direction is hidden, of points at the radius or nearer; the
// spread is added to it.
template <class Real>
struct HiddenBelow {
    INLINE HiddenBelow(const HorizonEyeData& eye, Real inverseRadius, Real cosSpread, Real sinSpread) {
        const Real one = broadcast<Real>(1.0);
        // B, the angle at the centre between the bin's farthest point and its horizon
        const Real cosB = smaller(one, broadcast<Real>(eye.scale) * inverseRadius * broadcast<Real>(kRoundDown));
        const Real sinB = root(one - cosB * cosB + broadcast<Real>(4.0 * kEpsilon));
        const Real cosC = cosB * cosSpread - sinB * sinSpread;
        const Real sinC = sinB * cosSpread + cosB * sinSpread;
        isAny = cosC > broadcast<Real>(0.0);  // so that dip + C stays below half a turn
        cosine =
            broadcast<Real>(eye.cosDip) * cosC - broadcast<Real>(eye.sinDip) * sinC - broadcast<Real>(kCosineSlack);
    }
    Truth<Real> isAny;
    Real cosine;
};

// The largest cosine between a direction and those of a bin is the larger of the two: section 8 of
// doc/theory/derivation.md on the unit sphere.
template <class Real>
struct LargestCosine {
    Real south, north;
};

// `equatorial`: the length of x and y.
template <class Real, class Bin>
INLINE LargestCosine<Real> largestCosine(const Bin& bin, Real x, Real y, Real z, Real equatorial) {
    const Real zero = broadcast<Real>(0.0);
    const Real cosHalf = bin[row::CosHalfWidth];
    const Real sinHalf = bin[row::SinHalfWidth];
    const Real along = x * bin[row::CosMiddleLongitude] + y * bin[row::SinMiddleLongitude];
    const Real across = magnitude(y * bin[row::CosMiddleLongitude] - x * bin[row::SinMiddleLongitude]);
    // The direction's longitude differs from the middle by an angle of [0, pi]; is it at most the half width?
    const Truth<Real> holdsLongitude = along * sinHalf - across * cosHalf >= zero;
    const Real c = select(holdsLongitude, equatorial, along * cosHalf + across * sinHalf);
    const Real cosSouth = bin[row::CosSouthern];
    const Real sinSouth = bin[row::SinSouthern];
    const Real cosNorth = bin[row::CosNorthern];
    const Real sinNorth = bin[row::SinNorthern];
    const Truth<Real> peak = both(cosSouth * z - sinSouth * c > zero, cosNorth * z - sinNorth * c < zero);
    const Real within = root(c * c + z * z);
    return {select(peak, within, c * cosSouth + z * sinSouth), select(peak, within, c * cosNorth + z * sinNorth)};
}

// Whether all of the bin is behind the horizon. Written so that NaN is not hidden.
template <class Real, class Bin>
INLINE Truth<Real> isBehindHorizon(const Bin& bin, const HorizonEyeData& eye) {
    const LargestCosine<Real> largest = largestCosine(bin, broadcast<Real>(eye.x), broadcast<Real>(eye.y),
                                                      broadcast<Real>(eye.z), broadcast<Real>(eye.equatorial));
    const HiddenBelow<Real> below(eye, bin[row::InverseRadius], bin[row::CosMargin], bin[row::SinMargin]);
    return both(below.isAny, both(largest.south < below.cosine, largest.north < below.cosine));
}
