// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which tiles a view needs. Oracles: bins and eyes for which the answer follows from their angles; hulls by libccd and
// lines of sight in long double for random ones.

#include "TileTruth.h"

#include <gtest/gtest.h>

#include <DatabaseFixture.h>
#include <support/View.h>

namespace osgAnalyticBin::bench {
namespace {

using core::Ellipsoid;
using core::GeodeticBin;

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

const osg::ref_ptr<const osg::EllipsoidModel> kModel = new osg::EllipsoidModel;

Ellipsoid earth() {
    return Ellipsoid(kModel->getRadiusEquator(), kModel->getRadiusPolar());
}

osg::Vec3 at(double latDeg, double lonDeg, double altitude) {
    const glm::dvec3 p = earth().toEcef({latDeg * kRadiansPerDegree, lonDeg * kRadiansPerDegree, altitude});
    return osg::Vec3(osg::Vec3d(p.x, p.y, p.z));
}

// One degree wide, from the south-west corner on.
flight::DrawnTile tileAt(const std::string& key, double southDeg, double westDeg) {
    const auto mesh = test::makeMeshTile(test::extentsDeg(southDeg, southDeg + 1, westDeg, westDeg + 1), 0.0, 2);
    return {key, {{mesh->getChild(0)->asGeode()->getDrawable(0), mesh->getMatrix()}}, {}};
}

TEST(OccluderDepth, GrowsOnlyByWhatIsBeforeItsOwnHorizon) {
    const glm::dvec3 eye = earth().toEcef({0.0, 0.0, 10000.0});
    const auto bin = [](double lonDeg, double low) {
        return GeodeticBin::fromDegrees({-1.0, 1.0}, {lonDeg, lonDeg + 1.0}, {low, 0.0});
    };
    EXPECT_EQ(occluderDepth({}, earth(), eye), 0.0);
    EXPECT_EQ(occluderDepth({bin(0.0, -500.0), bin(40.0, -20000.0)}, earth(), eye), 500.0);
    // The first lowers the horizon so far that the second comes before it.
    EXPECT_EQ(occluderDepth({bin(0.0, -30000.0), bin(5.0, -40000.0)}, earth(), eye), 40000.0);
    EXPECT_EQ(occluderDepth({bin(0.0, 100.0)}, earth(), eye), 0.0);
}

// From 20 km above 0 N 0 E towards the east.
osg::ref_ptr<osg::Camera> cameraAhead() {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewMatrixAsLookAt(at(0, 0, 20000), at(0, 2.5, 0), osg::Vec3d(1, 0, 0));
    camera->setProjectionMatrixAsPerspective(30.0, 1.0, 100.0, 2e7);
    return camera;
}

TEST(TileTruth, CountsTheBinOfTheKitAndElseTheSurface) {
    std::vector<flight::DrawnTile> tiles{tileAt("ahead", -0.5, 2), tileAt("mountain", 1.5, 2), tileAt("far", -0.5, 8)};
    TileTruth truth;
    const auto expectNeeded = [&](const std::set<std::string>& keys, std::uint64_t hidden) {
        const NeededTiles needed = truth.neededTiles(tiles, *cameraAhead(), {kModel, osg::Matrixd()});
        EXPECT_EQ(needed.keys, keys);
        EXPECT_EQ(needed.hidden, hidden);
    };
    expectNeeded({"ahead"}, 1U);
    // What finer descendants of "far" have in store rises above the horizon; "mountain" stays beside the frustum.
    tiles[1].bin = AnalyticBin(GeodeticBin::fromDegrees({1.5, 2.5}, {2, 3}, {-500, 500}));
    tiles[2].bin = AnalyticBin(GeodeticBin::fromDegrees({-0.5, 0.5}, {8, 9}, {-500, 50000}));
    truth.learnBins(tiles);
    expectNeeded({"ahead", "far"}, 0U);
}

// A camera like the view, whose planes near and far it needs.
osg::ref_ptr<osg::Camera> cameraOf(const test::View& view) {
    const auto toOsg = [](const glm::dvec3& v) { return osg::Vec3d(v.x, v.y, v.z); };
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setViewMatrixAsLookAt(toOsg(view.eye), toOsg(view.eye + 1e6 * view.forward), toOsg(view.up));
    camera->setProjectionMatrixAsPerspective(2.0 * std::atan(view.halfWidth) / kRadiansPerDegree, 1.0,
                                             view.nearDistance, view.farDistance);
    return camera;
}

test::View randomPerspective(test::Random& random, const glm::dvec3& target) {
    test::View view;
    const core::Geodetic below{random.uniform(-1.5, 1.5), random.uniform(-3.1, 3.1), random.logUniform(1e4, 1e7)};
    view.eye = earth().toEcef(below);
    view.lookAlong(glm::normalize(target - view.eye), random);
    view.halfWidth = random.logUniform(0.02, 0.6);
    view.nearDistance = random.logUniform(1e3, 1e5);
    view.farDistance = 3e7;
    return view;
}

// Whether the ellipsoid stands between the eye and every one of some points of the bin.
bool isBlocked(test::Random& random, const GeodeticBin& bin, const glm::dvec3& eye) {
    for (int i = 0; i < 20; ++i) {
        const auto point = test::geodeticToEcef(earth(), test::randomPosition(random, bin));
        if (test::segmentMissesOccluder(earth(), 0.0, point, test::real(eye))) return false;
    }
    return true;
}

TEST(TileTruth, AgreesWithHullsAndLinesOfSight) {
    test::Random random(20261);
    int meeting = 0, more = 0, hidden = 0, blocked = 0;
    for (int i = 0; i < 4000; ++i) {
        const core::Interval heights{random.uniform(0, 2000), random.uniform(2000, 9000)};
        const GeodeticBin bin = test::randomTile(random, random.integer(1, 6), heights);
        const core::Geodetic near = test::randomPosition(random, bin);
        const test::View view =
            randomPerspective(random, earth().toEcef({near.latitude * random.uniform(0.9, 1.1),
                                                      near.longitude + random.uniform(-0.3, 0.3), near.altitude}));
        TileTruth truth;
        truth.learnBins({{"t", {}, AnalyticBin(bin)}});
        const NeededTiles needed =
            truth.neededTiles({{"t", {}, {}}}, *cameraOf(view), flight::Globe{kModel, osg::Matrixd()});
        const bool isCounted = !needed.keys.empty() || needed.hidden > 0;
        const bool meets = test::hullsMeet(earth(), bin, view);
        EXPECT_TRUE(isCounted || !meets) << i;
        meeting += meets ? 1 : 0;
        more += isCounted && !meets ? 1 : 0;
        if (!meets || !isBlocked(random, bin, view.eye)) {
            EXPECT_TRUE(!meets || needed.hidden == 0) << i;
            continue;
        }
        ++blocked;
        hidden += needed.hidden > 0 ? 1 : 0;
    }
    EXPECT_GT(meeting, 400);
    EXPECT_LE(more, meeting / 1000);
    EXPECT_GT(blocked, 100);
    EXPECT_GE(hidden, blocked * 99 / 100);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
