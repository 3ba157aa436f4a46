// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Plates of meshes that are grids of posts.

#include "MeshSamples.h"
#include "OcclusionScene.h"

#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace osgAnalyticBin::test {
namespace {

using core::EcefMesh;
using core::Ellipsoid;
using core::Geodetic;
using core::GeodeticBin;
using core::GroundPlates;

constexpr std::array<std::size_t, 4> kGrids{1, 2, 4, 8};

std::vector<double> boundsIn(const GroundPlates& plates) {
    std::vector<double> bounds;
    for (const std::size_t cells : kGrids) {
        for (std::size_t i = 0; i < cells * cells; ++i) bounds.push_back(plates.least(cells, i / cells, i % cells));
    }
    return bounds;
}

TEST(PostGrid, MakesThePlatesOfAMeshWithSkirts) {
    Random random(1715);
    const Ellipsoid earth = wgs84();
    for (const double size : {0.4, 0.01, 0.0005}) {
        const GeodeticBin extents({0.5, 0.5 + size}, {1.0, 1.0 + size}, {-300.0, 2000.0});
        const EcefMesh grid = gridMesh(random, earth, extents, 32);
        const EcefMesh skirted = withSkirts(earth, grid, 32, 0.01 * size * earth.polarRadius());
        const std::vector<double> bounds = boundsIn(GroundPlates(earth, skirted, extents));
        EXPECT_TRUE(std::isfinite(bounds.front()));
        EXPECT_EQ(bounds, boundsIn(GroundPlates(earth, grid, extents)));
        EXPECT_NE(bounds, boundsIn(GroundPlates(earth, unmerged(skirted), extents))) << "made in the same way";
        // a wall within the tile
        EcefMesh walled = skirted;
        for (const double latitude : {0.3, 0.7, 0.5})
            addVertex(walled, earth.toEcef(Geodetic{0.5 + latitude * size, 1.0 + 0.5 * size, 2500.0}));
        const auto last = static_cast<std::uint32_t>(walled.size());
        walled.triangles.insert(walled.triangles.end(), {last - 3, last - 2, last - 1});
        EXPECT_FALSE(std::isfinite(boundsIn(GroundPlates(earth, walled, extents)).front()));
    }
}

// A mesh with one triangle turned upside down, twice there, missing or across two cells is none of a grid.
TEST(PostGrid, IsNoneWhereATriangleIsWrong) {
    Random random(1714);
    const Ellipsoid earth = wgs84();
    const GeodeticBin extents({0.5, 0.51}, {1.0, 1.01}, {-300.0, 2000.0});
    const EcefMesh whole = gridMesh(random, earth, extents, 16);
    ASSERT_TRUE(std::isfinite(GroundPlates(earth, whole, extents).least(1, 0, 0)));
    const auto isWhole = [&](const std::function<void(std::vector<std::uint32_t>&)>& change) {
        EcefMesh mesh = whole;
        change(mesh.triangles);
        return std::isfinite(GroundPlates(earth, mesh, extents).least(1, 0, 0));
    };
    using Triangles = std::vector<std::uint32_t>;
    EXPECT_TRUE(isWhole([](Triangles& triangles) { triangles.insert(triangles.end(), {5, 5, 9}); }));
    EXPECT_FALSE(isWhole([](Triangles& triangles) { std::swap(triangles[3], triangles[4]); }));
    EXPECT_FALSE(isWhole([](Triangles& triangles) { std::copy_n(triangles.begin(), 3, triangles.begin() + 3); }));
    EXPECT_FALSE(isWhole([](Triangles& triangles) { triangles.resize(triangles.size() - 3); }));
    EXPECT_FALSE(isWhole([](Triangles& triangles) { triangles.insert(triangles.end(), {0, 2, 34}); }));
    // the southernmost posts, but for the corners, stand farther north
    EcefMesh shorter = whole;
    for (std::size_t i = 1; i < 16; ++i) {
        Geodetic place = earth.toGeodetic(whole.vertex(i));
        place.latitude += 0.05 * extents.latitude().width() / 16.0;
        const glm::dvec3 v = earth.toEcef(place);
        shorter.x[i] = v.x;
        shorter.y[i] = v.y;
        shorter.z[i] = v.z;
    }
    EXPECT_TRUE(std::isfinite(GroundPlates(earth, whole, extents).least(8, 0, 3)));
    EXPECT_FALSE(std::isfinite(GroundPlates(earth, shorter, extents).least(8, 0, 3)));
}

}  // namespace
}  // namespace osgAnalyticBin::test
