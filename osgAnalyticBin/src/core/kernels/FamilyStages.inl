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

// The slots that are outside of a plane by their spheres.
template <class Real>
INLINE Truth<Real> outsideBySphere(const Slots<Real>& bins, const PlaneBlock* blocks, std::uint32_t tested) {
    const auto isOutside = [&](unsigned i) ATTRIBUTES { return Sphere::sides(bins, planeOf<Real>(blocks, i)).outside; };
    // The usual case by itself: the side planes of a camera.
    if (tested == 0b1111) {
        return either(either(isOutside(0), isOutside(1)), either(isOutside(2), isOutside(3)));
    }
    Truth<Real> outside = nowhere<Real>();
    for (std::uint32_t left = tested; left != 0; left &= left - 1) outside = either(outside, isOutside(firstBit(left)));
    return outside;
}

// What is known of each lane: whether a plane has it outside; the planes that have it inside, and those that a finer
// test has to tell about.
template <class Real>
struct Known {
    Truth<Real> outside;
    Bits<Real> inside, open;
};

// The planes that have the slots inside by their spheres; the others are open, unless the slot is outside.
template <class Real>
INLINE Known<Real> insideBySphere(const Slots<Real>& bins, const PlaneBlock* blocks, std::uint32_t tested,
                                  Truth<Real> outside) {
    const auto whereInside = [&](unsigned i) ATTRIBUTES {
        return bitsWhere<Real>(Sphere::sides(bins, planeOf<Real>(blocks, i)).inside, std::uint32_t{1} << i);
    };
    Bits<Real> inside = bits<Real>(0);
    if (tested == 0b1111) {
        inside = (whereInside(0) | whereInside(1)) | (whereInside(2) | whereInside(3));
    } else {
        for (std::uint32_t left = tested; left != 0; left &= left - 1) inside = inside | whereInside(firstBit(left));
    }
    return {outside, inside, zeroWhere<Real>(outside, exclusive(bits<Real>(tested), inside))};
}

// One stage more for what is open.
template <class Test, class Real>
INLINE Known<Real> testOpen(const Slots<Real>& bins, const PlaneBlock* blocks, const Known<Real>& known) {
    Truth<Real> outside = known.outside;
    Bits<Real> inside = known.inside;
    Bits<Real> open = bits<Real>(0);
    for (std::uint32_t left = anyLane<Real>(known.open); left != 0; left &= left - 1) {
        const unsigned i = firstBit(left);
        const std::uint32_t bit = std::uint32_t{1} << i;
        const Sides<Real> sides = Test::sides(bins, planeOf<Real>(blocks, i));
        const Truth<Real> asked = whereBit<Real>(known.open, bit);
        outside = either(outside, both(asked, sides.outside));
        inside = inside | bitsWhere<Real>(both(asked, sides.inside), bit);
        open = open | bitsWhere<Real>(both(asked, sides.open), bit);
    }
    return {outside, inside, zeroWhere<Real>(outside, open)};
}

// Some slots of a family and what is asked of them.
template <class Real>
struct Question {
    const FamilyData& family;
    std::size_t first;
    const PlaneBlock* blocks;
    const PlaneMasks& masks;
    std::uint32_t* undecided;  // for each slot of the family

    INLINE Slots<Real> bins() const { return {family.numbers + first, family.stride}; }
};

// One bit a slot.
struct FamilySides {
    std::uint64_t outside, insideAll;
};

// The answer, when nothing is open.
template <class Real>
INLINE FamilySides settled(const Question<Real>& q, const Known<Real>& known) {
    const Bits<Real> left = exclusive(bits<Real>(q.masks.undecided), zeroWhere<Real>(known.outside, known.inside));
    store<Real>(left, q.undecided + q.first);
    return {laneBits<Real>(known.outside) << q.first, laneBits<Real>(without(isZero<Real>(left), known.outside))
                                                          << q.first};
}

// One plane in a thousand.
template <class Real>
INLINE FamilySides settledByExactRange(const Question<Real>& q, const Known<Real>& known) {
    FamilySides all = settled(q, known);
    std::uint32_t open[lanesOf<Real>()];
    store<Real>(known.open, open);
    for (std::size_t k = 0; k < lanesOf<Real>(); ++k) {
        if (open[k] == 0) continue;
        const std::size_t i = q.first + k;
        const PlaneSides sides = sidesByExactRange(q.family.numbers + i, q.family.stride, q.blocks, open[k]);
        const bool isOutside = sides.outside() != 0;
        q.undecided[i] = isOutside ? q.masks.undecided : q.undecided[i] & ~sides.inside();
        all.outside |= std::uint64_t{isOutside} << i;
        all.insideAll |= std::uint64_t{!isOutside && q.undecided[i] == 0} << i;
    }
    return all;
}

// One family in a dozen: kept out of line, so that the others do not save registers for it.
template <class Form, class Real>
NOINLINE FamilySides settledByFineTest(const Question<Real>& q, const Known<Real>& coarse) {
    return settledByExactRange(q, testOpen<typename Form::Fine>(q.bins(), q.blocks, coarse));
}

template <class Form, class Real>
INLINE FamilySides settledInStages(const Question<Real>& q, const Known<Real>& known) {
    const Known<Real> coarse = testOpen<typename Form::Coarse>(q.bins(), q.blocks, known);
    if (isZeroEverywhere<Real>(coarse.open)) return settled(q, coarse);
    return settledByFineTest<Form>(Question<Real>(q), Known<Real>(coarse));
}

// Lanes of both forms: each with its own stages.
template <class Real>
NOINLINE FamilySides settledForMixedForms(const Question<Real>& q, std::uint64_t exact, const Known<Real>& known) {
    const auto inStages = [&](auto form, const Known<Real>& before) ATTRIBUTES {
        using Form = decltype(form);
        const Known<Real> coarse = testOpen<typename Form::Coarse>(q.bins(), q.blocks, before);
        return testOpen<typename Form::Fine>(q.bins(), q.blocks, coarse);
    };
    const Bits<Real> openQuadratic = zeroWhere<Real>(whereLanes<Real>(exact), known.open);
    const Bits<Real> openExact = exclusive(known.open, openQuadratic);
    const Known<Real> quadratic = inStages(QuadraticForm(), Known<Real>{known.outside, known.inside, openQuadratic});
    const Known<Real> all = inStages(ExactForm(), Known<Real>{quadratic.outside, quadratic.inside, openExact});
    return settledByExactRange(q, Known<Real>{all.outside, all.inside, quadratic.open});
}

// What is left when the spheres are not all outside.
template <class Real>
INLINE FamilySides classifyFurther(const Question<Real>& q, Truth<Real> outside) {
    constexpr std::uint64_t kAll = (std::uint64_t{1} << lanesOf<Real>()) - 1;
    const Known<Real> known = insideBySphere<Real>(q.bins(), q.blocks, q.masks.tested, outside);
    const std::uint64_t exact = (q.family.exact >> q.first) & kAll;
    if (exact == 0) return settledInStages<QuadraticForm>(q, known);
    if (exact == kAll) return settledInStages<ExactForm>(q, known);
    return settledForMixedForms(Question<Real>(q), exact, Known<Real>(known));
}

// A slot without a bin was outside of every plane.
INLINE void write(const FamilyData& family, const FamilySides& sides, std::uint32_t undecided, FamilyVerdict& verdict) {
    verdict.outside = sides.outside & family.filled;
    verdict.insideAll = sides.insideAll & family.filled;
    for (std::uint64_t left = family.empty; left != 0; left &= left - 1) verdict.undecided[firstBit(left)] = undecided;
}

// A family that is no larger than one vector, in two parts: what is out of line needs many registers.
template <class Real>
NOINLINE void classifyOneFurther(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks,
                                 std::uint64_t outside, FamilyVerdict& verdict) {
    const Question<Real> question{family, 0, blocks, masks, verdict.undecided};
    write(family, classifyFurther<Real>(question, whereLanes<Real>(outside)), masks.undecided, verdict);
}

template <class Real>
INLINE void classifyOne(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks, FamilyVerdict& verdict) {
    constexpr std::uint64_t kAll = (std::uint64_t{1} << lanesOf<Real>()) - 1;
    const Slots<Real> bins{family.numbers, lanesOf<Real>()};
    const std::uint64_t outside = laneBits<Real>(outsideBySphere<Real>(bins, blocks, masks.tested));
    if (outside != kAll) return classifyOneFurther<Real>(family, blocks, masks, outside, verdict);
    verdict.outside = family.filled;
    verdict.insideAll = 0;
    storeAll<Real>(masks.undecided, verdict.undecided);
}

template <class Real>
INLINE FamilySides classifySlots(const Question<Real>& q) {
    constexpr std::uint64_t kAll = (std::uint64_t{1} << lanesOf<Real>()) - 1;
    const Truth<Real> outside = outsideBySphere<Real>(q.bins(), q.blocks, q.masks.tested);
    if (!isEverywhere<Real>(outside)) return classifyFurther<Real>(q, outside);
    storeAll<Real>(q.masks.undecided, q.undecided + q.first);
    return {kAll << q.first, 0};
}

// Any family, in wide vectors as far as these go.
template <class Wide, class Narrow>
NOINLINE void classifyMany(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks,
                           FamilyVerdict& verdict) {
    FamilySides all{};
    std::size_t i = 0;
    for (; i + lanesOf<Wide>() <= family.stride; i += lanesOf<Wide>()) {
        const FamilySides sides = classifySlots(Question<Wide>{family, i, blocks, masks, verdict.undecided});
        all = {all.outside | sides.outside, all.insideAll | sides.insideAll};
    }
    for (; i < family.stride; i += lanesOf<Narrow>()) {
        const FamilySides sides = classifySlots(Question<Narrow>{family, i, blocks, masks, verdict.undecided});
        all = {all.outside | sides.outside, all.insideAll | sides.insideAll};
    }
    write(family, all, masks.undecided, verdict);
}

template <class Wide, class Narrow>
INLINE void classifyFamily(const FamilyData& family, const PlaneBlock* blocks, PlaneMasks masks,
                           FamilyVerdict& verdict) {
    if (family.stride == lanesOf<Narrow>()) return classifyOne<Narrow>(family, blocks, masks, verdict);
    classifyMany<Wide, Narrow>(family, blocks, masks, verdict);
}

template <class Real>
INLINE std::uint64_t hiddenSlots(const FamilyData& family, std::size_t first, const HorizonEyeData& eye,
                                 std::uint64_t candidates) {
    const std::uint64_t all = (std::uint64_t{1} << lanesOf<Real>()) - 1;
    std::uint64_t asked = (candidates >> first) & all;
    if (asked == 0) return 0;
    const Slots<Real> bins{family.numbers + row::kBinRows * family.stride + first, family.stride};
    asked &= ~laneBits<Real>(showsAnEnd<Real>(bins, eye));
    if (asked == 0) return 0;
    return (asked & laneBits<Real>(isBehindHorizon<Real>(bins, eye))) << first;
}

template <class Wide, class Narrow>
INLINE std::uint64_t hiddenOfFamily(const FamilyData& family, const HorizonEyeData& eye, std::uint64_t candidates) {
    std::uint64_t hidden = 0;
    std::size_t i = 0;
    for (; i + lanesOf<Wide>() <= family.stride; i += lanesOf<Wide>()) {
        hidden |= hiddenSlots<Wide>(family, i, eye, candidates);
    }
    for (; i < family.stride; i += lanesOf<Narrow>()) hidden |= hiddenSlots<Narrow>(family, i, eye, candidates);
    return hidden;
}
