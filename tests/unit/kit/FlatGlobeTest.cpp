// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The eye above the lowest surface that is shown, over a globe of which every altitude is known.

#include "CameraGlobe.h"
#include "DeepGlobe.h"
#include "ShownEye.h"

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>

#include <algorithm>
#include <memory>
#include <support/Random.h>

namespace osgAnalyticBin::test {
namespace {

// A flat globe seen from 1000 km above 22.5 east, 22.5 north, straight down: tile 20 is below the eye, tile 21 east of
// it.
class FlatGlobe : public testing::Test {
protected:
    FlatGlobe() {
        DeepTerrain terrain;
        terrain.deepShare = 0.0;
        terrain.loadedShare = 0.0;
        Random random(1);
        globe = std::make_unique<DeepGlobe>(terrain, random);
        for (std::size_t i = 0; i < 32; ++i) setAltitude(i, -100.0);
    }

    void setAltitude(std::size_t i, double altitude) {
        DeepTile& tile = globe->start(i);
        tile.surface = tile.low = altitude;
        tile.high = std::max(altitude, 0.0);
    }

    static Picture pictureOf(double degrees) {
        const double angle = 22.5 * osg::PI / 180.0;
        return Picture(earth().toEcef({angle, angle, 1e6}), glm::dvec3(0.0), {0.0, 0.0, 1.0}, degrees);
    }

    static constexpr std::size_t kBelow = 20, kFarSide = 8;
    std::unique_ptr<DeepGlobe> globe;
};

TEST_F(FlatGlobe, HasItsDepthInTheFirstFrame) {
    globe->build();
    const Picture picture = pictureOf(40.0);
    const ShownEye first = askForEye(*globe->root, picture);
    ASSERT_TRUE(first.eye);
    EXPECT_NEAR(first.found, 100.0, 1e-9);
    EXPECT_NEAR(occluderDepth(*first.eye, picture.eye), 100.0, 0.5);
    const ShownEye second = askForEye(*globe->root, picture, first.found);
    ASSERT_TRUE(second.eye);
    EXPECT_NEAR(occluderDepth(*second.eye, picture.eye), 100.0, 0.5);
}

TEST_F(FlatGlobe, IsAsDeepAsItsDeepestTileInView) {
    setAltitude(kBelow, -9000.0);
    globe->build();
    EXPECT_NEAR(askForEye(*globe->root, pictureOf(40.0)).found, 9000.0, 1e-9);
}

TEST_F(FlatGlobe, IsNoDeeperForTilesBehindItOrBesideTheView) {
    setAltitude(kFarSide, -9000.0);
    setAltitude(kBelow - 1, -8000.0);
    globe->build();
    EXPECT_NEAR(askForEye(*globe->root, pictureOf(1.0)).found, 100.0, 1e-9);
}

TEST_F(FlatGlobe, HasNoHorizonWhereADepthInViewIsUnknown) {
    globe->start(kBelow).low = globe->start(kFarSide).low = -300.0;
    globe->build();
    globe->start(kFarSide).callback->setSurface(AnalyticBin());
    EXPECT_TRUE(askForEye(*globe->root, pictureOf(40.0)).eye);
    globe->start(kBelow).callback->setSurface(AnalyticBin());
    const ShownEye answer = askForEye(*globe->root, pictureOf(40.0), 500.0);
    EXPECT_FALSE(answer.eye);
    EXPECT_EQ(answer.found, 0.0);
}

TEST_F(FlatGlobe, IsAsDeepAsDeclaredWhereADepthInViewIsUnknown) {
    globe->start(kBelow).low = -300.0;
    globe->build();
    const Picture picture = pictureOf(40.0);
    EXPECT_NEAR(askForEye(*globe->root, picture, 0.0, 700.0).found, 100.0, 1e-9);
    globe->start(kBelow).callback->setSurface(AnalyticBin());
    const ShownEye answer = askForEye(*globe->root, picture, 0.0, 700.0);
    ASSERT_TRUE(answer.eye);
    EXPECT_NEAR(occluderDepth(*answer.eye, picture.eye), 700.0, 0.5);
}

TEST_F(FlatGlobe, IsNeverDeeperThanDeclared) {
    setAltitude(kBelow, -9000.0);
    globe->build();
    const Picture picture = pictureOf(40.0);
    for (const double start : {0.0, 700.0, 20000.0}) {
        const ShownEye answer = askForEye(*globe->root, picture, start, 700.0);
        ASSERT_TRUE(answer.eye);
        EXPECT_NEAR(occluderDepth(*answer.eye, picture.eye), 700.0, 0.5);
    }
}

TEST_F(FlatGlobe, NeedsNoDepthWhereTheBinIsAboveTheRest) {
    globe->build();
    globe->start(kBelow).callback->setSurface(AnalyticBin());
    EXPECT_NEAR(askForEye(*globe->root, pictureOf(40.0)).found, 100.0, 1e-9);
}

TEST_F(FlatGlobe, HasNoHorizonWhereATileIsOfAnotherShape) {
    globe->build();
    globe->start(kBelow).callback->setTerrainShape(TerrainShape{2.0, 1.0});
    EXPECT_FALSE(askForEye(*globe->root, pictureOf(40.0)).eye);
}

TEST_F(FlatGlobe, IsNoDeeperForAnotherDatabaseInsideIt) {
    globe->build();
    DeepTerrain terrain;
    terrain.deepShare = 0.0;
    terrain.loadedShare = 0.0;
    Random random(2);
    DeepGlobe other(terrain, random);
    for (std::size_t i = 0; i < 32; ++i) other.start(i).surface = other.start(i).low = -7000.0;
    other.build();
    const osg::ref_ptr<osg::CoordinateSystemNode> inside = new osg::CoordinateSystemNode;
    inside->addChild(other.root);
    globe->root->addChild(inside);
    const Picture picture = pictureOf(40.0);
    EXPECT_NEAR(askForEye(*globe->root, picture).found, 100.0, 1e-9);
    EXPECT_NEAR(askForEye(*other.root, picture).found, 7000.0, 1e-9);
}

}  // namespace
}  // namespace osgAnalyticBin::test
