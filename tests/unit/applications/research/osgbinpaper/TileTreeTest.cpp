// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The recursion, and the two proofs that verdicts are set against. The proofs come from different code: a plane between
// tile and frustum from the core, a point in both from sampling.

#include "TestGlobe.h"
#include "TileTree.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace osgAnalyticBin::paper {
namespace {

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

TEST_F(TileTreeTest, IsDividedNearTheEye) {
    forTrees([&](const TileTree& tree, const Camera& camera) {
        ASSERT_GE(tree.tiles.size(), 128U);
        std::size_t deepest = 0;
        for (std::size_t i = 0; i < tree.tiles.size(); ++i) {
            if (tree.tiles[i].id.level > tree.tiles[deepest].id.level) deepest = i;
            for (std::size_t child = 0; child < 4 && !tree.tiles[i].isLeaf(); ++child) {
                EXPECT_EQ(tree.tiles[tree.tiles[i].firstChild + child].id.ancestor(tree.tiles[i].id.level),
                          tree.tiles[i].id);
                EXPECT_TRUE(tree.tiles[i].box.contains(tree.tiles[tree.tiles[i].firstChild + child].box));
            }
        }
        const double width = tree.tiles[deepest].box.latitude().width() * 6.4e6;
        const glm::dvec3 center = wgs84().toEcef(tree.tiles[deepest].box.center());
        const double least = deepest >= TileTree::kStartTiles ? glm::distance(center, camera.eye) : 0.0;
        EXPECT_LT(least, 9.0 * width);
    });
}

TEST_F(TileTreeTest, NoTileIsBothOutsideAndSeen) {
    std::size_t outside = 0;
    std::size_t seen = 0;
    forTrees([&](const TileTree& tree, const Camera& camera) {
        for (std::size_t i = 0; i < tree.tiles.size(); ++i) {
            const auto witness = findWitness(wgs84(), tree.tiles[i].box, camera);
            EXPECT_FALSE(tree.tiles[i].isOutside && witness) << i;
            outside += tree.tiles[i].isOutside ? 1U : 0U;
            seen += witness ? 1U : 0U;
        }
    });
    EXPECT_GT(outside, 1000U);
    EXPECT_GT(seen, 500U);
}

TEST_F(TileTreeTest, AWitnessIsAPointOfTheTileInTheFrustum) {
    forTrees([&](const TileTree& tree, const Camera& camera) {
        for (std::size_t i = 0; i < tree.tiles.size(); ++i) {
            const auto& witness = tree.tiles[i].witness;
            if (!witness) continue;
            EXPECT_TRUE(tree.tiles[i].box.contains(witness->position));
            for (const core::Plane& plane : camera.planes())
                EXPECT_GE(plane.distance(wgs84().toEcef(witness->position)), witness->depth);
            EXPECT_GT(witness->depth, 0.0);
        }
    });
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

TEST(Camera, ARandomOneKeepsToItsKindAndItsNumber) {
    const TestGlobe globe;
    Terrain terrain = globe.terrain(0);
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) {
        for (std::size_t number = 0; number < 20; ++number) {
            const Camera camera = randomCamera(terrain, kind, number);
            const core::Geodetic position = wgs84().toGeodetic(camera.eye);
            const double above = position.altitude - terrain.onSurface(position).altitude;
            EXPECT_GE(above, kViewKinds[kind].lowest - 1e-3);
            EXPECT_LE(above, kViewKinds[kind].highest + 1e-3);
            EXPECT_EQ(camera.eye, randomCamera(terrain, kind, number).eye);
            EXPECT_NE(camera.eye, randomCamera(terrain, kind, number + 1).eye);
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::paper
