// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// ScalarKernels.cpp over four planes at once: the same operations in the same order, multiplications and additions
// apart, so that every verdict is the same bit for bit. Highway compiles this file once for each instruction set.

#include "core/kernels/PlaneKernels.h"

// clang-format off: the order matters, and the first of the two includes this file again.
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
    // The extremum of the whole circle.
    if (anyOf(hn::Or(hasPeak, hasDip))) {
        const V length = hn::Sqrt(hn::Add(hn::Mul(nx, nx), hn::Mul(ny, ny)));
        range.upper = hn::IfThenElse(hasPeak, length, range.upper);
        range.lower = hn::IfThenElse(hasDip, hn::Neg(length), range.lower);
    }
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

HWY_INLINE V largestAlongMeridian(const ExactBinData& bin, V c, V nz) {
    const V rise = hn::Sub(hn::Mul(each(bin.cosSouth), nz), hn::Mul(each(bin.sinSouth), c));
    const V fall = hn::Sub(hn::Mul(each(bin.cosNorth), nz), hn::Mul(each(bin.sinNorth), c));
    const V atEnds = hn::Max(hn::Max(alongPoint(bin.topSouth, c, nz), alongPoint(bin.bottomSouth, c, nz)),
                             hn::Max(alongPoint(bin.topNorth, c, nz), alongPoint(bin.bottomNorth, c, nz)));
    const M within = hn::And(positive(rise), negative(fall));
    return anyOf(within) ? hn::IfThenElse(within, surfaceSupport(bin, c, nz), atEnds) : atEnds;
}

HWY_INLINE V smallestAlongMeridian(const ExactBinData& bin, V c, V nz) {
    const V rise = hn::Sub(hn::Mul(each(bin.cosSouth), nz), hn::Mul(each(bin.sinSouth), c));
    const V fall = hn::Sub(hn::Mul(each(bin.cosNorth), nz), hn::Mul(each(bin.sinNorth), c));
    const V atEnds = hn::Min(hn::Min(alongPoint(bin.topSouth, c, nz), alongPoint(bin.bottomSouth, c, nz)),
                             hn::Min(alongPoint(bin.topNorth, c, nz), alongPoint(bin.bottomNorth, c, nz)));
    const M within = hn::And(negative(rise), positive(fall));
    return anyOf(within) ? hn::IfThenElse(within, hn::Neg(surfaceSupport(bin, c, nz)), atEnds) : atEnds;
}

struct Sides {
    M outside, inside;
};

// Written so that NaN is neither.
HWY_INLINE Sides sidesOf(V lower, V upper, V slack) {
    return {negative(hn::Add(upper, slack)), hn::Ge(hn::Sub(lower, slack), hn::Zero(Tag()))};
}

HWY_INLINE Sides sphereSides(const double (&center)[3], double reach, const Lanes& plane) {
    const V distance = hn::Add(dot(plane, center), plane.offset);
    return {hn::Lt(hn::Add(distance, plane.rounding), each(-reach)),
            hn::Ge(hn::Sub(distance, plane.rounding), each(reach))};
}

HWY_INLINE Sides exactSides(const ExactBinData& bin, const Lanes& plane) {
    const VRange c = rangeAlongParallel(bin, plane.nx, plane.ny);
    const V lower = smallestAlongMeridian(bin, c.lower, plane.nz);
    const V upper = largestAlongMeridian(bin, c.upper, plane.nz);
    const V slack = hn::Add(each(bin.slack), hn::Mul(each(0.25), plane.rounding));
    return sidesOf(hn::Add(plane.offset, lower), hn::Add(plane.offset, upper), slack);
}

// The third mask: planes that only the exact range decides.
HWY_INLINE Sides quadraticSides(const QuadraticBinData& bin, const Lanes& plane, M& open) {
    // The polynomial, [JJ] eq. (3).
    const V value = hn::Add(dot(plane, bin.value), plane.offset);
    const V gu = dot(plane, bin.first[0]);
    const V gv = dot(plane, bin.first[1]);
    const V gw = dot(plane, bin.first[2]);
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
    const V slope = hn::Add(hn::Add(hn::Abs(gu), hn::Abs(gv)), hn::Abs(gw));
    const V spread = hn::Add(hn::Add(hn::Add(slope, hn::Abs(uv)), hn::Abs(uw)), hn::Abs(vw));
    const V below = hn::Add(hn::Add(hn::Mul(half, hn::Min(uu, zero)), hn::Mul(half, hn::Min(vv, zero))),
                            hn::Mul(half, hn::Min(ww, zero)));
    const V above = hn::Add(hn::Add(hn::Mul(half, hn::Max(uu, zero)), hn::Mul(half, hn::Max(vv, zero))),
                            hn::Mul(half, hn::Max(ww, zero)));
    const Sides bounded =
        sidesOf(hn::Add(hn::Sub(value, spread), below), hn::Add(hn::Add(value, spread), above), slack);
    // The corners along and against the gradient: values that are attained. When the plane passes between them, the
    // exact range could not say anything else.
    const V u = hn::CopySign(each(1.0), gu);
    const V v = hn::CopySign(each(1.0), gv);
    const V w = hn::CopySign(each(1.0), gw);
    const V squares = hn::Mul(half, hn::Add(hn::Add(uu, vv), ww));
    const V products =
        hn::Add(hn::Add(hn::Mul(uv, hn::Mul(u, v)), hn::Mul(uw, hn::Mul(u, w))), hn::Mul(vw, hn::Mul(v, w)));
    const V even = hn::Add(squares, products);
    const Sides attained = sidesOf(hn::Add(hn::Sub(value, slope), even), hn::Add(hn::Add(value, slope), even), slack);
    open = hn::AndNot(hn::Or(bounded.outside, bounded.inside), hn::Or(attained.outside, attained.inside));
    return bounded;
}

// Blocks that a mask reaches, and in each as many steps as the vectors need.
template <class Test>
HWY_INLINE void forEachBlock(const PlaneBlock* blocks, std::uint32_t mask, const Test& test) {
    const std::size_t lanes = hn::Lanes(Tag());
    for (std::uint32_t first = 0; first < 32 && (mask >> first) != 0; first += PlaneBlock::kLanes) {
        if (((mask >> first) & kBlockBits) == 0) continue;
        for (std::size_t i = 0; i < PlaneBlock::kLanes; i += lanes) {
            test(Lanes(blocks[first / PlaneBlock::kLanes], i), first + static_cast<std::uint32_t>(i));
        }
    }
}

// The sphere over all planes, then the finer test over those it left.
template <class FineTest>
HWY_INLINE Verdict inStages(const double (&center)[3], double reach, const PlaneBlock* blocks, std::uint32_t undecided,
                            const FineTest& fine) {
    Verdict coarse{};
    forEachBlock(blocks, undecided, [&](const Lanes& plane, std::uint32_t shift) HWY_ATTR {
        const Sides sides = sphereSides(center, reach, plane);
        coarse.outside |= bitsOf(sides.outside) << shift;
        coarse.inside |= bitsOf(sides.inside) << shift;
    });
    coarse.outside &= undecided;
    coarse.inside &= undecided;
    const std::uint32_t left = undecided & ~coarse.inside;
    if (coarse.outside != 0 || left == 0) return coarse;
    Verdict verdict{};
    forEachBlock(blocks, left, [&](const Lanes& plane, std::uint32_t shift) HWY_ATTR { fine(plane, shift, verdict); });
    return {verdict.outside & left, (verdict.inside & left) | coarse.inside, verdict.open & left};
}

Verdict exactVector(const ExactBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin.center, bin.reach, blocks, undecided,
                    [&](const Lanes& plane, std::uint32_t shift, Verdict& verdict) HWY_ATTR {
                        const Sides sides = exactSides(bin, plane);
                        verdict.outside |= bitsOf(sides.outside) << shift;
                        verdict.inside |= bitsOf(sides.inside) << shift;
                    });
}

Verdict quadraticVector(const QuadraticBinData& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return inStages(bin.value, bin.reach, blocks, undecided,
                    [&](const Lanes& plane, std::uint32_t shift, Verdict& verdict) HWY_ATTR {
                        M open;
                        const Sides sides = quadraticSides(bin, plane, open);
                        verdict.outside |= bitsOf(sides.outside) << shift;
                        verdict.inside |= bitsOf(sides.inside) << shift;
                        verdict.open |= bitsOf(open) << shift;
                    });
}

}  // namespace HWY_NAMESPACE
}  // namespace osgAnalyticBin::core::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace osgAnalyticBin::core::kernels {

HWY_EXPORT(exactVector);
HWY_EXPORT(quadraticVector);

namespace {

struct ChooseAtStart {
    ChooseAtStart() noexcept { chooseKernels(); }
};

}  // namespace

// Constant initialisation first: whoever classifies before this file's turn gets the scalar form.
PlaneKernels activeKernels{exactScalar, quadraticScalar};
const ChooseAtStart kChooseAtStart;

void chooseKernels() noexcept {
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    activeKernels = {&HWY_DYNAMIC_DISPATCH(exactVector), &HWY_DYNAMIC_DISPATCH(quadraticVector)};
}

}  // namespace osgAnalyticBin::core::kernels
#endif
