// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The plane's sign convention and the mask semantics of classify(); what the bins themselves answer is tested with
// them.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::classify;
using core::kMaxPlanes;

// Answers by the plane's offset.
struct ScriptedBin {
    [[nodiscard]] Side classify(const Plane& plane) const noexcept {
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
        // planes that are not there stay undecided
        const auto before = static_cast<PlaneMask>(random.integer(0, 255));
        bool outside = false;
        bool straddling = before >> count != 0;
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
            for (int i = 0; i < 8; ++i) {
                const bool undecidedNow = undecided >> i & 1u;
                const bool isOpen = i >= count || planes[static_cast<std::size_t>(i)].offset == 0.0;
                ASSERT_EQ(undecidedNow, (before >> i & 1u) != 0 && isOpen);
            }
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
