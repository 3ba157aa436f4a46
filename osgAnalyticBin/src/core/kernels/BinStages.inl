// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// One bin against planes, with the planes in the lanes: the stages of QuadraticTest.inl and ExactTest.inl, over one
// block of planes after the other. Included behind them.

// One bin for all lanes.
template <class Real>
struct OneBin {
    const double* numbers;
    INLINE Real operator[](std::size_t row) const { return broadcast<Real>(numbers[row]); }
};

template <class Real>
INLINE PlaneLanes<Real> planesOf(const PlaneBlock& block, std::size_t i) {
    return {load<Real>(block.normalX + i), load<Real>(block.normalY + i), load<Real>(block.normalZ + i),
            load<Real>(block.offset + i), load<Real>(block.rounding + i)};
}

// A bin, and which form it has.
struct BinNumbers {
    const double* numbers;
    bool isExact;
};

// The planes of one block, or of all, one bit each.
struct PlaneBits {
    std::uint32_t outside = 0, inside = 0, open = 0;
};

constexpr std::uint32_t kBlockBits = (1u << PlaneBlock::kLanes) - 1;

template <class Test, class Real>
INLINE PlaneBits overBlock(const BinNumbers& bin, const PlaneBlock& block, std::uint32_t asked) {
    PlaneBits bits;
    for (std::size_t i = 0; i < PlaneBlock::kLanes; i += lanesOf<Real>()) {
        if (lanesOf<Real>() == 1 && (asked >> i & 1) == 0) continue;
        const Sides<Real> sides = Test::sides(OneBin<Real>{bin.numbers}, planesOf<Real>(block, i));
        bits.outside |= static_cast<std::uint32_t>(laneBits<Real>(sides.outside)) << i;
        bits.inside |= static_cast<std::uint32_t>(laneBits<Real>(sides.inside)) << i;
        bits.open |= static_cast<std::uint32_t>(laneBits<Real>(sides.open)) << i;
    }
    return bits;
}

// The stages, for either form.
struct SphereStage {
    template <class Real>
    static INLINE PlaneBits bits(const BinNumbers& bin, const PlaneBlock& block, std::uint32_t asked) {
        return overBlock<Sphere, Real>(bin, block, asked);
    }
};
struct CoarseStage {
    template <class Real>
    static INLINE PlaneBits bits(const BinNumbers& bin, const PlaneBlock& block, std::uint32_t asked) {
        return bin.isExact ? overBlock<ExactForm::Coarse, Real>(bin, block, asked)
                           : overBlock<QuadraticForm::Coarse, Real>(bin, block, asked);
    }
};
// One bin in thirty to fifty: kept out of line, so that the others do not save registers for it.
struct FineStage {
    template <class Real>
    static NOINLINE PlaneBits bits(const BinNumbers& bin, const PlaneBlock& block, std::uint32_t asked) {
        return bin.isExact ? overBlock<ExactForm::Fine, Real>(bin, block, asked)
                           : overBlock<QuadraticForm::Fine, Real>(bin, block, asked);
    }
};

// What a stage says of the planes of a mask, block by block.
template <class Stage, class Real>
INLINE PlaneBits overBlocks(const BinNumbers& bin, const PlaneBlock* blocks, std::uint32_t mask) {
    PlaneBits all;
    for (std::uint32_t first = 0; first < 32 && (mask >> first) != 0; first += PlaneBlock::kLanes) {
        const std::uint32_t asked = (mask >> first) & kBlockBits;
        if (asked == 0) continue;
        const PlaneBits bits = Stage::template bits<Real>(bin, blocks[first / PlaneBlock::kLanes], asked);
        all.outside |= (bits.outside << first) & mask;
        all.inside |= (bits.inside << first) & mask;
        all.open |= (bits.open << first) & mask;
    }
    return all;
}

// The usual case by itself: the side planes of a camera.
struct OneBlock {
    template <class Stage, class Real>
    static INLINE PlaneBits bits(const BinNumbers& bin, const PlaneBlock* blocks, std::uint32_t mask) {
        const PlaneBits bits = Stage::template bits<Real>(bin, blocks[0], mask);
        return {bits.outside & mask, bits.inside & mask, bits.open & mask};
    }
};
struct ManyBlocks {
    template <class Stage, class Real>
    static INLINE PlaneBits bits(const BinNumbers& bin, const PlaneBlock* blocks, std::uint32_t mask) {
        return overBlocks<Stage, Real>(bin, blocks, mask);
    }
};

// `mask` if no bit of `outside` is set, else nothing: one branch on the result is mispredicted less often than two.
INLINE std::uint32_t unlessAny(std::uint32_t outside, std::uint32_t mask) {
    return mask & (((outside | (0u - outside)) >> 31) - 1u);
}

template <class Blocks, class Real>
INLINE PlaneSides classifyInStages(const BinNumbers& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    const PlaneBits sphere = Blocks::template bits<SphereStage, Real>(bin, blocks, undecided);
    const std::uint32_t left = unlessAny(sphere.outside, undecided & ~sphere.inside);
    if (left == 0) return PlaneSides::of(sphere.outside, sphere.inside);
    const PlaneBits coarse = Blocks::template bits<CoarseStage, Real>(bin, blocks, left);
    const std::uint32_t open = unlessAny(coarse.outside, coarse.open);
    std::uint32_t inside = sphere.inside | coarse.inside;
    if (open == 0) return PlaneSides::of(coarse.outside, inside);
    const PlaneBits fine = Blocks::template bits<FineStage, Real>(bin, blocks, open);
    const std::uint32_t last = unlessAny(fine.outside, fine.open);
    inside |= fine.inside;
    if (last == 0) return PlaneSides::of(fine.outside, inside);
    const PlaneSides exact = sidesByExactRange(bin.numbers, 1, blocks, last);
    return PlaneSides::of(exact.outside(), inside | exact.inside());
}

template <class Real>
NOINLINE PlaneSides classifyByManyBlocks(const BinNumbers& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    return classifyInStages<ManyBlocks, Real>(bin, blocks, undecided);
}

template <class Real>
INLINE PlaneSides classifyBin(const BinNumbers& bin, const PlaneBlock* blocks, std::uint32_t undecided) {
    if (undecided - 1 < kBlockBits) return classifyInStages<OneBlock, Real>(bin, blocks, undecided);
    return classifyByManyBlocks<Real>(bin, blocks, undecided);
}
