// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracles: the tests of one bin against one plane (tested in ExactGeodeticBinTest and QuadraticBinTest), and the scalar
// kernels bit for bit. And the plane's sign convention. The search for a parting plane: libccd says which hulls meet.
// Planets and Soundness.cpp (ten million trials) test bins with a point that is known to be inside the frustum.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

using core::kernels::PlaneSides;

// A bin and some planes about it.
struct PlaneSetCase {
    explicit PlaneSetCase(Random& random)
        : oracle(randomEllipsoid(random), randomBin(random)),
          exact(oracle.ellipsoid(), oracle.bin()),
          quadratic(core::GeodeticMapping(oracle.ellipsoid()), core::parameterBox(oracle.bin())),
          either(core::quadraticOrExact(oracle.ellipsoid(), oracle.bin())) {
        addRandomPlanes(random, {oracle}, planes);
        undecided = random.chance(0.5) ? planes.all() : static_cast<PlaneMask>(random.bits());
    }

    BinOracle oracle;
    ExactGeodeticBin exact;
    QuadraticBin quadratic;
    core::QuadraticOrExact either;
    PlaneSet planes;
    PlaneMask undecided = 0;
};

// By the set, and by the same planes in a list.
template <class Bin>
void expectVerdictsOfSinglePlanes(const Bin& bin, const PlaneSet& planes, PlaneMask undecided) {
    PlaneMask open = undecided;  // planes that are not there stay undecided
    bool isOutside = false;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const PlaneMask bit = PlaneMask{1} << i;
        const Side side = undecided & bit ? bin.classify(planes[i]) : Side::Inside;
        isOutside = isOutside || side == Side::Outside;
        if (side == Side::Inside) open &= ~bit;
    }
    const Side expected = isOutside ? Side::Outside : open != 0 ? Side::Straddling : Side::Inside;
    PlaneMask left = undecided, leftOfList = undecided;
    ASSERT_EQ(core::classify(bin, planes, left), expected);
    ASSERT_EQ((core::classify<Bin, PlaneSet>(bin, planes, planes.size(), leftOfList)), expected);
    for (const PlaneMask found : {left, leftOfList}) {
        ASSERT_TRUE(isOutside || found == open);
        ASSERT_EQ(found & ~undecided, 0u) << "no bit is ever set";
        // what is cleared is inside, whatever the result
        ASSERT_EQ(undecided & ~found & open, 0u);
    }
}

TEST(PlaneSet, GivesTheVerdictsOfSinglePlanes) {
    Random random(120);
    std::array<int, 3> verdicts{};
    for (int trial = 0; trial < 100000; ++trial) {
        const PlaneSetCase c(random);
        expectVerdictsOfSinglePlanes(c.exact, c.planes, c.undecided);
        expectVerdictsOfSinglePlanes(c.quadratic, c.planes, c.undecided);
        std::visit([&](const auto& form) { expectVerdictsOfSinglePlanes(form, c.planes, c.undecided); }, c.either);
        PlaneMask left = c.undecided;
        ++verdicts[static_cast<std::size_t>(core::classify(c.exact, c.planes, left))];
    }
    for (const int count : verdicts) EXPECT_GT(count, 1000);
}

TEST(PlaneSet, ReturnsItsPlanes) {
    Random random(121);
    PlaneSet set;
    std::vector<Plane> planes;
    EXPECT_EQ(set.all(), 0u);
    while (planes.size() < core::kMaxPlanes) {
        planes.push_back({random.direction(), random.uniform(-1e7, 1e7)});
        set.push_back(planes.back());
        EXPECT_EQ(set.size(), planes.size());
        for (std::size_t i = 0; i < planes.size(); ++i) {
            EXPECT_EQ(set[i].normal, planes[i].normal);
            EXPECT_EQ(set[i].offset, planes[i].offset);
        }
    }
    EXPECT_EQ(set.all(), ~PlaneMask{0});
}

// Debug builds stop at such planes; others must not cull by them.
template <class Bin>
void expectUndecided(const Bin& bin, const Plane& plane) {
    EXPECT_DEBUG_DEATH(EXPECT_EQ(bin.classify(plane), Side::Straddling), "hasUnitNormal");
    EXPECT_DEBUG_DEATH(EXPECT_EQ(bin.classify({-plane.normal, -plane.offset}), Side::Straddling), "hasUnitNormal");
}

template <class Bin>
void expectUndecidedInASet(const Bin& bin, const Plane& plane) {
    expectUndecided(bin, plane);
    const auto classifyInASet = [&] {
        const PlaneSet planes = setOf({plane});
        PlaneMask undecided = planes.all();
        EXPECT_EQ(core::classify(bin, planes, undecided), Side::Straddling);
        EXPECT_EQ(undecided, planes.all());
    };
    EXPECT_DEBUG_DEATH(classifyInASet(), "hasUnitNormal");
}

TEST(PlaneSet, PlanesWithoutAUnitNormalDecideNothing) {
    const GeodeticMapping mapping(wgs84());
    const ExactGeodeticBin exact(wgs84(), kOneDegree),
        wide(wgs84(), GeodeticBin::fromDegrees({0.0, 40.0}, {0.0, 40.0}, {0.0, 1000.0}));
    for (const double factor : {0.0, 1e-3, 1.0 - 1e-8, 1.0 + 1e-8, 2.0, 1e6}) {
        for (const double offset : {-1e13, 1e13}) {
            const Plane plane{factor * glm::dvec3(0.6, 0.0, 0.8), offset};
            expectUndecidedInASet(exact, plane);
            expectUndecidedInASet(QuadraticBin(mapping, core::parameterBox(kOneDegree)), plane);
            expectUndecidedInASet(wide, plane);
        }
    }
    // to the tolerance they do
    for (const double factor : {1.0 - 0.99e-9, 1.0 + 0.99e-9})
        EXPECT_EQ(exact.classify({factor * glm::dvec3(0.6, 0.0, 0.8), -1e8}), Side::Outside);
}

TEST(PlaneSet, NothingIsInsideOfMorePlanesThanItHolds) {
    const ExactGeodeticBin bin(wgs84(), kOneDegree);
    const Plane around{{1.0, 0.0, 0.0}, 1e9}, away{{1.0, 0.0, 0.0}, -1e9};
    PlaneSet full;
    for (std::size_t i = 0; i < core::kMaxPlanes; ++i) full.push_back(around);
    PlaneMask undecided = full.all();
    EXPECT_EQ(core::classify(bin, full, undecided), Side::Inside);
    // than the mask names, in a list
    std::vector<Plane> list(core::kMaxPlanes + 1, around);
    EXPECT_EQ(core::classify(bin, list, list.size(), undecided = full.all()), Side::Straddling);
    list.front() = away;
    EXPECT_EQ(core::classify(bin, list, list.size(), undecided = full.all()), Side::Outside);
    const auto overflow = [&](const Plane& first) {
        PlaneSet planes = setOf({first});
        while (planes.size() < core::kMaxPlanes) planes.push_back(around);
        for (int i = 0; i < 3; ++i) planes.push_back(around);
        EXPECT_EQ(planes.size(), core::kMaxPlanes);
        PlaneMask left = planes.all();
        EXPECT_EQ(core::classify(bin, planes, left), first.offset < 0.0 ? Side::Outside : Side::Straddling);
        EXPECT_NE(left, PlaneMask{0}) << "what is below the bin is not inside either";
    };
    EXPECT_DEBUG_DEATH(overflow(around), "kMaxPlanes");
    EXPECT_DEBUG_DEATH(overflow(away), "kMaxPlanes");
}

// Objects of applications may ask before the vectors are chosen.
const bool kHasKernelsAtStart =
    core::kernels::activeKernels.bin != nullptr && core::kernels::activeOcclusion.walls != nullptr;

TEST(PlaneKernels, AreThereBeforeAllElse) {
    EXPECT_TRUE(kHasKernelsAtStart);
}

#ifdef OSGANALYTICBIN_SIMD

TEST(PlaneKernels, EveryTargetAgreesWithTheScalarForm) {
    std::vector<std::pair<const char*, core::kernels::PlaneKernels>> targets;
    forEachTarget([&](const char* name) { targets.emplace_back(name, core::kernels::activeKernels); });
    Random random(122);
    for (int trial = 0; trial < 200000 && !HasFatalFailure(); ++trial) {
        const PlaneSetCase c(random);
        const PlaneMask mask = c.undecided & c.planes.all();
        const auto expectTheSame = [&](const double* numbers, bool isExact) {
            const PlaneSides scalar = core::kernels::kScalarKernels.bin(numbers, isExact, c.planes.blocks(), mask);
            for (const auto& [target, kernels] : targets) {
                const PlaneSides sides = kernels.bin(numbers, isExact, c.planes.blocks(), mask);
                ASSERT_EQ(sides.both, scalar.both) << target << ", trial " << trial;
            }
        };
        expectTheSame(c.exact.numbers().data(), true);
        expectTheSame(c.quadratic.numbers().data(), false);
    }
    EXPECT_FALSE(targets.empty());
}

#endif

TEST(Plane, NormalPointsIntoTheFrustum) {
    const Plane plane{{1.0, 0.0, 0.0}, -2.0};
    EXPECT_EQ(plane.distance({5.0, 7.0, 9.0}), 3.0);
    EXPECT_EQ(plane.distance({1.0, 7.0, 9.0}), -1.0);
}

constexpr std::size_t kMostPlanes = 6;

PlaneMask allOf(const std::vector<Plane>& planes) {
    return (PlaneMask{1} << planes.size()) - 1;
}

// Two planes that nearly face each other and meet in a point of the bin, above all others: only what a mixture of the
// two is moved inward by keeps its rounding, which their difference enlarges, from parting them.
TEST(HullSeparation, NeverPartsABinFromAPointWhereTwoPlanesNearlyCancel) {
    Random random(327);
    for (int trial = 0; trial < 200000; ++trial) {
        const Ellipsoid ellipsoid = randomEllipsoid(random);
        const GeodeticBin bin = randomTile(random, random.integer(4, kDeepestLevel), randomAltitude(random));
        core::Geodetic position = randomPosition(random, bin);
        position.altitude = bin.altitude().upper;
        const RealVector point = geodeticToEcef(ellipsoid, position);
        const glm::dvec3 up = glm::normalize(glm::dvec3(std::cos(position.latitude) * std::cos(position.longitude),
                                                        std::cos(position.latitude) * std::sin(position.longitude),
                                                        std::sin(position.latitude)));
        const glm::dvec3 along = glm::normalize(glm::cross(up, random.direction()));
        const double slope = random.logUniform(1e-9, 1e-1);
        std::vector<Plane> planes(2);
        planes[0].normal = glm::normalize(slope * random.uniform() * up + along);
        planes[1].normal = glm::normalize(slope * random.uniform() * up - along);
        for (Plane& plane : planes) {
            plane.offset = -glm::dot(plane.normal, rounded(point));
            while (exactDistance(plane, point) < 0) plane.offset += 1e-16 * ellipsoid.equatorialRadius();
        }
        ASSERT_FALSE(isSeparated(ExactGeodeticBin(ellipsoid, bin), planes, 2, 3u)) << "trial " << trial;
    }
}

// Of bins that straddle two planes, whose hull libccd finds apart from the frustum.
TEST(HullSeparation, FindsNearlyAllPartedHulls) {
    constexpr double kBar = 99.0;
    Random random(324);
    int apart = 0, found = 0, contradictions = 0;
    for (int trial = 0; trial < 200000; ++trial) {
        const GeodeticBin bin = randomTile(random, random.integer(0, 8), kTerrainAltitudes);
        const View view = randomView(random, wgs84(), bin, randomPointWithin(random, wgs84(), bin, 0.0));
        const auto planes = view.planes();
        const ExactGeodeticBin exact(wgs84(), bin);
        PlaneMask undecided = allOf(planes);
        if (core::classify(exact, planes, planes.size(), undecided) != Side::Straddling) continue;
        if (std::bitset<32>(undecided).count() != 2) continue;
        const bool meet = hullsMeet(wgs84(), bin, view);
        const bool separated = isSeparated(exact, planes, planes.size(), undecided);
        contradictions += meet && separated ? 1 : 0;
        apart += meet ? 0 : 1;
        found += separated && !meet ? 1 : 0;
    }
    EXPECT_GT(apart, 200);
    EXPECT_GE(100.0 * found / apart, kBar) << found << " of " << apart;
    // libccd errs by its own tolerance when hulls nearly touch; what is proved is tested above.
    EXPECT_LE(contradictions, 1);
}

TEST(HullSeparation, NeedsTwoPlanesAndNumbers) {
    const ExactGeodeticBin exact(wgs84(), kOneDegree);
    const Plane away{{1.0, 0.0, 0.0}, -1e8};
    const std::vector<Plane> planes{away, away, {{kNaN, 0.0, 0.0}, 0.0}, {{0.0, 1.0, 0.0}, kNaN}};
    EXPECT_FALSE(isSeparated(exact, planes, 4, 0u));
    EXPECT_FALSE(isSeparated(exact, planes, 4, 1u)) << "classify tells that by itself";
    EXPECT_TRUE(isSeparated(exact, planes, 4, 3u));
    EXPECT_FALSE(isSeparated(exact, planes, 4, 4u + 8u));
    EXPECT_FALSE(isSeparated(exact, planes, 4, 7u)) << "more planes than asked for";
    EXPECT_TRUE(isSeparated(exact, planes, 4, 7u, 3)) << "by the first pair";
    // two planes that face each other: their mixture has no direction
    const std::vector<Plane> slab{{{1.0, 0.0, 0.0}, -6.377e6}, {{-1.0, 0.0, 0.0}, 6.377e6}};
    EXPECT_FALSE(isSeparated(exact, slab, 2, 3u));
}

TEST(HullSeparation, NeedsUnitNormals) {
    const ExactGeodeticBin exact(wgs84(), kOneDegree);
    View view;
    view.eye = {6.4e6, 0.0, 0.0};
    view.halfWidth = 3.0;
    Random random(326);
    view.lookAlong({1.0, 0.0, 0.0}, random);
    std::vector<Plane> planes = view.planes();
    ASSERT_TRUE(isSeparated(exact, planes, 4, allOf(planes), kMostPlanes));
    for (Plane& plane : planes) plane.normal *= 1.0 + 1e-6;
    EXPECT_DEBUG_DEATH(EXPECT_FALSE(isSeparated(exact, planes, 4, allOf(planes), kMostPlanes)), "hasUnitNormal");
}

}  // namespace
}  // namespace osgAnalyticBin::test
