// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Boxes about bins, the two published rules and the horizon point of other programs. Oracles: the bin's exact range by
// long double; the rules written down a second time; the point itself, found from samples of the bin, whose own line of
// sight is tested in long double. Millions of planes, frusta and eyes: Soundness.cpp.

#include "FrustumHull.h"
#include "RivalBins.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <support/View.h>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::GeodeticBin;
using core::GeodeticMapping;
using core::HorizonBin;
using core::HorizonEye;
using core::Interval;
using core::ParameterBox;
using core::Plane;
using core::Quadratic;
using core::QuadraticBin;
using core::Side;
using hull::FrustumHull;
using rivals::BoxBin;
using rivals::CornersBin;
using rivals::HorizonPoint;
using rivals::OrientedBoxBin;
using rivals::PaperBin;

// Documented above BoxBin.
constexpr double kBoxTightness = 160.0 * std::numeric_limits<double>::epsilon();

template <class Box>
class BoxBins : public testing::Test {};
using Boxes = testing::Types<BoxBin, OrientedBoxBin>;
TYPED_TEST_SUITE(BoxBins, Boxes);

double farthest(const BinOracle& oracle) {
    const core::Interval& altitude = oracle.bin().altitude();
    return std::max(oracle.ellipsoid().equatorialRadius(), oracle.ellipsoid().polarRadius()) +
           std::max(std::abs(altitude.lower), std::abs(altitude.upper));
}

TYPED_TEST(BoxBins, TouchTheBinOnAllSides) {
    Random random(402);
    for (int trial = 0; trial < 20000; ++trial) {
        const BinOracle oracle(randomEllipsoid(random), randomBin(random));
        const TypeParam box(oracle.ellipsoid(), oracle.bin());
        for (std::size_t i = 0; i < TypeParam::faceCount(); ++i) {
            const Real gap = oracle.distanceRange(box.face(i)).lower;
            ASSERT_GE(gap, 0) << "trial " << trial << " face " << i;
            ASSERT_LE(gap, kBoxTightness * farthest(oracle)) << "trial " << trial << " face " << i;
        }
    }
}

TYPED_TEST(BoxBins, ReverseTestFindsAFrustumBeyondAFace) {
    Random random(406);
    int found = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const GeodeticBin bin = randomTile(random, random.integer(0, 8), {0.0, 1000.0});
        const TypeParam box(wgs84(), bin);
        // A slab of the frustum that just does not reach the face: none of its own planes has the box outside.
        const Plane face = box.face(static_cast<std::size_t>(random.integer(0, 5)));
        View view;
        view.eye = rounded(geodeticToEcef(wgs84(), randomPosition(random, bin))) - 1e7 * face.normal;
        view.lookAlong(face.normal, random);
        view.halfWidth = 3.0;
        view.nearDistance = 1.0;
        view.farDistance = -face.distance(view.eye) - 1.0;
        std::vector<Plane> planes = view.planes();
        planes.pop_back();  // without the far plane the frustum goes through the box
        EXPECT_FALSE(isSeparated(box, FrustumHull(planes, planes.size())));
        planes = view.planes();
        found += isSeparated(box, FrustumHull(planes, planes.size())) ? 1 : 0;
    }
    EXPECT_EQ(found, 1000);
}

constexpr double kTie = 1e-6;  // metres from a plane within which a verdict may go either way

Side sideOf(const Interval& range) {
    if (range.upper < 0.0) return Side::Outside;
    return range.lower >= 0.0 ? Side::Inside : Side::Straddling;
}

// The nine-point rule, its linear system solved by Cramer's rule in long double.
Interval ninePointRange(const Quadratic& q) {
    Interval range{q(1.0, 1.0, 1.0), q(1.0, 1.0, 1.0)};
    const auto take = [&](double u, double v, double w) {
        range = {std::min(range.lower, q(u, v, w)), std::max(range.upper, q(u, v, w))};
    };
    for (int corner = 0; corner < 8; ++corner)
        take(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const auto& h = q.hessian;
    const RealVector columns[] = {{h[0], h[3], h[4]}, {h[3], h[1], h[5]}, {h[4], h[5], h[2]}};
    const RealVector right = Real{-1} * RealVector{q.gradient[0], q.gradient[1], q.gradient[2]};
    const Real determinant = dot(columns[0], cross(columns[1], columns[2]));
    if (determinant == 0) return range;
    const double u = static_cast<double>(dot(right, cross(columns[1], columns[2])) / determinant);
    const double v = static_cast<double>(dot(columns[0], cross(right, columns[2])) / determinant);
    const double w = static_cast<double>(dot(columns[0], cross(columns[1], right)) / determinant);
    if (std::abs(u) <= 1.0 && std::abs(v) <= 1.0 && std::abs(w) <= 1.0) take(u, v, w);
    return range;
}

Interval ninePointRange(const ParameterBox& box, double growth, const Plane& plane) {
    return ninePointRange(
        QuadraticBin(GeodeticMapping(wgs84()), {box.center, box.halfSize * growth}).distanceModel(plane));
}

Interval cornerRange(const core::GeodeticBin& bin, const Plane& plane) {
    Interval range{1e300, -1e300};
    const auto end = [](const Interval& of, int bit) { return bit ? of.upper : of.lower; };
    for (int corner = 0; corner < 8; ++corner) {
        const RealVector point = geodeticToEcef(wgs84(), end(bin.latitude(), corner & 1),
                                                end(bin.longitude(), corner & 2), end(bin.altitude(), corner & 4));
        const auto distance = static_cast<double>(exactDistance(plane, point));
        range = {std::min(range.lower, distance), std::max(range.upper, distance)};
    }
    return range;
}

// The bin's verdicts on random tiles and planes are those of ranges that are computed once more, but for ties.
template <class Check>
void forRandomPlanes(std::uint64_t stream, const Check& check) {
    Random random(stream);
    int decided = 0;
    for (int trial = 0; trial < 50000 && !testing::Test::HasFailure(); ++trial) {
        const BinOracle oracle(wgs84(), randomTile(random, random.integer(0, 8), randomAltitude(random)));
        const Plane plane = randomPlane(random, oracle, random.pick(kPlaneKinds));
        const auto [range, side] = check(random, oracle.bin(), plane);
        if (std::min(std::abs(range.lower), std::abs(range.upper)) < kTie) continue;
        ++decided;
        EXPECT_EQ(side, sideOf(range));
    }
    EXPECT_GT(decided, 40000);
}

TEST(PaperBin, IsTheNinePointRuleOnTheGrownBox) {
    forRandomPlanes(80, [](Random& random, const core::GeodeticBin& bin, const Plane& plane) {
        const ParameterBox box = core::parameterBox(bin);
        const double growth = random.chance(0.5) ? PaperBin::kDefaultGrowth : random.uniform(1.0, 1.5);
        return std::pair(ninePointRange(box, growth, plane),
                         PaperBin(GeodeticMapping(wgs84()), box, growth).classify(plane));
    });
    EXPECT_EQ(PaperBin::kDefaultGrowth, 1.1);
}

TEST(CornersBin, IsTheRuleOfTheEightCorners) {
    forRandomPlanes(81, [](Random&, const core::GeodeticBin& bin, const Plane& plane) {
        return std::pair(cornerRange(bin, plane),
                         CornersBin(GeodeticMapping(wgs84()), core::parameterBox(bin)).classify(plane));
    });
}

constexpr double kPointDepth = 11000.0;

HorizonPoint pointOf(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin = 0.0) {
    return HorizonPoint(HorizonBin(ellipsoid, bin, margin));
}

// The point as [R13] has it, from samples in the space where the occluder is the unit ball: along the middle, as high
// as the sample needs that needs most.
std::optional<RealVector> sampledPoint(const GeodeticBin& bin, Real scale) {
    const Real a = wgs84().equatorialRadius();
    const Real b = wgs84().polarRadius();
    const auto inBall = [&](Real latitude, Real longitude) {
        const RealVector p = geodeticToEcef(wgs84(), latitude, longitude, bin.altitude().upper);
        return RealVector{p.x / a / scale, p.y / a / scale, p.z / b / scale};
    };
    const RealVector middle = inBall(bin.center().latitude, bin.center().longitude);
    const RealVector direction = (1 / length(middle)) * middle;
    constexpr int kSteps = 8;
    Real height = 0;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
            const RealVector p = inBall(bin.latitude().lower + bin.latitude().width() * i / kSteps,
                                        bin.longitude().lower + bin.longitude().width() * j / kSteps);
            const Real angle = std::acos(std::min<Real>(1, dot(p, direction) / length(p))) + std::acos(1 / length(p));
            if (!(angle < static_cast<Real>(kHalfPi))) return std::nullopt;
            height = std::max(height, 1 / std::cos(angle));
        }
    }
    const RealVector q = height * direction;
    return RealVector{q.x * a * scale, q.y * a * scale, q.z * b * scale};
}

TEST(HorizonPoint, IsThePublishedPoint) {
    Random random(423);
    const Real scale = 1 - static_cast<Real>(kPointDepth) / wgs84().polarRadius();
    int differences = 0;
    int hidden = 0;
    constexpr int kTrials = 20000;
    for (int trial = 0; trial < kTrials; ++trial) {
        const GeodeticBin bin = randomTile(random, random.integer(1, 6), {-500.0, 3000.0});
        const glm::dvec3 eye = randomEye(random, wgs84(), kPointDepth);
        const auto prepared = HorizonEye::fromEye(wgs84(), kPointDepth, eye);
        const auto point = sampledPoint(bin, scale);
        if (!prepared || !point) continue;
        const bool isPublishedHidden = !segmentMissesOccluder(wgs84(), kPointDepth, *point, real(eye));
        hidden += isPublishedHidden ? 1 : 0;
        differences += isPublishedHidden != pointOf(wgs84(), bin).isHiddenFrom(*prepared) ? 1 : 0;
    }
    EXPECT_GT(hidden, kTrials / 4);
    // The middle in latitude is not quite that of the scaled latitudes, and no sample may be the farthest point.
    EXPECT_LT(differences, kTrials / 500);
}

}  // namespace
}  // namespace osgAnalyticBin::test
