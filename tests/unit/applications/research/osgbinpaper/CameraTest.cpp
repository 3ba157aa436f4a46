// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Camera.h"
#include "TestGlobe.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::paper {
namespace {

TEST(Camera, EdgesLieOnTwoSidesAndInsideTheOthers) {
    const Camera camera = cameraAt(wgs84(), {0.7, -1.2, 5e4}, 70.0, 20.0, 60.0);
    for (const glm::dvec3& edge : camera.edges()) {
        std::array<double, 4> distances{};
        const auto planes = camera.planes();
        for (std::size_t i = 0; i < 4; ++i) distances[i] = planes[i].distance(camera.eye + 1e4 * edge);
        std::sort(distances.begin(), distances.end());
        EXPECT_NEAR(distances[0], 0.0, 1e-6);
        EXPECT_NEAR(distances[1], 0.0, 1e-6);
        EXPECT_GT(distances[2], 1e3);
    }
}

TEST(Camera, LooksWhereItIsTold) {
    const core::Geodetic position{0.7, -1.2, 5e4};
    const glm::dvec3 up = glm::normalize(wgs84().toEcef({0.7, -1.2, 1e6}) - wgs84().toEcef({0.7, -1.2, 0.0}));
    const Camera down = cameraAt(wgs84(), position, 0.0, 90.0, 60.0);
    EXPECT_NEAR(glm::dot(down.forward, up), -1.0, 1e-12);
    const Camera east = cameraAt(wgs84(), position, 90.0, 0.0, 60.0);
    EXPECT_NEAR(glm::dot(east.forward, glm::dvec3(-std::sin(-1.2), std::cos(-1.2), 0.0)), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(east.up, up), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(glm::cross(east.right, east.forward), east.up), 1.0, 1e-12);
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
