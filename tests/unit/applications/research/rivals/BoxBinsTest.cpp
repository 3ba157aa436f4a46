// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Oracles: the bin's exact range by long double; random positions of the bin. Millions of planes and frusta that hold a
// point of the bin: HullSoundness.cpp.

#include "BoxBins.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>
#include <osgAnalyticBin/core/bin/QuadraticBin.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <support/Numbers.h>
#include <support/RandomBins.h>
#include <support/RandomViews.h>
#include <support/View.h>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::Ellipsoid;
using core::GeodeticBin;
using core::Plane;
using core::Side;
using hull::FrustumHull;
using rivals::BoxBin;
using rivals::OrientedBoxBin;

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
        for (std::size_t i = 0; i < TypeParam::kFaces; ++i) {
            const Real gap = oracle.distanceRange(box.face(i)).lower;
            ASSERT_GE(gap, 0) << "trial " << trial << " face " << i;
            ASSERT_LE(gap, kBoxTightness * farthest(oracle)) << "trial " << trial << " face " << i;
        }
    }
}

const GeodeticBin kTile = GeodeticBin::fromDegrees({10.0, 11.0}, {20.0, 21.0}, {0.0, 100.0});

TYPED_TEST(BoxBins, HoldTheMargin) {
    const TypeParam bare(wgs84(), kTile), grown(wgs84(), kTile, 250.0);
    for (std::size_t i = 0; i < TypeParam::kFaces; ++i)
        EXPECT_NEAR(grown.face(i).offset - bare.face(i).offset, 250.0, 1e-5);
}

TYPED_TEST(BoxBins, KeepWhatHasNoClosedFormAndWhatIsNotANumber) {
    const GeodeticBin deep = kTile.withAltitude({-6.4e6, 100.0});
    const TypeParam box(wgs84(), deep);
    Random random(404);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 normal = random.direction();
        const RealVector point = geodeticToEcef(wgs84(), randomPosition(random, deep));
        const Plane through{normal, static_cast<double>(-dot(real(normal), point))};
        ASSERT_EQ(box.classify(through), Side::Straddling);
    }
    EXPECT_EQ(box.classify({{1.0, 0.0, 0.0}, -2e7}), Side::Outside);
    const TypeParam tile(wgs84(), kTile);
    EXPECT_EQ(tile.classify({{kNaN, 0.0, 0.0}, -1e8}), Side::Straddling);
    EXPECT_EQ(tile.classify({{1.0, 0.0, 0.0}, kNaN}), Side::Straddling);
    EXPECT_EQ(TypeParam(wgs84(), kTile, kNaN).classify({{1.0, 0.0, 0.0}, -1e8}), Side::Straddling);
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

TYPED_TEST(BoxBins, OfAMapAreTheBoxItself) {
    const GeodeticBin bin({0.1, 0.2}, {0.3, 0.5}, {-10.0, 900.0});
    const TypeParam box(Ellipsoid::plane(), bin, 1.0);
    const core::QuadraticBin quadratic(core::GeodeticMapping(Ellipsoid::plane()), core::parameterBox(bin), 1.0);
    Random random(4813);
    for (int trial = 0; trial < 1000; ++trial) {
        const Plane plane{random.direction(), random.uniform(-3e6, 3e6)};
        EXPECT_EQ(box.classify(plane), quadratic.classify(plane));
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
