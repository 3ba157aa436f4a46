// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// ScalarNumbers.inl for Highway's vectors of doubles. Additions, multiplications and comparisons are Highway's
// operators.

#define INLINE HWY_INLINE
#define NOINLINE HWY_NOINLINE
#define ATTRIBUTES HWY_ATTR

template <class Real>
using Tag = hn::DFromV<Real>;
template <class Real>
using BitsTag = hn::RebindToUnsigned<Tag<Real>>;
template <class Real>
using Truth = hn::Mask<Tag<Real>>;
template <class Real>
using Bits = hn::Vec<BitsTag<Real>>;  // one bit a plane

template <class Real>
HWY_INLINE constexpr std::size_t lanesOf() {
    return hn::MaxLanes(Tag<Real>());
}

template <class Real>
HWY_INLINE Real broadcast(double x) {
    return hn::Set(Tag<Real>(), x);
}
template <class Real>
HWY_INLINE Real load(const double* x) {
    return hn::LoadU(Tag<Real>(), x);
}

template <class Real>
HWY_INLINE Real larger(Real a, Real b) {
    return hn::Max(a, b);
}
template <class Real>
HWY_INLINE Real smaller(Real a, Real b) {
    return hn::Min(a, b);
}
template <class Real>
HWY_INLINE Real magnitude(Real x) {
    return hn::Abs(x);
}
template <class Real>
HWY_INLINE Real negated(Real x) {
    return hn::Neg(x);
}
template <class Real>
HWY_INLINE Real root(Real x) {
    return hn::Sqrt(x);
}
template <class Real>
HWY_INLINE double leastLane(Real x) {
    return hn::GetLane(hn::MinOfLanes(Tag<Real>(), x));
}
template <class Real>
HWY_INLINE Real select(Truth<Real> where, Real yes, Real no) {
    return hn::IfThenElse(where, yes, no);
}

template <class M>
HWY_INLINE M both(M a, M b) {
    return hn::And(a, b);
}
template <class M>
HWY_INLINE M either(M a, M b) {
    return hn::Or(a, b);
}
template <class M>
HWY_INLINE M without(M a, M b) {
    return hn::AndNot(b, a);
}
template <class Real>
HWY_INLINE Truth<Real> neither(Truth<Real> a, Truth<Real> b) {
    return hn::Not(hn::Or(a, b));
}
template <class Real>
HWY_INLINE Truth<Real> nowhere() {
    return hn::MaskFromVec(hn::Zero(Tag<Real>()));
}
template <class Real>
HWY_INLINE bool anyWhere(Truth<Real> where) {
    return !hn::AllFalse(Tag<Real>(), where);
}

template <class Real>
HWY_INLINE bool isEverywhere(Truth<Real> where) {
    return hn::AllTrue(Tag<Real>(), where);
}

template <class Real>
HWY_INLINE Bits<Real> bits(std::uint32_t all) {
    return hn::Set(BitsTag<Real>(), all);
}
template <class Real>
HWY_INLINE Bits<Real> bitsWhere(Truth<Real> where, std::uint32_t all) {
    return hn::IfThenElseZero(hn::RebindMask(BitsTag<Real>(), where), bits<Real>(all));
}
template <class Real>
HWY_INLINE Bits<Real> zeroWhere(Truth<Real> where, Bits<Real> bits) {
    return hn::IfThenZeroElse(hn::RebindMask(BitsTag<Real>(), where), bits);
}
template <class B>
HWY_INLINE B exclusive(B a, B b) {
    return hn::AndNot(b, a);
}
template <class Real>
HWY_INLINE Truth<Real> whereBit(Bits<Real> of, std::uint32_t bit) {
    return hn::RebindMask(Tag<Real>(), hn::TestBit(of, bits<Real>(bit)));
}
template <class Real>
HWY_INLINE Truth<Real> isZero(Bits<Real> of) {
    return hn::RebindMask(Tag<Real>(), of == bits<Real>(0));
}
template <class Real>
HWY_INLINE bool isZeroEverywhere(Bits<Real> of) {
    return hn::AllTrue(BitsTag<Real>(), of == bits<Real>(0));
}
template <class B>
HWY_INLINE std::uint32_t anyLaneOf(B of) {
#if HWY_TARGET != HWY_SCALAR
    using D = hn::DFromV<B>;
    const hn::Half<D> half;
    if constexpr (hn::MaxLanes(D()) > 1) return anyLaneOf(hn::LowerHalf(half, of) | hn::UpperHalf(half, of));
#endif
    return static_cast<std::uint32_t>(hn::GetLane(of));
}
template <class Real>
HWY_INLINE std::uint32_t anyLane(Bits<Real> of) {
    return anyLaneOf(of);
}
template <class Real>
HWY_INLINE void store(Bits<Real> of, std::uint32_t* to) {
    const hn::Rebind<std::uint32_t, Tag<Real>> narrow;
    hn::StoreU(hn::TruncateTo(narrow, of), narrow, to);
}

template <class Real>
HWY_INLINE void store(Real x, double* to) {
    hn::StoreU(x, Tag<Real>(), to);
}

template <class Real>
HWY_INLINE void storeAll(std::uint32_t all, std::uint32_t* to) {
    const hn::Rebind<std::uint32_t, Tag<Real>> narrow;
    hn::StoreU(hn::Set(narrow, all), narrow, to);
}

template <class Real>
HWY_INLINE std::uint64_t laneBits(Truth<Real> where) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag<Real>(), where, bytes);
    return bytes[0];
}
template <class Real>
HWY_INLINE Truth<Real> whereLanes(std::uint64_t slots) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(slots)};
    return hn::LoadMaskBits(Tag<Real>(), bytes);
}
