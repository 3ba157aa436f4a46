// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Camera.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <cstdint>

namespace osgAnalyticBin::paper {

namespace {

/// Gives the same sequence on every machine, one a stream.
/// Source: [SLF], SplitMix64.
class SeededRandom final {
public:
    explicit SeededRandom(std::uint64_t stream) noexcept : _state(1) {
        _state = bits() ^ (stream * 0xD1342543DE82EF95u);
    }

    /// In [lower, upper).
    [[nodiscard]] double uniform(double lower, double upper) noexcept {
        return lower + (upper - lower) * static_cast<double>(bits() >> 11) * 0x1p-53;
    }

    /// Every order of magnitude between the two is equally likely. Requires: 0 < lower <= upper.
    [[nodiscard]] double logUniform(double lower, double upper) noexcept {
        return lower * std::exp(uniform(0.0, 1.0) * std::log(upper / lower));
    }

private:
    [[nodiscard]] std::uint64_t bits() noexcept {
        _state += 0x9E3779B97F4A7C15u;
        std::uint64_t z = _state;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

    std::uint64_t _state;
};

core::Plane through(const glm::dvec3& inward, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::normalize(inward);
    return {normal, -glm::dot(normal, point)};
}

// Looks along an azimuth (degrees, clockwise from north), so much below the horizontal.
Camera cameraAt(const core::Ellipsoid& ellipsoid, const core::Geodetic& position, double azimuthDeg, double pitchDeg,
                double fovDeg) {
    const double azimuth = glm::radians(azimuthDeg);
    const double pitch = -glm::radians(pitchDeg);
    const glm::dvec3 radial(std::cos(position.longitude), std::sin(position.longitude), 0.0);
    const glm::dvec3 axis(0.0, 0.0, 1.0);
    const glm::dvec3 east = glm::cross(axis, radial);
    const glm::dvec3 north = std::cos(position.latitude) * axis - std::sin(position.latitude) * radial;
    const glm::dvec3 zenith = std::cos(position.latitude) * radial + std::sin(position.latitude) * axis;
    const glm::dvec3 level = std::sin(azimuth) * east + std::cos(azimuth) * north;
    const glm::dvec3 forward = std::cos(pitch) * level + std::sin(pitch) * zenith;
    const glm::dvec3 right = glm::normalize(glm::cross(level, zenith));
    return {ellipsoid.toEcef(position), forward, right, glm::cross(right, forward), fovDeg};
}

}  // namespace

std::array<core::Plane, 4> Camera::planes() const noexcept {
    const double half = std::tan(glm::radians(0.5 * fovDeg));
    return {through(right + kAspect * half * forward, eye), through(-right + kAspect * half * forward, eye),
            through(up + half * forward, eye), through(-up + half * forward, eye)};
}

Camera randomCamera(Terrain& terrain, std::size_t kind, std::size_t number) {
    const ViewKind& view = kViewKinds[kind];
    SeededRandom random(kViewKinds.size() * number + kind);
    const osgbindem::RectDeg extent = terrain.extent();
    // Equal areas are equally likely.
    const double sine = random.uniform(std::sin(glm::radians(extent.south)), std::sin(glm::radians(extent.north)));
    const double longitude = glm::radians(random.uniform(extent.west, extent.east));
    core::Geodetic position = terrain.onSurface({std::asin(sine), longitude, 0.0});
    position.altitude += random.logUniform(view.lowest, view.highest);
    const double azimuthDeg = random.uniform(0.0, 360.0);
    return cameraAt(terrain.ellipsoid(), position, azimuthDeg, random.uniform(view.pitchFrom, view.pitchTo),
                    view.fovDeg);
}

}  // namespace osgAnalyticBin::paper
