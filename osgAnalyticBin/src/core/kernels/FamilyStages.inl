// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// A family of bins against planes, with the bins in the lanes: the stages of QuadraticTest.inl and ExactTest.inl, over
// one vector of slots after the other. Included behind them.

// Some slots of a family, as many as there are lanes.
template <class Real>
struct Slots {
    const double* first;
    std::size_t stride;
    INLINE Real operator[](std::size_t row) const { return load<Real>(first + row * stride); }
};

// One plane for all lanes.
template <class Real>
INLINE PlaneLanes<Real> planeOf(const PlaneBlock* blocks, unsigned i) {
    const PlaneBlock& block = blocks[i / PlaneBlock::kLanes];
    const unsigned k = i % PlaneBlock::kLanes;
    return {broadcast<Real>(block.normalX[k]), broadcast<Real>(block.normalY[k]), broadcast<Real>(block.normalZ[k]),
            broadcast<Real>(block.offset[k]), broadcast<Real>(block.rounding[k])};
}

// What is known of each lane: whether a plane has it outside; the planes that have it inside, and those that a finer
// test has to tell about.
template <class Real>
struct Known {
    Truth<Real> outside;
    Bits<Real> inside, open;
};

template <class Real>
INLINE void testSpheres(const Slots<Real>& bins, const PlaneBlock* blocks, std::uint32_t undecided,
                        Known<Real>& known) {
    for (std::uint32_t left = undecided; left != 0; left &= left - 1) {
        const unsigned i = firstBit(left);
        const Sides<Real> sides = sphereSides(bins, planeOf<Real>(blocks, i));
        known.outside = either(known.outside, sides.outside);
        known.inside = known.inside | bitsWhere<Real>(sides.inside, std::uint32_t{1} << i);
    }
    known.open = zeroWhere<Real>(known.outside, exclusive(bits<Real>(undecided), known.inside));
}

template <class Test, class Real>
INLINE void testOpen(const Slots<Real>& bins, const PlaneBlock* blocks, Known<Real>& known) {
    Bits<Real> open = bits<Real>(0);
    for (std::uint32_t left = anyLane<Real>(known.open); left != 0; left &= left - 1) {
        const unsigned i = firstBit(left);
        const std::uint32_t bit = std::uint32_t{1} << i;
        const Sides<Real> sides = Test::sides(bins, planeOf<Real>(blocks, i));
        const Truth<Real> asked = whereBit<Real>(known.open, bit);
        known.outside = either(known.outside, both(asked, sides.outside));
        known.inside = known.inside | bitsWhere<Real>(both(asked, sides.inside), bit);
        open = open | bitsWhere<Real>(both(asked, sides.open), bit);
    }
    known.open = zeroWhere<Real>(known.outside, open);
}

// One family in a dozen: kept out of line, so that the others do not save registers for it.
template <class Test, class Real>
NOINLINE void testOpenSeldom(const Slots<Real>& bins, const PlaneBlock* blocks, Known<Real>& known) {
    testOpen<Test>(bins, blocks, known);
}

template <class Form, class Real>
INLINE void refine(const Slots<Real>& bins, const PlaneBlock* blocks, Known<Real>& known) {
    testOpen<typename Form::Coarse>(bins, blocks, known);
    if (anyLane<Real>(known.open) != 0) testOpenSeldom<typename Form::Fine>(bins, blocks, known);
}

// Lanes of both forms: each with its own stages.
template <class Real>
NOINLINE void refineMixed(const Slots<Real>& bins, const PlaneBlock* blocks, std::uint64_t exact, Known<Real>& known) {
    const Truth<Real> isExact = whereSlots<Real>(exact);
    const Bits<Real> open = known.open;
    known.open = zeroWhere<Real>(isExact, open);
    refine<QuadraticForm>(bins, blocks, known);
    const Bits<Real> openQuadratic = known.open;
    known.open = exclusive(open, zeroWhere<Real>(isExact, open));
    refine<ExactForm>(bins, blocks, known);
    known.open = known.open | openQuadratic;
}

template <class Real>
INLINE void classifySlots(const FamilyData& family, std::size_t first, const PlaneBlock* blocks, std::uint32_t tested,
                          std::uint32_t undecided, FamilyVerdict& verdict, OpenPlanes& open) {
    const Slots<Real> bins{family.numbers + first, family.stride};
    Known<Real> known{nowhere<Real>(), bits<Real>(0), bits<Real>(0)};
    testSpheres(bins, blocks, tested, known);
    if (anyLane<Real>(known.open) != 0) {
        const std::uint64_t all = (std::uint64_t{1} << lanesOf<Real>()) - 1;
        const std::uint64_t exact = (family.exact >> first) & all;
        if (exact == 0) {
            refine<QuadraticForm>(bins, blocks, known);
        } else if (exact == all) {
            refine<ExactForm>(bins, blocks, known);
        } else {
            refineMixed(bins, blocks, exact, known);
        }
        const std::uint64_t slots = ~slotsOf<Real>(isZero<Real>(known.open)) & all;
        if (slots != 0) {
            open.slots |= slots << first;
            store<Real>(known.open, open.planes + first);
        }
    }
    const Bits<Real> left = exclusive(bits<Real>(undecided), known.inside);
    store<Real>(left, verdict.undecided + first);
    const std::uint64_t outside = slotsOf<Real>(known.outside);
    verdict.outside |= outside << first;
    verdict.insideAll |= (slotsOf<Real>(isZero<Real>(left)) & ~outside) << first;
}

template <class Real>
INLINE std::uint64_t hiddenSlots(const FamilyData& family, std::size_t first, const HorizonEyeData& eye,
                                 std::uint64_t candidates) {
    const std::uint64_t all = (std::uint64_t{1} << lanesOf<Real>()) - 1;
    std::uint64_t asked = (candidates >> first) & all;
    if (asked == 0) return 0;
    const Slots<Real> bins{family.numbers + row::kBinRows * family.stride + first, family.stride};
    asked &= ~slotsOf<Real>(showsAnEnd<Real>(bins, eye));
    if (asked == 0) return 0;
    return (asked & slotsOf<Real>(isBehindHorizon<Real>(bins, eye))) << first;
}
