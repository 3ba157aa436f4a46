// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ProceduralTerrain.h"

#include "Angles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::globe {

namespace {

using support::kPi;
using support::kRadiansPerDegree;

constexpr double kLongestWave = 5.0e6;  // metres
constexpr double kRadius = 6.37e6;      // metres, for the length of waves alone
constexpr double kLacunarity = 1.6;
// Amplitudes fall a little more slowly than wave lengths: finer slopes are steeper.
constexpr double kPersistence = 0.6866;

core::Interval sineOver(double from, double to) {
    core::Interval range{std::min(std::sin(from), std::sin(to)), std::max(std::sin(from), std::sin(to))};
    const auto holds = [&](double angle) {
        return std::floor((to - angle) / (2.0 * kPi)) > std::floor((from - angle) / (2.0 * kPi));
    };
    if (holds(0.5 * kPi)) range.upper = 1.0;
    if (holds(-0.5 * kPi)) range.lower = -1.0;
    return range;
}

}  // namespace

ProceduralTerrain::ProceduralTerrain(double relief) noexcept : _middle(0.5 * relief) {
    constexpr double kGoldenAngle = 2.399963229728653;
    double sum = 0.0;
    double share = 1.0;
    double frequency = 2.0 * kPi * kRadius / kLongestWave;
    for (std::size_t i = 0; i < kWaves; ++i) {
        // Directions spread over the sphere, in an order without neighbours.
        const double place = (static_cast<double>((i * 12 + 5) % kWaves) + 0.5) / kWaves;
        const double z = 1.0 - 2.0 * place;
        const double ring = std::sqrt(1.0 - z * z);
        const double angle = kGoldenAngle * static_cast<double>(i);
        _waves[i] = {{ring * std::cos(angle), ring * std::sin(angle), z}, frequency, angle, share};
        sum += share;
        share *= kPersistence;
        frequency *= kLacunarity;
    }
    for (Wave& wave : _waves) wave.amplitude *= _middle / sum;
}

double ProceduralTerrain::height(const tiles::PositionDeg& position) const noexcept {
    const double latitude = position.latitudeDeg * kRadiansPerDegree;
    const double longitude = position.longitudeDeg * kRadiansPerDegree;
    const glm::dvec3 up(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                        std::sin(latitude));
    double height = _middle;
    for (const Wave& wave : _waves)
        height += wave.amplitude * std::sin(wave.frequency * glm::dot(wave.direction, up) + wave.phase);
    return height;
}

core::Interval ProceduralTerrain::heightsIn(const tiles::RectDeg& rect) const noexcept {
    // Of rounding: sines of arguments up to 1e7, and all sums.
    constexpr double kRounding = 1e-6;
    const core::GeodeticBin directions =
        core::GeodeticBin::fromDegrees({rect.south, rect.north}, {rect.west, rect.east}, {0.0, 0.0});
    const core::ExactGeodeticBin patch(core::Ellipsoid(1.0, 1.0), directions, 0.0);
    core::Interval heights{_middle - kRounding, _middle + kRounding};
    for (const Wave& wave : _waves) {
        const core::Interval along = patch.distanceRange({wave.direction, 0.0});
        const core::Interval sine =
            sineOver(wave.frequency * along.lower + wave.phase, wave.frequency * along.upper + wave.phase);
        heights.lower += wave.amplitude * sine.lower;
        heights.upper += wave.amplitude * sine.upper;
    }
    return heights;
}

double ProceduralTerrain::interpolationError(double spacing) const noexcept {
    double error = 0.0;
    for (const Wave& wave : _waves) {
        // The second derivative along a circle of the sphere: of the wave, and of the circle.
        const double along = wave.frequency * spacing;
        error += wave.amplitude * std::min(2.0, 0.125 * (along * along + along * spacing));
    }
    return error;
}

}  // namespace osgAnalyticBin::globe
