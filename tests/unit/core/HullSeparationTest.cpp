// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The search for a parting plane. Oracle: libccd says which hulls meet. Planets and Soundness.cpp (ten million
// trials) test bins with a point that is known to be inside the frustum.

#include "CoreTest.h"

namespace osgAnalyticBin::test {
namespace {

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
