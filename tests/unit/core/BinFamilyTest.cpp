// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: classify() of a bin by itself (tested in PlaneSetTest) and HorizonEye::hides() (HorizonTest), bit for bit.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::BinFamily;
using core::FamilyVerdict;

/// In which form a slot of a family got its bin.
enum class SlotKind { Either, Exact, Quadratic, Empty };

/// A bin in all forms, and which one the family has.
struct Slot {
    core::QuadraticOrExact either;
    ExactGeodeticBin exact;
    QuadraticBin quadratic;
    HorizonBin horizon;
    SlotKind kind;
    bool hasHorizon;
};

/// Siblings, or bins of any kind side by side, and planes about them. Masks have gaps; slots are empty or cleared.
struct FamilyCase {
    explicit FamilyCase(Random& random)
        : ellipsoid(randomEllipsoid(random)),
          family(static_cast<std::size_t>(random.chance(0.02) ? 64 : random.integer(1, 9))) {
        const bool areSiblings = random.chance(0.5);
        const GeodeticBin parent = randomTile(random, random.integer(0, kDeepestLevel), randomAltitude(random));
        const SlotKind common = random.chance(0.5) ? SlotKind::Either : SlotKind::Exact;
        const bool isMixed = random.chance(0.3);
        std::vector<BinOracle> oracles;
        for (std::size_t i = 0; i < family.size(); ++i) {
            oracles.emplace_back(ellipsoid, areSiblings ? siblingOf(random, parent, i) : randomBin(random));
            constexpr std::array<SlotKind, 4> kKinds{SlotKind::Either, SlotKind::Exact, SlotKind::Quadratic,
                                                     SlotKind::Empty};
            addSlot(random, oracles.back().bin(), i, isMixed ? random.pick(kKinds) : common);
        }
        addRandomPlanes(random, oracles, planes);
        undecided = random.chance(0.5) ? planes.all() : static_cast<PlaneMask>(random.bits());
        candidates = random.chance(0.5) ? ~std::uint64_t{0} : random.bits();
        const double depth = randomDepth(random);
        eye = HorizonEye::fromEye(ellipsoid, depth, randomEye(random, ellipsoid, depth));
    }

    Ellipsoid ellipsoid;
    BinFamily family;
    std::vector<Slot> slots;
    PlaneSet planes;
    PlaneMask undecided = 0;
    std::optional<HorizonEye> eye;
    std::uint64_t candidates = 0;

private:
    static GeodeticBin siblingOf(Random& random, const GeodeticBin& parent, std::size_t i) {
        const auto part = [](const Interval& whole, std::size_t k) {
            const double lower = whole.lower + whole.width() * (0.25 * static_cast<double>(k % 4));
            return Interval{lower, std::min(whole.upper, lower + 0.25 * whole.width())};
        };
        Interval altitude = parent.altitude();
        altitude.upper = altitude.lower + altitude.width() * random.uniform();
        return {part(parent.latitude(), i / 4), part(parent.longitude(), i), altitude};
    }

    void addSlot(Random& random, const GeodeticBin& bin, std::size_t i, SlotKind kind) {
        const double margin = random.chance(0.5) ? 0.0 : random.logUniform(1e-3, 1e4);
        slots.push_back({core::quadraticOrExact(ellipsoid, bin, margin), ExactGeodeticBin(ellipsoid, bin, margin),
                         QuadraticBin(GeodeticMapping(ellipsoid), core::parameterBox(bin), margin),
                         HorizonBin(ellipsoid, bin, margin), kind, random.chance(0.9)});
        const Slot& slot = slots.back();
        // What was in the slot before must not matter.
        if (random.chance(0.2)) family.set(i, slot.exact);
        if (random.chance(0.2)) family.set(i, slot.quadratic);
        if (random.chance(0.2)) {
            family.setHorizon(i, slot.horizon);
            family.clear(i);
        }
        if (kind == SlotKind::Empty && (random.chance(0.5) || family.filled() != 0)) family.clear(i);
        if (kind == SlotKind::Either) std::visit([&](const auto& form) { family.set(i, form); }, slot.either);
        if (kind == SlotKind::Exact) family.set(i, slot.exact);
        if (kind == SlotKind::Quadratic) family.set(i, slot.quadratic);
        if (slot.hasHorizon) family.setHorizon(i, slot.horizon);
    }
};

bool has(std::uint64_t slots, std::size_t i) {
    return (slots >> i & 1) != 0;
}

// Counts of the verdicts that a run has seen, so that the test can ask for each of them.
struct Seen {
    std::array<int, 3> sides{};
    int hidden = 0;
    int shown = 0;
    int separated = 0;
};

template <class Bin>
void expectVerdictOf(const Bin& bin, const FamilyCase& c, const FamilyVerdict& verdict, std::size_t i, Seen& seen) {
    PlaneMask undecided = c.undecided;
    const Side side = core::classify(bin, c.planes, undecided);
    ASSERT_EQ(has(verdict.outside, i), side == Side::Outside);
    ASSERT_EQ(has(verdict.insideAll, i), side == Side::Inside);
    ASSERT_EQ(verdict.undecided[i], side == Side::Outside ? c.undecided : undecided);
    ++seen.sides[static_cast<std::size_t>(side)];
}

FamilyVerdict verdictOf(const BinFamily& family, const PlaneSet& planes, PlaneMask undecided) {
    FamilyVerdict verdict{};
    family.classify(planes, undecided, verdict);
    return verdict;
}

void expectVerdictsOfItsBins(const FamilyCase& c, Seen& seen) {
    const FamilyVerdict verdict = verdictOf(c.family, c.planes, c.undecided);
    for (std::size_t i = 0; i < c.slots.size(); ++i) {
        ASSERT_EQ(has(c.family.filled(), i), c.slots[i].kind != SlotKind::Empty);
        switch (c.slots[i].kind) {
            case SlotKind::Either:
                std::visit([&](const auto& form) { expectVerdictOf(form, c, verdict, i, seen); }, c.slots[i].either);
                break;
            case SlotKind::Exact:
                expectVerdictOf(c.slots[i].exact, c, verdict, i, seen);
                break;
            case SlotKind::Quadratic:
                expectVerdictOf(c.slots[i].quadratic, c, verdict, i, seen);
                break;
            case SlotKind::Empty:
                ASSERT_FALSE(has(verdict.outside, i));
                ASSERT_FALSE(has(verdict.insideAll, i));
                ASSERT_EQ(verdict.undecided[i], c.undecided);
                break;
        }
        if (testing::Test::HasFatalFailure()) return;
    }
    const std::uint64_t above = c.slots.size() == BinFamily::kMostSlots ? 0 : ~std::uint64_t{0} << c.slots.size();
    ASSERT_EQ((verdict.outside | verdict.insideAll) & above, 0u);
}

void expectHorizonOfItsBins(const FamilyCase& c, Seen& seen) {
    if (!c.eye) return;
    const std::uint64_t hidden = c.family.hiddenFrom(*c.eye, c.candidates);
    ASSERT_EQ(hidden & ~c.candidates, 0u);
    for (std::size_t i = 0; i < c.slots.size(); ++i) {
        if (!has(c.candidates, i)) continue;
        const Slot& slot = c.slots[i];
        const bool expected = slot.hasHorizon && slot.kind != SlotKind::Empty && c.eye->hides(slot.horizon);
        ASSERT_EQ(has(hidden, i), expected);
        ++(expected ? seen.hidden : seen.shown);
    }
}

// A slot's reach from the origin is rounded up: a proof within rounding could be missed, but no trial comes so near.
void expectSeparationOfItsBins(const FamilyCase& c, Seen& seen) {
    const FamilyVerdict verdict = verdictOf(c.family, c.planes, c.undecided);
    for (std::size_t i = 0; i < c.slots.size(); ++i) {
        if (c.slots[i].kind != SlotKind::Exact || has(verdict.outside, i)) continue;
        ASSERT_TRUE(has(c.family.exact(), i));
        const bool expected = isSeparated(c.slots[i].exact, c.planes, c.planes.size(), verdict.undecided[i]);
        ASSERT_EQ(c.family.isSeparated(i, c.planes, verdict.undecided[i]), expected);
        seen.separated += expected ? 1 : 0;
    }
}

TEST(BinFamily, GivesTheVerdictsOfItsBins) {
    constexpr int trials = 40000;
    Random random(130);
    Seen seen;
    for (int trial = 0; trial < trials; ++trial) {
        const FamilyCase c(random);
        expectVerdictsOfItsBins(c, seen);
        if (!testing::Test::HasFatalFailure()) expectHorizonOfItsBins(c, seen);
        if (!testing::Test::HasFatalFailure()) expectSeparationOfItsBins(c, seen);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << "trial " << trial << ", " << c.slots.size() << " slots, " << c.planes.size() << " planes";
            break;
        }
    }
    for (const int count : seen.sides) EXPECT_GT(count, trials / 20);
    EXPECT_GT(seen.hidden, trials / 20);
    EXPECT_GT(seen.shown, trials / 20);
    EXPECT_GT(seen.separated, trials / 100);
}

#ifdef OSGANALYTICBIN_SIMD

// As single bins do: PlaneKernels.EveryTargetAgreesWithTheScalarForm.
TEST(BinFamily, EveryTargetAgreesWithTheScalarForm) {
    std::vector<std::pair<const char*, core::kernels::PlaneKernels>> targets;
    forEachTarget([&](const char* name) { targets.emplace_back(name, core::kernels::activeKernels); });
    Random random(132);
    for (int trial = 0; trial < 20000; ++trial) {
        const FamilyCase c(random);
        FamilyVerdict expected{};
        const auto hiddenBy = [&](const core::kernels::PlaneKernels& kernels, FamilyVerdict& result) {
            core::kernels::activeKernels = kernels;
            c.family.classify(c.planes, c.undecided, result);
            return c.eye ? c.family.hiddenFrom(*c.eye, c.candidates) : 0;
        };
        const std::uint64_t hidden = hiddenBy(core::kernels::kScalarKernels, expected);
        for (const auto& [target, kernels] : targets) {
            FamilyVerdict verdict{};
            ASSERT_EQ(hiddenBy(kernels, verdict), hidden) << target;
            ASSERT_EQ(verdict.outside, expected.outside) << target;
            ASSERT_EQ(verdict.insideAll, expected.insideAll) << target;
            for (std::size_t i = 0; i < c.slots.size(); ++i)
                ASSERT_EQ(verdict.undecided[i], expected.undecided[i]) << target;
        }
    }
    core::kernels::chooseKernels();
}

#endif

TEST(BinFamily, MayHaveNoSlot) {
    EXPECT_EQ(verdictOf(BinFamily(0), PlaneSet(), 0).outside, 0u);
    EXPECT_EQ(verdictOf(BinFamily(0), PlaneSet(), 0).insideAll, 0u);
}

}  // namespace
}  // namespace osgAnalyticBin::test
