// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The plane's sign convention and the mask semantics of classify(); what the bins themselves answer is tested with
// them.

#include <osgAnalyticBin/core/Plane.h>

#include <gtest/gtest.h>

#include <array>
#include <support/Random.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::classify;
using core::kMaxPlanes;
using core::Plane;
using core::PlaneMask;
using core::Side;

// Answers by the plane's offset, and counts the questions.
struct ScriptedBin {
    mutable int asked = 0;

    [[nodiscard]] Side classify(const Plane& plane) const noexcept {
        ++asked;
        if (plane.offset < 0.0) return Side::Outside;
        return plane.offset > 0.0 ? Side::Inside : Side::Straddling;
    }
};

Plane answering(Side side) {
    const double offset = side == Side::Outside ? -1.0 : (side == Side::Inside ? 1.0 : 0.0);
    return {{0.0, 0.0, 1.0}, offset};
}

TEST(Plane, NormalPointsIntoTheFrustum) {
    const Plane plane{{1.0, 0.0, 0.0}, -2.0};
    EXPECT_EQ(plane.distance({5.0, 7.0, 9.0}), 3.0);
    EXPECT_EQ(plane.distance({1.0, 7.0, 9.0}), -1.0);
    EXPECT_EQ(plane.flipped().distance({5.0, 7.0, 9.0}), -3.0);
}

TEST(Classify, OutsideOfOnePlaneIsOutside) {
    const ScriptedBin bin;
    const std::vector<Plane> planes{answering(Side::Inside), answering(Side::Outside), answering(Side::Straddling)};
    PlaneMask undecided = 0b111;
    EXPECT_EQ(classify(bin, planes, planes.size(), undecided), Side::Outside);
    EXPECT_EQ(bin.asked, 2) << "the first proof ends the test";
    EXPECT_EQ(undecided, PlaneMask{0b110}) << "planes passed before keep their verdict";
}

TEST(Classify, DecidedPlanesAreNotAsked) {
    const ScriptedBin bin;
    const Plane planes[] = {answering(Side::Outside), answering(Side::Straddling)};
    PlaneMask undecided = 0b10;
    EXPECT_EQ(classify(bin, planes, 2, undecided), Side::Straddling);
    EXPECT_EQ(bin.asked, 1);
    undecided = 0;
    EXPECT_EQ(classify(bin, planes, 2, undecided), Side::Inside);
    EXPECT_EQ(bin.asked, 1);
}

TEST(Classify, NoPlanesIsInsideAndStrayBitsStayUndecided) {
    const ScriptedBin bin;
    PlaneMask undecided = 0;
    EXPECT_EQ(classify(bin, std::vector<Plane>{}, 0, undecided), Side::Inside);
    undecided = 0b100;
    EXPECT_EQ(classify(bin, std::vector<Plane>{}, 0, undecided), Side::Straddling);
    EXPECT_EQ(undecided, PlaneMask{0b100});
}

TEST(Classify, NothingIsInsideOfMorePlanesThanTheMaskNames) {
    const ScriptedBin bin;
    std::vector<Plane> planes(kMaxPlanes, answering(Side::Inside));
    PlaneMask undecided = ~PlaneMask{0};
    EXPECT_EQ(classify(bin, planes, planes.size(), undecided), Side::Inside);
    planes.push_back(answering(Side::Outside));
    undecided = ~PlaneMask{0};
    EXPECT_EQ(classify(bin, planes, planes.size(), undecided), Side::Straddling);
    planes.front() = answering(Side::Outside);
    undecided = ~PlaneMask{0};
    EXPECT_EQ(classify(bin, planes, planes.size(), undecided), Side::Outside);
}

TEST(Classify, AgreesWithThePlanesOneByOne) {
    Random random(20);
    constexpr std::array<Side, 3> kSides{Side::Outside, Side::Straddling, Side::Inside};
    for (int trial = 0; trial < 10000; ++trial) {
        std::vector<Plane> planes;
        const int count = random.integer(0, 8);
        for (int i = 0; i < count; ++i) planes.push_back(answering(random.pick(kSides)));
        const auto before = static_cast<PlaneMask>(random.integer(0, 255)) & ((PlaneMask{1} << count) - 1u);
        bool outside = false;
        bool straddling = false;
        for (int i = 0; i < count; ++i) {
            if (!(before >> i & 1u)) continue;
            outside = outside || planes[static_cast<std::size_t>(i)].offset < 0.0;
            straddling = straddling || planes[static_cast<std::size_t>(i)].offset == 0.0;
        }
        PlaneMask undecided = before;
        const Side expected = outside ? Side::Outside : (straddling ? Side::Straddling : Side::Inside);
        ASSERT_EQ(classify(ScriptedBin{}, planes, planes.size(), undecided), expected);
        ASSERT_EQ(undecided & ~before, 0u) << "no bit is ever set";
        if (!outside) {
            for (int i = 0; i < count; ++i) {
                const bool undecidedNow = undecided >> i & 1u;
                ASSERT_EQ(undecidedNow, (before >> i & 1u) != 0 && planes[static_cast<std::size_t>(i)].offset == 0.0);
            }
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
