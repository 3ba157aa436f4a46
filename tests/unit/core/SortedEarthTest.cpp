// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Balls behind terrain, in any order. Oracle: rays through all triangles, in long double. The buffer itself:
// HorizonBufferTest.cpp. And the bodies that are asked for: the interpolated point of the eight corners, which is in
// their hull, beside the point in long double.

#include "CoreTest.h"
#include "OcclusionScene.h"

namespace osgAnalyticBin::test {
namespace {

using core::BinBall;

constexpr int kRaysOfAll = 24;
constexpr int kBallsInScene = 60;

HorizonBuffer sorted(HorizonBuffer buffer) {
    buffer.sort();
    return buffer;
}

// With all its earth, not sorted yet.
HorizonBuffer filled(const OcclusionScene& scene, const glm::dvec3& eyes = glm::dvec3(0.0)) {
    HorizonBuffer buffer = bufferOf(scene, eyes);
    for (const GroundTile& tile : scene.tiles) addTile(buffer, scene, tile, 8);
    return buffer;
}

// A ball somewhere about the terrain, often near its surface, in ECEF.
BinBall randomBall(Random& random, const OcclusionScene& scene) {
    const auto& tile = scene.tiles[static_cast<std::size_t>(random.integer(0, int(scene.tiles.size()) - 1))];
    const glm::dvec3 place = rounded(random.chance(0.5) ? scene.pointIn(random, tile) : scene.topOf(random, tile));
    const double size = tile.bin.altitude().width() * random.logUniform(1e-4, 1.0);
    return {place + size * random.direction(), size * random.logUniform(0.01, 2.0)};
}

BinBall inFrame(const BinBall& ball, const core::Frame& frame) {
    const glm::dvec3 from = ball.centre - frame.origin;
    return {{glm::dot(from, frame.x), glm::dot(from, frame.y), glm::dot(from, frame.z)}, ball.radius};
}

// Whether no ray reaches the ball.
bool isUnseen(Random& random, const OcclusionScene& scene, const BinBall& ball) {
    for (int ray = 0; ray < kRaysOfAll; ++ray) {
        const RealVector point = real(ball.centre + ball.radius * random.direction());
        if (isBeforeTheCamera(scene, point) && !scene.isBlocked(point)) return false;
    }
    return true;
}

// Half of the scenes have one eye, the others any in a box.
TEST(SortedEarth, HidesNoBallThatARayReachesFromAnyOfTheEyes) {
    Random random(1730);
    int hidden = 0, unseen = 0, hiddenFromBoxes = 0;
    for (int i = 0; i < 120; ++i) {
        const bool isBox = i % 2 == 1;
        const OcclusionScene scene(random, true, i % 8 == 0);
        const glm::dvec3 eyes = isBox ? randomEyes(random, scene) : glm::dvec3(0.0);
        const HorizonBuffer earth = sorted(filled(scene, eyes));
        OcclusionScene moved = scene;
        for (int k = 0; k < kBallsInScene; ++k) {
            const BinBall ball = randomBall(random, scene);
            const HorizonBuffer::Outline outline = earth.outlineOf(inFrame(ball, frameOf(scene)));
            const bool isHidden = earth.hidesInAnyOrder(outline);
            (isBox ? hiddenFromBoxes : hidden) += isHidden;
            unseen += !isBox && !outline.isBeside && isUnseen(random, scene, ball);
            for (int eye = 0; isHidden && eye < (isBox ? 3 : 1); ++eye) {
                if (!moveEye(moved, random, frameOf(scene), eyes)) continue;
                ASSERT_TRUE(isUnseen(random, moved, ball)) << "scene " << i << ", ball " << k;
            }
        }
    }
    std::printf("%d balls that no ray reaches, %d hidden\n", unseen, hidden);
    EXPECT_GT(2 * hidden, unseen);
    EXPECT_GT(hiddenFromBoxes, 60);
}

// The buffer, asked front to back, knows as much.
TEST(SortedEarth, HidesWhatTheBufferHides) {
    Random random(1732);
    int hidden = 0;
    for (int i = 0; i < 30; ++i) {
        const OcclusionScene scene(random, false);
        HorizonBuffer buffer = filled(scene);
        const HorizonBuffer earth = sorted(buffer);
        for (const auto& [part, outline] : frontToBack(scene, buffer)) {
            const bool isHidden = buffer.hides(outline);
            hidden += isHidden;
            EXPECT_EQ(earth.hidesInAnyOrder(outline), isHidden);
        }
    }
    EXPECT_GT(hidden, 30);
}

// Whether it was asked before, and sorted, or not.
TEST(HorizonBuffer, HidesWithoutTheEarthOfSomeWhatOthersHide) {
    Random random(1734);
    int hidden = 0, fewer = 0;
    for (int i = 0; i < 30; ++i) {
        const OcclusionScene scene(random, false);
        HorizonBuffer restarted = bufferOf(scene), others = bufferOf(scene), all = bufferOf(scene);
        std::vector<std::uint32_t> without;
        for (std::uint32_t k = 0; k < scene.tiles.size(); ++k) {
            const GroundTile& tile = scene.tiles[k];
            addTile(restarted, scene, tile, 8, k);
            addTile(all, scene, tile, 8);
            if (random.chance(0.3))
                without.push_back(k);
            else
                addTile(others, scene, tile, 8);
        }
        const auto bodies = frontToBack(scene, all);
        if (i % 3 > 0) (void)restarted.hides(bodies[bodies.size() / 2].outline);
        if (i % 3 == 2) restarted.sort();
        restarted.restart(without);
        EXPECT_FALSE(restarted.isSorted());
        for (const auto& [part, outline] : bodies) {
            const bool isHidden = restarted.hides(outline);
            EXPECT_EQ(isHidden, others.hides(outline)) << "scene " << i;
            const bool isHiddenByAll = all.hides(outline);
            EXPECT_TRUE(isHiddenByAll || !isHidden);
            hidden += isHidden ? 1 : 0;
            fewer += isHiddenByAll && !isHidden ? 1 : 0;
        }
    }
    EXPECT_GT(hidden, 30);
    EXPECT_GT(fewer, 30);
}

// Points of the ball are in its outline, for all eyes, and the outline is no wider than that of a cube.
TEST(SortedEarth, OutlinesOfBallsAreTightAndHoldThem) {
    Random random(1733);
    for (int i = 0; i < 2000; ++i) {
        const double size = random.chance(0.5) ? 0.0 : 5.0;
        const glm::dvec3 eyes(random.uniform(0.0, size), random.uniform(0.0, size), random.uniform(0.0, size));
        const HorizonBuffer buffer(6.4e6, {-1.0, 1.0}, 0.0, 0.0, eyes);
        const double ahead = random.logUniform(60.0, 1e5), radius = ahead * random.logUniform(1e-4, 0.9);
        const BinBall ball{{ahead * random.uniform(-1.2, 1.2), ahead, ahead * random.uniform(-1.2, 1.2)}, radius};
        const HorizonBuffer::Outline outline = buffer.outlineOf(ball);
        if (outline.isBeside) continue;
        core::BinHull cube{};
        for (std::size_t k = 0; k < 8; ++k) cube.setCorner(k, ball.centre);
        cube.reach = radius;
        EXPECT_LE(outline.across.width(), 1.5 * buffer.outlineOf(cube).across.width());
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 eye(eyes.x * random.sign(), eyes.y * random.sign(), eyes.z * random.sign());
            const glm::dvec3 onBall = ball.centre + radius * random.direction(), point = onBall - eye;
            EXPECT_GE(onBall.y, outline.nearest);
            EXPECT_TRUE(outline.across.contains(point.x / point.y));
            EXPECT_TRUE(outline.heights.contains(point.z / point.y));
        }
    }
}

// Lines of sight that may meet terrain in front of the near plane.
TEST(SortedEarth, HidesNothingBelowTheLowestLine) {
    Random random(1734);
    int above = 0, below = 0;
    for (int i = 0; i < 10; ++i) {
        const OcclusionScene scene(random, false);
        HorizonBuffer buffer = filled(scene);
        const HorizonBuffer all = sorted(buffer);
        const double lowest = -0.05;
        buffer.raiseLowest(lowest);
        const HorizonBuffer cut = sorted(buffer);
        for (int k = 0; k < kBallsInScene; ++k) {
            const auto outline = all.outlineOf(inFrame(randomBall(random, scene), frameOf(scene)));
            const bool isAbove = outline.heights.lower >= lowest;
            EXPECT_EQ(cut.hidesInAnyOrder(outline), all.hidesInAnyOrder(outline) && isAbove);
            if (all.hidesInAnyOrder(outline)) ++(isAbove ? above : below);
        }
    }
    EXPECT_GT(above, 0);
    EXPECT_GT(below, 0);
}

TEST(BinBody, IsInTheHullsOfItsQuarters) {
    Random random(1711);
    double closest = 1e300;
    for (int trial = 0; trial < 20000; ++trial) {
        const double radius = random.logUniform(1.0, 1e9);
        const Ellipsoid ellipsoid(radius, radius * random.uniform(0.996, 1.004));
        const double size = random.logUniform(1e-7, 1.5), wider = random.logUniform(1e-7, 3.0);
        const double south = random.uniform(-1.57, 1.57 - size), west = random.uniform(-4.0, 4.0);
        const double low = radius * random.uniform(-0.1, 0.1);
        const GeodeticBin bin({south, south + size}, {west, west + wider},
                              {low, low + radius * random.logUniform(1e-6, 0.1)});
        const core::Frame frame = randomFrame(random, radius * random.uniform(0.0, 1.1) * random.direction());
        const int quarter = random.integer(0, 3);
        BinHull hull = core::BinBody(ellipsoid, bin, 0.0, frame).quarters()[static_cast<std::size_t>(quarter)];
        const double top = random.chance(0.5) ? 1.0 : random.uniform();
        hull.lowerTop(low + top * bin.altitude().width(), bin.altitude());
        // at the middle the interpolation is worst
        const auto share = [&] { return random.chance(0.5) ? 0.5 : random.uniform(); };
        const double p = share(), l = share(), h = random.uniform();
        const glm::dvec3 point =
            ellipsoid.toEcef({south + 0.5 * (quarter / 2 + p) * size, west + 0.5 * (quarter % 2 + l) * wider,
                              low + h * top * bin.altitude().width()});
        glm::dvec3 inHull(0.0);
        for (std::size_t i = 0; i < 8; ++i) {
            inHull += (i % 2 != 0 ? l : 1.0 - l) * (i / 2 % 2 != 0 ? p : 1.0 - p) * (i / 4 != 0 ? h : 1.0 - h) *
                      hull.corner(i);
        }
        ASSERT_LE(glm::distance(point, frame.toOuter(inHull)), hull.reach);
        if (p == 0.5 && l == 0.5 && size > 1e-3)
            closest = std::min(closest, hull.reach / glm::distance(point, frame.toOuter(inHull)));
    }
    EXPECT_LT(closest, 1.1);
}

TEST(BinBody, IsInItsBall) {
    Random random(1712);
    for (int trial = 0; trial < 100000; ++trial) {
        const bool isMap = random.chance(0.2);
        const double radius = random.logUniform(1.0, 1e9);
        const Ellipsoid ellipsoid =
            isMap ? Ellipsoid::plane() : Ellipsoid(radius, radius * random.uniform(0.996, 1.004));
        const double size = random.logUniform(1e-7, 3.0), wider = random.logUniform(1e-7, 6.2);
        const double south = random.uniform(-1.57, 1.57 - size), west = random.uniform(-4.0, 4.0);
        const double low = radius * random.uniform(-0.1, 0.1), margin = radius * random.logUniform(1e-9, 1e-2);
        const GeodeticBin bin({south, south + size}, {west, west + wider},
                              {low, low + radius * random.logUniform(1e-6, 0.1)});
        const core::Frame frame = randomFrame(random, radius * random.uniform(0.0, 1.1) * random.direction());
        const core::BinBall ball = core::BinBody(ellipsoid, bin, margin, frame).ball();
        // corners are worst
        const auto share = [&] { return random.chance(0.7) ? std::floor(random.uniform(0.0, 2.0)) : random.uniform(); };
        const glm::dvec3 point =
            ellipsoid.toEcef({south + share() * size, west + share() * wider, low + share() * bin.altitude().width()});
        const glm::dvec3 inMargin = point + 0.999 * margin * random.direction();
        ASSERT_LE(glm::distance(inMargin, frame.toOuter(ball.centre)), ball.radius) << "trial " << trial;
    }
}

TEST(BinBody, IsBoundlessOnFlatEllipsoids) {
    const GeodeticBin bin({0.1, 0.2}, {0.1, 0.2}, {0.0, 1.0});
    const auto reachOf = [&](double polarRadius, double margin) {
        return core::BinBody(Ellipsoid(6e6, polarRadius), bin, margin, core::Frame()).quarters().front().reach;
    };
    EXPECT_TRUE(std::isinf(reachOf(5e6, 0.0)));
    EXPECT_DOUBLE_EQ(reachOf(6e6, 7.0), reachOf(6e6, 0.0) + 7.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
