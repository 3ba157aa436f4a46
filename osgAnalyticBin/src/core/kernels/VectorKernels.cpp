// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// ScalarKernels.cpp over four planes at once: the same operations in the same order, multiplications and additions
// apart, so that every verdict is the same bit for bit. Highway compiles this file once for each instruction set.

#include "core/kernels/PlaneKernels.h"

// In this order: the first of the two includes this file again.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/VectorKernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace osgAnalyticBin::core::kernels {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, PlaneBlock::kLanes>;
using V = hn::Vec<Tag>;
using M = hn::Mask<Tag>;

constexpr std::uint32_t kBlockBits = (1u << PlaneBlock::kLanes) - 1;

HWY_INLINE V each(double value) {
    return hn::Set(Tag(), value);
}

HWY_INLINE std::uint32_t bitsOf(M mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask, bytes);
    return bytes[0];
}

HWY_INLINE bool anyOf(M mask) {
    return !hn::AllFalse(Tag(), mask);
}
HWY_INLINE M positive(V v) {
    return hn::Gt(v, hn::Zero(Tag()));
}
HWY_INLINE M negative(V v) {
    return hn::Lt(v, hn::Zero(Tag()));
}

// As many planes of a block as there are lanes.
struct Lanes {
    HWY_INLINE Lanes(const PlaneBlock& block, std::size_t i)
        : nx(hn::Load(Tag(), block.normalX + i)),
          ny(hn::Load(Tag(), block.normalY + i)),
          nz(hn::Load(Tag(), block.normalZ + i)),
          offset(hn::Load(Tag(), block.offset + i)),
          rounding(hn::Load(Tag(), block.rounding + i)) {}

    V nx, ny, nz, offset, rounding;
};

struct VRange {
    V lower, upper;
};

HWY_INLINE V dot(const Lanes& plane, const double (&v)[3]) {
    return hn::Add(hn::Add(hn::Mul(plane.nx, each(v[0])), hn::Mul(plane.ny, each(v[1]))),
                   hn::Mul(plane.nz, each(v[2])));
}

// Summed as a tree: the first test's result is waited for.
HWY_INLINE V distanceTo(const Lanes& plane, const double (&v)[3]) {
    return hn::Add(hn::Add(hn::Mul(plane.nx, each(v[0])), hn::Mul(plane.ny, each(v[1]))),
                   hn::Add(hn::Mul(plane.nz, each(v[2])), plane.offset));
}

HWY_INLINE V alongPoint(const MeridianPoint& point, V c, V nz) {
    return hn::Add(hn::Mul(each(point.axisDistance), c), hn::Mul(each(point.z), nz));
}

HWY_INLINE VRange rangeAlongParallel(const ExactBinData& bin, V nx, V ny) {
    const auto valueAt = [&](double cosine, double sine)
                             HWY_ATTR { return hn::Add(hn::Mul(nx, each(cosine)), hn::Mul(ny, each(sine))); };
    const auto slopeAt = [&](double cosine, double sine)
                             HWY_ATTR { return hn::Sub(hn::Mul(ny, each(cosine)), hn::Mul(nx, each(sine))); };
    // Value and slope at both ends.
    const V west = valueAt(bin.cosWest, bin.sinWest);
    const V east = valueAt(bin.cosEast, bin.sinEast);
    const V westSlope = slopeAt(bin.cosWest, bin.sinWest);
    const V eastSlope = slopeAt(bin.cosEast, bin.sinEast);
    VRange range{hn::Min(west, east), hn::Max(west, east)};
    // Over at most half a turn, an extremum lies within when the slope changes its sign.
    M hasPeak = hn::And(positive(westSlope), negative(eastSlope));
    M hasDip = hn::And(negative(westSlope), positive(eastSlope));
    // Wide bins: two arcs, or all.
    if (bin.longitudes == ExactBinData::Wide) {
        const V middle = valueAt(bin.cosMiddle, bin.sinMiddle);
        const V middleSlope = slopeAt(bin.cosMiddle, bin.sinMiddle);
        range = {hn::Min(range.lower, middle), hn::Max(range.upper, middle)};
        hasPeak = hn::Or(hn::And(positive(westSlope), negative(middleSlope)),
                         hn::And(positive(middleSlope), negative(eastSlope)));
        hasDip = hn::Or(hn::And(negative(westSlope), positive(middleSlope)),
                        hn::And(negative(middleSlope), positive(eastSlope)));
    } else if (bin.longitudes == ExactBinData::FullCircle) {
        hasPeak = hn::Eq(each(0.0), each(0.0));
        hasDip = hasPeak;
    }
    // The extremum of the whole circle. The root is ready before the masks are: a branch would not save it.
    const V length = hn::Sqrt(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)));
    range.upper = hn::IfThenElse(hasPeak, length, range.upper);
    range.lower = hn::IfThenElse(hasDip, hn::Neg(length), range.lower);
    return range;
}

// The ellipsoid's own support, raised by the upper altitude: the value where the surface normal is the direction.
HWY_INLINE V surfaceSupport(const ExactBinData& bin, V c, V nz) {
    const V cc = hn::Mul(c, c);
    const V zz = hn::Mul(nz, nz);
    return hn::Add(
        hn::Sqrt(hn::Add(hn::Mul(each(bin.squaredEquatorialRadius), cc), hn::Mul(each(bin.squaredPolarRadius), zz))),
        hn::Mul(each(bin.topAltitude), hn::Sqrt(hn::Add(cc, zz))));
}

HWY_INLINE VRange rangeOfCorners(const ExactBinData& bin, const VRange& c, V nz) {
    return {hn::Min(hn::Min(alongPoint(bin.topSouth, c.lower, nz), alongPoint(bin.bottomSouth, c.lower, nz)),
                    hn::Min(alongPoint(bin.topNorth, c.lower, nz), alongPoint(bin.bottomNorth, c.lower, nz))),
            hn::Max(hn::Max(alongPoint(bin.topSouth, c.upper, nz), alongPoint(bin.bottomSouth, c.upper, nz)),
                    hn::Max(alongPoint(bin.topNorth, c.upper, nz), alongPoint(bin.bottomNorth, c.upper, nz)))};
}

// The largest value for c.upper and the smallest for c.lower along the meridian.
HWY_INLINE VRange rangeAlongMeridian(const ExactBinData& bin, const VRange& c, V nz) {
    const auto slopeAt = [&](double cosine, double sine, V along)
                             HWY_ATTR { return hn::Sub(hn::Mul(each(cosine), nz), hn::Mul(each(sine), along)); };
    const M peak = hn::And(positive(slopeAt(bin.cosSouth, bin.sinSouth, c.upper)),
                           negative(slopeAt(bin.cosNorth, bin.sinNorth, c.upper)));
    const M dip = hn::And(negative(slopeAt(bin.cosSouth, bin.sinSouth, c.lower)),
                          positive(slopeAt(bin.cosNorth, bin.sinNorth, c.lower)));
    VRange range = rangeOfCorners(bin, c, nz);
    if (anyOf(hn::Or(peak, dip))) {
        range.upper = hn::IfThenElse(peak, surfaceSupport(bin, c.upper, nz), range.upper);
        range.lower = hn::IfThenElse(dip, hn::Neg(surfaceSupport(bin, c.lower, nz)), range.lower);
    }
    return range;
}

struct Sides {
    M outside, inside;
};

// Written so that NaN is neither.
HWY_INLINE Sides sidesOf(V lower, V upper, V slack) {
    return {negative(hn::Add(upper, slack)), hn::Ge(hn::Sub(lower, slack), hn::Zero(Tag()))};
}

HWY_INLINE Sides sphereSides(const SphereData& sphere, const Lanes& plane) {
    const V distance = distanceTo(plane, sphere.center);
    const V threshold = hn::Add(each(static_cast<double>(sphere.reach)), plane.rounding);
    return {hn::Lt(distance, hn::Neg(threshold)), hn::Ge(distance, threshold)};
}

// Neither outside nor inside by the outer bounds, and one of both by the attained ones: a finer test has to tell.
HWY_INLINE M openOf(const Sides& bounded, const Sides& attained) {
    return hn::AndNot(hn::Or(bounded.outside, bounded.inside), hn::Or(attained.outside, attained.inside));
}

struct SidesAndOpen {
    Sides sides;
    M open;
};

HWY_INLINE V slackOf(const ExactBinData& bin, const Lanes& plane) {
    return hn::Add(each(bin.slack), hn::Mul(each(0.25), plane.rounding));
}

HWY_INLINE SidesAndOpen hullSides(const ExactBinData& bin, const Lanes& plane) {
    // The longitudes' ends, then the corners.
    const V west = hn::Add(hn::Mul(plane.nx, each(bin.cosWest)), hn::Mul(plane.ny, each(bin.sinWest)));
    const V east = hn::Add(hn::Mul(plane.nx, each(bin.cosEast)), hn::Mul(plane.ny, each(bin.sinEast)));
    const VRange along = rangeOfCorners(bin, {hn::Min(west, east), hn::Max(west, east)}, plane.nz);
    const V lower = hn::Add(plane.offset, along.lower);
    const V upper = hn::Add(plane.offset, along.upper);
    const V slack = slackOf(bin, plane);
    const V bulge = each(bin.bulge);
    const Sides bounded = sidesOf(hn::Sub(lower, bulge), hn::Add(upper, bulge), slack);
    return {bounded, openOf(bounded, sidesOf(lower, upper, slack))};
}

HWY_INLINE SidesAndOpen fullSides(const ExactBinData& bin, const Lanes& plane) {
    const VRange c = rangeAlongParallel(bin, plane.nx, plane.ny);
    const VRange along = rangeAlongMeridian(bin, c, plane.nz);
    const Sides sides =
        sidesOf(hn::Add(plane.offset, along.lower), hn::Add(plane.offset, along.upper), slackOf(bin, plane));
    return {sides, hn::Lt(each(0.0), each(0.0))};
}

HWY_INLINE V slopeOf(const QuadraticBinData& bin, const Lanes& plane) {
    return hn::Add(hn::Add(hn::Abs(dot(plane, bin.first[0])), hn::Abs(dot(plane, bin.first[1]))),
                   hn::Abs(dot(plane, bin.first[2])));
}

HWY_INLINE SidesAndOpen hullSides(const QuadraticBinData& bin, const Lanes& plane) {
    // Value and gradient of the polynomial, [JJ] eq. (3).
    const V value = distanceTo(plane, bin.sphere.center);
    const V slope = slopeOf(bin, plane);
    const V slack = hn::Add(each(bin.remainder), plane.rounding);
    // The corners along and against the gradient are attained to the curvature, and exceeded by no more.
    const V curvature = each(static_cast<double>(bin.sphere.curvature));
    const V lower = hn::Sub(value, slope);
    const V upper = hn::Add(value, slope);
    const Sides bounded = sidesOf(hn::Sub(lower, curvature), hn::Add(upper, curvature), slack);
    const Sides attained = sidesOf(hn::Add(lower, curvature), hn::Sub(upper, curvature), slack);
    return {bounded, openOf(bounded, attained)};
}

HWY_INLINE SidesAndOpen fullSides(const QuadraticBinData& bin, const Lanes& plane) {
    // The polynomial, [JJ] eq. (3).
    const V value = distanceTo(plane, bin.sphere.center);
    const V slope = slopeOf(bin, plane);
    const V uu = dot(plane, bin.second[0]);
    const V vv = dot(plane, bin.second[1]);
    const V ww = dot(plane, bin.second[2]);
    const V uv = dot(plane, bin.second[3]);
    const V uw = dot(plane, bin.second[4]);
    const V vw = dot(plane, bin.second[5]);
    const V slack = hn::Add(each(bin.remainder), plane.rounding);
    // Every term by itself; a square lies in [0, 1].
    const V zero = hn::Zero(Tag());
    const V half = each(0.5);
    const V mixed = hn::Add(hn::Add(hn::Abs(uv), hn::Abs(uw)), hn::Abs(vw));
    const V below = hn::Mul(half, hn::Add(hn::Add(hn::Min(uu, zero), hn::Min(vv, zero)), hn::Min(ww, zero)));
    const V above = hn::Mul(half, hn::Add(hn::Add(hn::Max(uu, zero), hn::Max(vv, zero)), hn::Max(ww, zero)));
    const V lower = hn::Sub(value, slope);
    const V upper = hn::Add(value, slope);
    const Sides bounded = sidesOf(hn::Add(hn::Sub(lower, mixed), below), hn::Add(hn::Add(upper, mixed), above), slack);
    // The corners along and against the gradient are attained to the mixed terms. When the plane passes between them,
    // the exact range could not say anything else.
    const V squares = hn::Mul(half, hn::Add(hn::Add(uu, vv), ww));
    const Sides attained =
        sidesOf(hn::Add(hn::Add(lower, mixed), squares), hn::Add(hn::Sub(upper, mixed), squares), slack);
    return {bounded, openOf(bounded, attained)};
}

// The masks of one block, gathered over as many vectors as it takes.
struct BlockBits {
    std::uint32_t outside = 0, inside = 0, open = 0;
};

HWY_INLINE BlockBits sphereBits(const SphereData& sphere, const PlaneBlock& block) {
    BlockBits bits;
    const std::size_t lanes = hn::Lanes(Tag());
    for (std::size_t i = 0; i < PlaneBlock::kLanes; i += lanes) {
        const Sides sides = sphereSides(sphere, Lanes(block, i));
        bits.outside |= bitsOf(sides.outside) << i;
        bits.inside |= bitsOf(sides.inside) << i;
    }
    return bits;
}

template <class Bin>
HWY_INLINE BlockBits hullBits(const Bin& bin, const PlaneBlock& block) {
    BlockBits bits;
    const std::size_t lanes = hn::Lanes(Tag());
    for (std::size_t i = 0; i < PlaneBlock::kLanes; i += lanes) {
        const SidesAndOpen result = hullSides(bin, Lanes(block, i));
        bits.outside |= bitsOf(result.sides.outside) << i;
        bits.inside |= bitsOf(result.sides.inside) << i;
        bits.open |= bitsOf(result.open) << i;
    }
    return bits;
}

// One bin in thirty to fifty: kept out of line, so that the others do not save registers for it.
template <class Bin>
HWY_NOINLINE BlockBits fullBits(const Bin& bin, const PlaneBlock& block) {
    BlockBits bits;
    const std::size_t lanes = hn::Lanes(Tag());
    for (std::size_t i = 0; i < PlaneBlock::kLanes; i += lanes) {
        const SidesAndOpen result = fullSides(bin, Lanes(block, i));
        bits.outside |= bitsOf(result.sides.outside) << i;
        bits.inside |= bitsOf(result.sides.inside) << i;
        bits.open |= bitsOf(result.open) << i;
    }
    return bits;
}

// Either form: the branch is taken only for bins that the sphere leaves.
HWY_INLINE BlockBits hullBits(const GeodeticBinData& bin, const PlaneBlock& block) {
    return bin.isExact() ? hullBits(bin.exact, block) : hullBits(bin.quadratic, block);
}

HWY_INLINE BlockBits fullBits(const GeodeticBinData& bin, const PlaneBlock& block) {
    return bin.isExact() ? fullBits(bin.exact, block) : fullBits(bin.quadratic, block);
}

// `mask` if no bit of `outside` is set, else nothing: one branch on the result is mispredicted less often than two.
HWY_INLINE std::uint32_t unlessAny(std::uint32_t outside, std::uint32_t mask) {
    return mask & (((outside | (0u - outside)) >> 31) - 1u);
}

// The usual case by itself: the side planes of a camera.
template <class Bin>
HWY_INLINE Verdict overOneBlock(const Bin& bin, const SphereData& sphere, const PlaneBlock& block,
                                std::uint32_t undecided) {
    const BlockBits coarse = sphereBits(sphere, block);
    std::uint32_t outside = coarse.outside & undecided;
    std::uint32_t inside = coarse.inside & undecided;
    const std::uint32_t left = unlessAny(outside, undecided & ~inside);
    if (left == 0) return Verdict::of(outside, inside);
    const BlockBits hull = hullBits(bin, block);
    outside = hull.outside & left;
    inside |= hull.inside & left;
    const std::uint32_t open = unlessAny(outside, hull.open & left);
    if (open == 0) return Verdict::of(outside, inside);
    const BlockBits full = fullBits(bin, block);
    outside = full.outside & open;
    return Verdict::of(outside, inside | (full.inside & open), unlessAny(outside, full.open & open));
}

// Adds what a test says of the planes of a mask, block by block.
template <class Test>
HWY_INLINE BlockBits overBlocks(const PlaneBlock* blocks, std::uint32_t mask, const Test& test) {
    BlockBits all;
    for (std::uint32_t first = 0; first < 32 && (mask >> first) != 0; first += PlaneBlock::kLanes) {
        if (((mask >> first) & kBlockBits) == 0) continue;
        const BlockBits bits = test(blocks[first / PlaneBlock::kLanes]);
        all.outside |= (bits.outside << first) & mask;
        all.inside |= (bits.inside << first) & mask;
        all.open |= (bits.open << first) & mask;
    }
    return all;
}

template <class Bin>
HWY_NOINLINE Verdict overManyBlocks(const Bin& bin, const SphereData& sphere, const PlaneBlock* blocks,
                                    std::uint32_t undecided) {
    const BlockBits coarse =
        overBlocks(blocks, undecided, [&](const PlaneBlock& block) HWY_ATTR { return sphereBits(sphere, block); });
    const std::uint32_t left = unlessAny(coarse.outside, undecided & ~coarse.inside);
    if (left == 0) return Verdict::of(coarse.outside, coarse.inside);
    const BlockBits hull =
        overBlocks(blocks, left, [&](const PlaneBlock& block) HWY_ATTR { return hullBits(bin, block); });
    const std::uint32_t open = unlessAny(hull.outside, hull.open);
    if (open == 0) return Verdict::of(hull.outside, coarse.inside | hull.inside);
    const BlockBits full =
        overBlocks(blocks, open, [&](const PlaneBlock& block) HWY_ATTR { return fullBits(bin, block); });
    return Verdict::of(full.outside, coarse.inside | hull.inside | full.inside, unlessAny(full.outside, full.open));
}

template <class Bin>
HWY_INLINE Verdict inStages(const Bin& bin, const SphereData& sphere, const PlaneBlock* blocks,
                            std::uint32_t undecided) {
    if (undecided - 1 < kBlockBits) return overOneBlock(bin, sphere, blocks[0], undecided);
    return overManyBlocks(bin, sphere, blocks, undecided);
}

Verdict exactVector(const ExactBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin, bin.sphere, blocks, undecided);
}

Verdict quadraticVector(const QuadraticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin, bin.sphere, blocks, undecided);
}

Verdict geodeticVector(const GeodeticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin, bin.sphere(), blocks, undecided);
}

namespace family {

// In this order.
// clang-format off
#include "core/kernels/VectorNumbers.inl"
#include "core/kernels/QuadraticTest.inl"
#include "core/kernels/ExactTest.inl"
#include "core/kernels/HorizonTest.inl"
#include "core/kernels/FamilyStages.inl"
// clang-format on
#undef INLINE
#undef NOINLINE
#undef ATTRIBUTES

using Wide = hn::Vec<hn::CappedTag<double, 8>>;
using Narrow = hn::Vec<hn::CappedTag<double, 4>>;

}  // namespace family

void familyVector(const FamilyData& data, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict) {
    family::classifyFamily<family::Wide, family::Narrow>(data, blocks, masks, verdict);
}

std::uint64_t hiddenVector(const FamilyData& data, const HorizonEyeData& eye, std::uint64_t candidates) {
    return family::hiddenOfFamily<family::Wide, family::Narrow>(data, eye, candidates);
}

}  // namespace HWY_NAMESPACE
}  // namespace osgAnalyticBin::core::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osgAnalyticBin::core::kernels {

HWY_EXPORT(exactVector);
HWY_EXPORT(quadraticVector);
HWY_EXPORT(geodeticVector);
HWY_EXPORT(familyVector);
HWY_EXPORT(hiddenVector);

namespace {

struct ChooseAtStart {
    ChooseAtStart() noexcept { chooseKernels(); }
};

}  // namespace

// Constant initialisation first: whoever classifies before this file's turn gets the scalar form.
PlaneKernels activeKernels{exactScalar, quadraticScalar, geodeticScalar, familyScalar, hiddenScalar};
const ChooseAtStart kChooseAtStart;

void chooseKernels() noexcept {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    activeKernels = {&HWY_DYNAMIC_DISPATCH(exactVector), &HWY_DYNAMIC_DISPATCH(quadraticVector),
                     &HWY_DYNAMIC_DISPATCH(geodeticVector), &HWY_DYNAMIC_DISPATCH(familyVector),
                     &HWY_DYNAMIC_DISPATCH(hiddenVector)};
}

}  // namespace osgAnalyticBin::core::kernels
#endif
