// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Camera.h"

#include "Angles.h"
#include "SeededRandom.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

using support::kRadiansPerDegree;

core::Plane through(const glm::dvec3& inward, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::normalize(inward);
    return {normal, -glm::dot(normal, point)};
}

}  // namespace

double Camera::tangent() const noexcept {
    return std::tan(0.5 * fovDeg * kRadiansPerDegree);
}

std::array<core::Plane, 4> Camera::planes() const noexcept {
    const double half = tangent();
    return {through(right + kAspect * half * forward, eye), through(-right + kAspect * half * forward, eye),
            through(up + half * forward, eye), through(-up + half * forward, eye)};
}

std::array<glm::dvec3, 4> Camera::edges() const noexcept {
    const glm::dvec3 x = kAspect * tangent() * right;
    const glm::dvec3 y = tangent() * up;
    return {forward - x - y, forward + x - y, forward + x + y, forward - x + y};
}

Camera cameraAt(const core::Ellipsoid& ellipsoid, const core::Geodetic& position, double azimuthDeg, double pitchDeg,
                double fovDeg) noexcept {
    const CameraAxes axes = cameraAxes(position, azimuthDeg * kRadiansPerDegree, -pitchDeg * kRadiansPerDegree);
    Camera camera;
    camera.eye = ellipsoid.toEcef(position);
    camera.forward = axes.forward;
    camera.right = axes.right;
    camera.up = axes.up;
    camera.fovDeg = fovDeg;
    return camera;
}

Camera randomCamera(Terrain& terrain, std::size_t kind, std::size_t number, std::uint64_t seed) {
    const ViewKind& view = kViewKinds[kind];
    SeededRandom random(seed, kViewKinds.size() * number + kind);
    const osgbindem::RectDeg extent = terrain.extent();
    // Equal areas are equally likely.
    const double sine =
        random.uniform(std::sin(extent.south * kRadiansPerDegree), std::sin(extent.north * kRadiansPerDegree));
    const double longitude = random.uniform(extent.west, extent.east) * kRadiansPerDegree;
    core::Geodetic position = terrain.onSurface({std::asin(sine), longitude, 0.0});
    position.altitude += random.logUniform(view.lowest, view.highest);
    const double azimuthDeg = random.uniform(0.0, 360.0);
    return cameraAt(terrain.ellipsoid(), position, azimuthDeg, random.uniform(view.pitchFrom, view.pitchTo),
                    view.fovDeg);
}

}  // namespace osgAnalyticBin::paper
