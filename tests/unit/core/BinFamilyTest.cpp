// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: classify() of a bin by itself (tested in PlaneSetTest) and HorizonEye::hides() (HorizonTest), bit for bit.

#include "CoreTest.h"
#include "FamilySamples.h"

#ifdef OSGANALYTICBIN_SIMD
#include <hwy/highway.h>
#endif

namespace osgAnalyticBin::test {
namespace {

using core::BinFamily;
using core::FamilyVerdict;

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

void expectVerdictsOfItsBins(const FamilyCase& c, Seen& seen) {
    FamilyVerdict verdict{};
    c.family.classify(c.planes, c.undecided, verdict);
    for (std::size_t i = 0; i < c.slots.size(); ++i) {
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

// A slot's reach from the origin is rounded up: a proof that is within rounding could be missed, but no trial comes so
// near.
void expectSeparationOfItsBins(const FamilyCase& c, Seen& seen) {
    FamilyVerdict verdict{};
    c.family.classify(c.planes, c.undecided, verdict);
    for (std::size_t i = 0; i < c.slots.size(); ++i) {
        if (c.slots[i].kind != SlotKind::Exact || has(verdict.outside, i)) continue;
        ASSERT_TRUE(has(c.family.exact(), i));
        const bool expected = isSeparated(c.slots[i].exact, c.planes, c.planes.size(), verdict.undecided[i]);
        ASSERT_EQ(c.family.isSeparated(i, c.planes, verdict.undecided[i]), expected);
        seen.separated += expected ? 1 : 0;
    }
}

Seen expectAllVerdictsOfItsBins(std::uint64_t stream, int trials) {
    Random random(stream);
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
    return seen;
}

TEST(BinFamily, GivesTheVerdictsOfItsBins) {
    expectAllVerdictsOfItsBins(130, 40000);
}

#ifdef OSGANALYTICBIN_SIMD

// As single bins do: PlaneKernels.EveryTargetAgreesWithTheScalarForm.
TEST(BinFamily, EveryTargetAgreesWithTheScalarForm) {
    std::vector<std::pair<std::int64_t, core::kernels::PlaneKernels>> targets;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        core::kernels::chooseKernels();
        targets.emplace_back(target, core::kernels::activeKernels);
    }
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
            ASSERT_EQ(hiddenBy(kernels, verdict), hidden) << hwy::TargetName(target);
            ASSERT_EQ(verdict.outside, expected.outside) << hwy::TargetName(target);
            ASSERT_EQ(verdict.insideAll, expected.insideAll) << hwy::TargetName(target);
            for (std::size_t i = 0; i < c.slots.size(); ++i)
                ASSERT_EQ(verdict.undecided[i], expected.undecided[i]) << hwy::TargetName(target);
        }
    }
    hwy::SetSupportedTargetsForTest(0);
    core::kernels::chooseKernels();
}

#endif

TEST(BinFamily, SlotsWithoutABinAreNeverDecided) {
    const GeodeticBin box = GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0});
    BinFamily family(5);
    family.set(1, ExactGeodeticBin(wgs84(), box));
    family.setHorizon(1, HorizonBin(wgs84(), box));
    family.setHorizon(2, HorizonBin(wgs84(), box));
    const auto eye = HorizonEye::fromEye(wgs84(), 0.0, {-1e8, 0.0, 0.0});
    ASSERT_TRUE(eye);
    EXPECT_EQ(family.filled(), 0b10u);
    EXPECT_EQ(family.hiddenFrom(*eye, ~std::uint64_t{0}), 0b10u);
    for (const double offset : {-1e9, 1e9, kNaN}) {
        PlaneSet planes;
        planes.push_back({{1.0, 0.0, 0.0}, offset});
        FamilyVerdict verdict{};
        family.classify(planes, planes.all(), verdict);
        EXPECT_EQ(verdict.outside, offset < 0.0 ? 0b10u : 0u);
        EXPECT_EQ(verdict.insideAll, offset > 0.0 ? 0b10u : 0u);
        for (const std::size_t i : {0u, 2u, 3u, 4u}) EXPECT_EQ(verdict.undecided[i], planes.all());
    }
    family.clear(1);
    PlaneSet planes;
    planes.push_back({{1.0, 0.0, 0.0}, -1e9});
    FamilyVerdict verdict{};
    family.classify(planes, planes.all(), verdict);
    EXPECT_EQ(family.filled(), 0u);
    EXPECT_EQ(verdict.outside, 0u);
    EXPECT_EQ(verdict.undecided[1], planes.all());
    EXPECT_EQ(family.hiddenFrom(*eye, ~std::uint64_t{0}), 0u);
}

TEST(BinFamily, ABinThatIsSetAgainIsTheNewOne) {
    const GeodeticBin wide = GeodeticBin::fromDegrees({0.0, 40.0}, {0.0, 40.0}, {0.0, 1000.0});
    const GeodeticBin small = GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0});
    BinFamily family(1);
    family.set(0, core::ExactGeodeticBin(wgs84(), wide));
    family.set(0, core::QuadraticBin(core::GeodeticMapping(wgs84()), core::parameterBox(small)));
    PlaneSet planes;
    planes.push_back({{1.0, 0.0, 0.0}, -6.3e6});  // only the small one is wholly beyond
    FamilyVerdict verdict{};
    family.classify(planes, planes.all(), verdict);
    EXPECT_EQ(verdict.insideAll, 1u);
    family.set(0, core::ExactGeodeticBin(wgs84(), wide));
    family.classify(planes, planes.all(), verdict);
    EXPECT_EQ(verdict.insideAll, 0u);
}

TEST(BinFamily, CopiesHaveNumbersOfTheirOwn) {
    const GeodeticBin box = GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0});
    PlaneSet planes;
    planes.push_back({{1.0, 0.0, 0.0}, -1e9});
    const auto outside = [&](const BinFamily& family) {
        FamilyVerdict verdict{};
        family.classify(planes, planes.all(), verdict);
        return verdict.outside;
    };
    BinFamily family(2);
    family.set(1, ExactGeodeticBin(wgs84(), box));
    BinFamily copy(family);
    BinFamily assigned(1);
    assigned = family;
    family.clear(1);
    EXPECT_EQ(outside(family), 0u);
    EXPECT_EQ(outside(copy), 0b10u);
    EXPECT_EQ(outside(assigned), 0b10u);
    copy.clear(1);
    assigned.set(0, ExactGeodeticBin(wgs84(), box));
    EXPECT_EQ(outside(copy), 0u);
    EXPECT_EQ(outside(assigned), 0b11u);
    const BinFamily moved(std::move(assigned));
    EXPECT_EQ(outside(moved), 0b11u);
}

TEST(BinFamily, MayHaveNoSlotAndNoPlane) {
    const BinFamily none(0);
    FamilyVerdict verdict{};
    PlaneSet planes;
    none.classify(planes, 0, verdict);
    EXPECT_EQ(verdict.outside | verdict.insideAll, 0u);
    BinFamily one(1);
    one.set(0, ExactGeodeticBin(wgs84(), GeodeticBin::fromDegrees({0.0, 1.0}, {0.0, 1.0}, {0.0, 1000.0})));
    one.classify(planes, 0, verdict);
    EXPECT_EQ(verdict.insideAll, 1u);
    one.classify(planes, 0b10, verdict);
    EXPECT_EQ(verdict.insideAll, 0u);
    EXPECT_EQ(verdict.undecided[0], 0b10u);
}

}  // namespace
}  // namespace osgAnalyticBin::test
