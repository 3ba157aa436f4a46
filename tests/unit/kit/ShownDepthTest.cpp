// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The eye above the lowest surface that is shown. Oracle: rays through the picture, met by the surfaces that OSG's rule
// shows: a constant altitude for each tile, its lowest, with walls between tiles. A ray that enters the occluder and
// has not met a surface by then would see what is hidden. Last,
// single cases over a globe of which every altitude is known.

#include "CameraGlobe.h"
#include "DatabaseFixture.h"
#include "DeepGlobe.h"
#include "ShownEye.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/InstallBins.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <support/Random.h>

namespace osgAnalyticBin::test {
namespace {

using core::GeodeticBin;
using core::HorizonEye;

constexpr double kRoom = 1.05;  // documented

// Whether the ray has met a shown surface when it has gone so far.
bool isStopped(const DeepGlobe& globe, const glm::dvec3& eye, const glm::dvec3& ray, double distance) {
    const auto isBelow = [&](double t) {
        const core::Geodetic g = earth().toGeodetic(eye + ray * t);
        return g.altitude <= globe.shownAltitude(g.latitude, g.longitude, eye);
    };
    if (isBelow(distance)) return true;
    constexpr double kStep = 200.0;
    for (double t = distance; t > 0.0 && earth().toGeodetic(eye + ray * t).altitude < 3000.0; t -= kStep) {
        if (isBelow(t)) return true;
    }
    return false;
}

Picture randomPicture(Random& random, double lowestEye) {
    const glm::dvec3 direction = random.direction();
    const core::Geodetic below = earth().toGeodetic(direction * kEarthRadius);
    const glm::dvec3 eye = earth().toEcef({below.latitude, below.longitude, lowestEye + random.logUniform(20.0, 2e7)});
    // towards the horizon, where the occluder matters
    const double dip = std::acos(std::min(1.0, (kEarthRadius - 5000.0) / glm::length(eye)));
    const glm::dvec3 side = glm::normalize(glm::cross(direction, random.direction()));
    const double angle = dip * random.uniform(0.5, 1.1) + 1e-4;
    const glm::dvec3 target = (direction * std::cos(angle) + side * std::sin(angle)) * kEarthRadius;
    return Picture(eye, target, random.chance(0.5) ? direction : random.direction(), random.logUniform(0.05, 90.0));
}

struct DepthTally {
    int eyes = 0;
    int entered = 0;  // rays that entered the occluder
};

// Nothing that is seen is hidden from the eye.
void expectNothingSeenIsHidden(const DeepGlobe& globe, const Picture& picture, const HorizonEye& eye, Random& random,
                               DepthTally& tally) {
    // less than what the depth is found to
    const double depth = occluderDepth(eye, picture.eye) + 0.5;
    ++tally.eyes;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 ray = picture.ray(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        const auto distance = entryIntoOccluder(picture.eye, ray, depth);
        if (!distance) continue;
        ++tally.entered;
        ASSERT_TRUE(isStopped(globe, picture.eye, ray, *distance)) << "depth " << depth << " fov " << picture.fov;
    }
}

// The deepest surface shown on tiles that come within `room` of what the eye sees over the horizon.
double deepestNear(const DeepGlobe& globe, const Picture& picture, double depth) {
    constexpr double kAngle = 0.06;
    const glm::dvec3 toEye = inUnitSpace(picture.eye);
    const double occluder = 1.0 - depth / kPolarRadius;
    const double horizon =
        std::acos(std::min(1.0, occluder / glm::length(toEye))) + std::acos(std::min(1.0, occluder / 1.0015));
    double deepest = 0.0;
    globe.forEachShown(picture.eye, [&](const DeepTile& tile) {
        for (int i = 0; i < 81; ++i) {
            const glm::dvec3 point =
                inUnitSpace(earth().toEcef({tile.latitude.lower + tile.latitude.width() * (i % 9) / 8.0,
                                            tile.longitude.lower + tile.longitude.width() * (i / 9) / 8.0, 0.0}));
            const double cosine = glm::dot(point, toEye) / (glm::length(point) * glm::length(toEye));
            if (std::acos(std::clamp(cosine, -1.0, 1.0)) <= horizon + kAngle)
                deepest = std::max(deepest, -tile.surface);
        }
    });
    return deepest;
}

DepthTally fly(const DeepTerrain& terrain, std::uint64_t stream, int globes, bool startsDeep = false) {
    Random random(stream);
    DepthTally tally;
    for (int trial = 0; trial < globes; ++trial) {
        DeepGlobe globe(terrain, random);
        globe.build();
        for (int shot = 0; shot < 12; ++shot) {
            const Picture picture = randomPicture(random, -15000.0 * random.uniform());
            const core::Geodetic at = earth().toGeodetic(picture.eye);
            if (at.altitude <= globe.shownAltitude(at.latitude, at.longitude, picture.eye) + 10.0) continue;
            const double start = startsDeep ? random.uniform(0.0, 20000.0) : 0.0;
            const ShownEye answer = askForEye(*globe.root, picture, start);
            if (!answer.eye) {
                // an eye above the globe, and above all that may be shown below it, finds a horizon
                const double highest = globe.mostAltitude(at.latitude, at.longitude, picture.eye);
                EXPECT_TRUE(at.altitude < 0.0 || at.altitude <= highest);
                continue;
            }
            expectNothingSeenIsHidden(globe, picture, *answer.eye, random, tally);
            if (testing::Test::HasFatalFailure()) return tally;

            const double depth = occluderDepth(*answer.eye, picture.eye);
            EXPECT_LE(answer.found, depth + 1.0);
            if (at.altitude > 0.0) {
                EXPECT_LE(depth, std::max(start, kRoom * deepestNear(globe, picture, depth)) + 1.0);
            }
            // where the first search ends the next one begins
            const ShownEye next = askForEye(*globe.root, picture, answer.found);
            EXPECT_TRUE(next.eye || at.altitude < 0.0);
            if (next.eye && at.altitude > 0.0) {
                EXPECT_NEAR(occluderDepth(*next.eye, picture.eye), answer.found, 1.0);
            }
        }
    }
    return tally;
}

TEST(ShownDepth, HidesNothingThatIsSeen) {
    for (const double deepShare : {0.02, 0.3, 1.0}) {
        for (const double airShare : {0.0, 1.0}) {
            DeepTerrain terrain;
            terrain.deepShare = deepShare;
            terrain.airShare = airShare;
            const DepthTally tally = fly(terrain, 2100, 20);
            EXPECT_GT(tally.eyes, 100);
            EXPECT_GT(tally.entered, 1500);
        }
    }
}

TEST(ShownDepth, HidesNothingThatIsSeenWhereverTheSearchStartsAndWhateverIsShown) {
    DeepTerrain bySize, belowTransforms, behindCallbacks;
    bySize.mode = osg::LOD::PIXEL_SIZE_ON_SCREEN;
    belowTransforms.movedShare = 0.5;
    behindCallbacks.hasCallbackInFront = true;
    EXPECT_GT(fly(DeepTerrain(), 2101, 20, true).entered, 1000);
    EXPECT_GT(fly(bySize, 2102, 20).entered, 1000) << "all that is loaded counts";
    EXPECT_GT(fly(belowTransforms, 2103, 20).entered, 1000) << "here, too";
    EXPECT_GT(fly(behindCallbacks, 2104, 20).entered, 1000);
}

// Adds a tile without parts, its bin as flat as its surface; or one with a mesh, for bins to be installed. Degrees.
void addFlatTile(osg::Group& root, core::Interval latitude, core::Interval longitude, double altitude, bool hasMesh) {
    if (hasMesh) {
        const core::GeodeticBin extents = extentsDeg(latitude.lower, latitude.upper, longitude.lower, longitude.upper);
        const osg::ref_ptr<osg::Group> tile = new osg::Group;
        tile->addChild(makeMeshTile(extents, altitude));
        setStoredBin(*tile, AnalyticBin(extents.withAltitude({altitude - 30.0, altitude + 1.0}), 1.0));
        root.addChild(tile);
        return;
    }
    const AnalyticBin bin(GeodeticBin::fromDegrees(latitude, longitude, {altitude, altitude}));
    const osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback(bin, osg::EllipsoidModel());
    callback->setSurface(bin);
    const osg::ref_ptr<osg::Group> tile = new osg::Group;
    tile->setCullCallback(callback);
    root.addChild(tile);
}

TEST(ShownDepth, FindsABasinThatLinesOfSightPassHighAbove) {
    // Looking east along the equator past the limb, 4500 m below the ellipsoid at its nearest, over tiles of a basin
    // at -9000 m that are all below the picture.
    const glm::dvec3 eye = earth().toEcef({0.0, 0.0, 2000.0});
    const double toLimb = std::acos((kEarthRadius - 4500.0) / (kEarthRadius + 2000.0));
    const glm::dvec3 limb = earth().toEcef({0.0, toLimb, -4500.0});
    const Picture picture(eye, limb, {1.0, 0.0, 0.0}, 0.1);

    const auto shallow = HorizonEye::fromEye(earth(), 3000.0, eye);
    ASSERT_TRUE(shallow);
    ASSERT_TRUE(hidesPoint(*shallow, earth().toEcef({0.0, 2.5 * toLimb, -4000.0})));
    const auto distance = entryIntoOccluder(eye, picture.ray(0.0, 0.0), 3000.0);
    ASSERT_TRUE(distance);
    EXPECT_GT(earth().toGeodetic(eye + picture.ray(0.0, 0.0) * *distance).longitude, osg::DegreesToRadians(0.5));

    for (const bool isFamily : {false, true}) {
        const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
        root->setEllipsoidModel(new osg::EllipsoidModel);
        addFlatTile(*root, {-1.0, 1.0}, {-1.0, 0.5}, -3000.0, isFamily);
        for (int i = 10; i < 100; ++i)
            addFlatTile(*root, {-0.025, 0.025}, {0.05 * i, 0.05 * (i + 1)}, -9000.0, isFamily);
        if (isFamily) {
            EXPECT_EQ(installBins(*root), 91u);
        }
        const ShownEye answer = askForEye(*root, picture, 3000.0);
        ASSERT_TRUE(answer.eye) << isFamily;
        EXPECT_NEAR(answer.found, 9000.0, 1.0);
    }
}

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

TEST_F(FlatGlobe, HasNoHorizonWhereATileIsOfAnotherShape) {
    globe->build();
    globe->start(kBelow).callback->setTerrainShape(TerrainShape{2.0, 1.0});
    EXPECT_FALSE(askForEye(*globe->root, pictureOf(40.0)).eye);
}

}  // namespace
}  // namespace osgAnalyticBin::test
