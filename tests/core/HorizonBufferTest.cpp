// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Terrain that hides terrain. Oracle: rays through all triangles, in long double.

#include "OcclusionScene.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace osgAnalyticBin::test {
namespace {

using core::EarthColumn;
using core::GroundPlates;
using core::HorizonBuffer;
using core::Interval;

constexpr Interval kAcross{-1.0, 1.0};

HorizonBuffer bufferOf(const OcclusionScene& scene) {
    return {scene.eye, scene.forward, scene.up, kAcross};
}

// Columns of all cells, as deep as the tile is far.
void addTile(HorizonBuffer& buffer, const OcclusionScene& scene, const GroundTile& tile, std::size_t cells) {
    const GroundPlates plates(scene.ellipsoid, tile.mesh, tile.bin);
    const double depth =
        std::min(0.3 * glm::distance(scene.eye, tile.mesh.vertex(0)), 0.01 * scene.ellipsoid.equatorialRadius());
    for (std::size_t i = 0; i < cells * cells; ++i) {
        if (const auto column = plates.column(cells, i / cells, i % cells, depth)) buffer.add(*column);
    }
}

bool isBeforeTheCamera(const OcclusionScene& scene, const RealVector& point) {
    const RealVector from = point - real(scene.eye);
    const Real ahead = dot(from, real(scene.forward));
    const Real across = dot(from, real(glm::cross(scene.forward, scene.up)));
    return ahead > 0 && across >= kAcross.lower * ahead && across <= kAcross.upper * ahead;
}

// Tiles in the order in which they have to be asked for.
std::vector<std::pair<const GroundTile*, Body>> frontToBack(const OcclusionScene& scene, const HorizonBuffer& buffer) {
    std::vector<std::pair<const GroundTile*, Body>> sorted;
    for (const GroundTile& tile : scene.tiles) sorted.emplace_back(&tile, bodyOf(scene.ellipsoid, tile.bin));
    std::sort(sorted.begin(), sorted.end(), [&](const auto& a, const auto& b) {
        return buffer.nearest(a.second.corners, a.second.reach) < buffer.nearest(b.second.corners, b.second.reach);
    });
    return sorted;
}

constexpr int kRays = 24;

TEST(HorizonBuffer, HidesNothingThatARayReaches) {
    Random random(1700);
    int hidden = 0;
    for (int i = 0; i < 250; ++i) {
        const OcclusionScene scene(random);
        HorizonBuffer buffer = bufferOf(scene);
        const std::size_t cells = random.pick(std::array<std::size_t, 3>{2, 4, 8});
        for (const GroundTile& tile : scene.tiles) addTile(buffer, scene, tile, cells);
        for (const auto& [tile, body] : frontToBack(scene, buffer)) {
            if (!buffer.hides(body.corners, body.reach)) continue;
            ++hidden;
            for (int ray = 0; ray < 2 * kRays; ++ray) {
                const RealVector point = scene.pointIn(random, *tile);
                ASSERT_TRUE(!isBeforeTheCamera(scene, point) || scene.isBlocked(point)) << "scene " << i;
            }
        }
    }
    EXPECT_GT(hidden, 500);
}

TEST(HorizonBuffer, HidesMuchOfWhatNoRayReaches) {
    Random random(1705);
    int hidden = 0, unseen = 0;
    for (int i = 0; i < 100; ++i) {
        const OcclusionScene scene(random, false);
        HorizonBuffer buffer = bufferOf(scene);
        for (const GroundTile& tile : scene.tiles) addTile(buffer, scene, tile, 8);
        for (const auto& [tile, body] : frontToBack(scene, buffer)) {
            const bool isHidden = buffer.hides(body.corners, body.reach);
            bool isAhead = false, isSeen = false;
            for (int ray = 0; ray < kRays && !isSeen; ++ray) {
                const RealVector point = scene.topOf(random, *tile);
                if (!isBeforeTheCamera(scene, point)) continue;
                isAhead = true;
                isSeen = !scene.isBlocked(point);
            }
            if (!isAhead || isSeen) continue;
            ++unseen;
            hidden += isHidden;
        }
    }
    std::printf("%d bins whose tops no ray reaches, %d hidden\n", unseen, hidden);
    EXPECT_GT(hidden, unseen / 3);
}

TEST(HorizonBuffer, AnswersOnlyFrontToBack) {
    Random random(1706);
    int hidden = 0;
    while (hidden < 20) {
        const OcclusionScene scene(random);
        HorizonBuffer buffer = bufferOf(scene);
        for (const GroundTile& tile : scene.tiles) addTile(buffer, scene, tile, 8);
        const auto tiles = frontToBack(scene, buffer);
        const auto hiddenOne = std::find_if(tiles.begin(), tiles.end(), [&](const auto& tile) {
            return buffer.hides(tile.second.corners, tile.second.reach);
        });
        if (hiddenOne == tiles.end() || hiddenOne + 1 == tiles.end()) continue;
        ++hidden;
        // earth that is in the columns from now on may be behind what is nearer
        (void)buffer.hides(tiles.back().second.corners, tiles.back().second.reach);
        const double reach = hiddenOne->second.reach;
        if (buffer.nearest(hiddenOne->second.corners, reach) + reach <
            buffer.nearest(tiles.back().second.corners, 0.0) - tiles.back().second.reach) {
            EXPECT_FALSE(buffer.hides(tiles.front().second.corners, tiles.front().second.reach));
        }
    }
}

TEST(HorizonBuffer, LeavesOutWhatHasNoPlaceInThePicture) {
    const core::Ellipsoid earth = wgs84();
    const glm::dvec3 eye = earth.toEcef({0.0, 0.0, 1000.0});
    const glm::dvec3 north(0.0, 0.0, 1.0), up(1.0, 0.0, 0.0);
    const auto wall = [&](double from, double to) {
        EarthColumn column;
        for (std::size_t i = 0; i < 4; ++i) {
            column.top[i] = earth.toEcef({i < 2 ? from : to, i % 2 == 0 ? -0.01 : 0.01, 3000.0});
            column.bottom[i] = earth.toEcef({i < 2 ? from : to, i % 2 == 0 ? -0.01 : 0.01, -3000.0});
        }
        column.error = 1e-6;
        return column;
    };
    const Body behind = bodyOf(earth, core::GeodeticBin({0.005, 0.006}, {-0.001, 0.001}, {0.0, 500.0}));
    const Body behindTheEye = bodyOf(earth, core::GeodeticBin({-0.006, -0.005}, {-0.001, 0.001}, {0.0, 500.0}));
    const auto hides = [&](const EarthColumn& column, const Body& body) {
        HorizonBuffer buffer(eye, north, up, kAcross);
        buffer.add(column);
        return buffer.hides(body.corners, body.reach);
    };
    EXPECT_TRUE(hides(wall(0.002, 0.003), behind));
    EXPECT_FALSE(hides(wall(0.007, 0.008), behind));   // farther
    EXPECT_FALSE(hides(wall(0.002, 0.0056), behind));  // partly
    EXPECT_FALSE(hides(wall(-0.001, 0.003), behind));  // about the eye
    EXPECT_FALSE(hides(wall(-0.003, -0.002), behindTheEye));
    EarthColumn broken = wall(0.002, 0.003);
    broken.top[2].y = std::nan("");
    EXPECT_FALSE(hides(broken, behind));
    Body endless = behind;
    endless.reach = std::nan("");
    EXPECT_FALSE(hides(wall(0.002, 0.003), endless));
    Body nowhere = behind;
    nowhere.corners[5].z = std::nan("");
    EXPECT_FALSE(hides(wall(0.002, 0.003), nowhere));
    endless.reach = 1e9;
    EXPECT_FALSE(hides(wall(0.002, 0.003), endless));
}

}  // namespace
}  // namespace osgAnalyticBin::test
