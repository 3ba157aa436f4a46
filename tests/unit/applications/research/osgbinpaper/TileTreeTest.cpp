// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Heights of tiles against samples of the raster, the recursion, and the two proofs that verdicts are set against. The
// proofs come from different code: a plane between tile and frustum from the core, a point in both from sampling.

#include "TestGlobe.h"
#include "TileTree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <support/Random.h>

namespace osgAnalyticBin::paper {
namespace {

TileId tileAt(int level, double latitudeDeg, double longitudeDeg) {
    const double size = std::ldexp(22.5, -level);
    return {level, static_cast<int>((longitudeDeg + 180.0) / size), static_cast<int>((latitudeDeg + 90.0) / size)};
}

TEST(Terrain, EveryLevelHoldsTheHeightsAndTheLevelBelow) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(5);
    test::Random random(1);
    double start = 0.0, deep = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const double latitudeDeg = random.uniform(-90.0, 90.0);
        const double longitudeDeg = random.uniform(-180.0, 180.0);
        const double height = terrain.height({latitudeDeg, longitudeDeg});
        for (int level = 0; level <= 5; ++level) {
            const core::Interval& range = terrain.heights(tileAt(level, latitudeDeg, longitudeDeg));
            EXPECT_GE(range.lower, 0.0) << "the sea's surface";
            EXPECT_TRUE(range.contains({height, height})) << latitudeDeg << ' ' << longitudeDeg;
            if (level == 5) continue;
            EXPECT_TRUE(range.contains(terrain.heights(tileAt(level + 1, latitudeDeg, longitudeDeg)))) << level;
        }
        start += terrain.heights(tileAt(0, latitudeDeg, longitudeDeg)).width();
        deep += terrain.heights(tileAt(5, latitudeDeg, longitudeDeg)).width();
    }
    EXPECT_GT(start / 5000.0, 2000.0) << "there were hills to hold";
    EXPECT_LT(deep, 0.5 * start);
}

TEST(Terrain, OutsideOfTheRasterItIsFlat) {
    const TestGlobe cut(3.0, 50.0, 60, 40, 0.1);
    const Terrain terrain = cut.terrain(5);
    for (const TileId& tile : {tileAt(0, 0.0, -60.0), tileAt(5, 0.0, -60.0), tileAt(5, 56.0, 12.0)})
        EXPECT_EQ(terrain.heights(tile), (core::Interval{0.0, 0.0}));
    EXPECT_GT(terrain.heights(tileAt(5, 52.0, 6.0)).width(), 0.0);
    EXPECT_NEAR(terrain.extent().west, 3.0, 1e-9);
    EXPECT_NEAR(terrain.extent().north, 54.0, 1e-9);
}

class TileTreeTest : public testing::Test {
protected:
    template <class Function>
    void forTrees(const Function& function) {
        for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) {
            for (std::size_t number = 0; number < 2; ++number) {
                const Camera camera = randomCamera(_terrain, kind, number);
                function(TileTree(_terrain, camera), camera);
            }
        }
    }

    TestGlobe _globe;
    Terrain _terrain = _globe.terrain(5);
};

TEST_F(TileTreeTest, NoTileIsBothOutsideAndSeenAndAWitnessIsAPointOfTheTileInTheFrustum) {
    std::size_t outside = 0;
    std::size_t seen = 0;
    forTrees([&](const TileTree& tree, const Camera& camera) {
        for (const auto& tile : tree.tiles) {
            const auto found = findWitness(wgs84(), tile.box, camera);
            EXPECT_FALSE(tile.isOutside && found);
            outside += tile.isOutside ? 1U : 0U;
            seen += found ? 1U : 0U;
            if (!tile.witness) continue;
            EXPECT_TRUE(tile.box.contains(tile.witness->position));
            for (const core::Plane& plane : camera.planes())
                EXPECT_GE(plane.distance(wgs84().toEcef(tile.witness->position)), tile.witness->depth);
            EXPECT_GT(tile.witness->depth, 0.0);
        }
    });
    EXPECT_GT(outside, 1000U);
    EXPECT_GT(seen, 500U);
}

TEST_F(TileTreeTest, TerrainBehindTheGlobeIsNoWitness) {
    const Camera camera = cameraAt(wgs84(), {0.0, 0.0, 1e6}, 0.0, 90.0, 60.0);
    const core::GeodeticBin near = _terrain.bin({0, 8, 4});
    const core::GeodeticBin antipode = _terrain.bin({0, 0, 4});
    EXPECT_TRUE(findTerrainWitness(_terrain, near, camera));
    EXPECT_TRUE(findWitness(wgs84(), antipode, camera));
    EXPECT_FALSE(findTerrainWitness(_terrain, antipode, camera));
}

TEST_F(TileTreeTest, TheRecursionEndsAtOutsideAndAtInside) {
    std::size_t untested = 0;
    forTrees([&](const TileTree& tree, const Camera& camera) {
        for (std::size_t method = 0; method < kMethods; ++method) {
            const std::vector<Verdict> verdicts = cull(tree, Frustum(camera), static_cast<Method>(method));
            for (std::size_t i = 0; i < tree.tiles.size(); ++i) {
                EXPECT_TRUE(i >= TileTree::kStartTiles || isTested(verdicts[i]));
                for (std::size_t k = 0; k < 4 && !tree.tiles[i].isLeaf(); ++k) {
                    const Verdict child = verdicts[tree.tiles[i].firstChild + k];
                    if (verdicts[i] == Verdict::Straddling) {
                        EXPECT_TRUE(isTested(child));
                    } else if (isKept(verdicts[i])) {
                        EXPECT_EQ(child, Verdict::WithinInside);
                        ++untested;
                    } else {
                        EXPECT_EQ(child, Verdict::Untested);
                    }
                }
            }
        }
    });
    EXPECT_GT(untested, 100U);
}

}  // namespace
}  // namespace osgAnalyticBin::paper
