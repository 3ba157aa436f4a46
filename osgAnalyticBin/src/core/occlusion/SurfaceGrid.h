// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace osgAnalyticBin::core {

/// The largest |e²| of an ellipsoid for which the bounds of occlusion.md hold.
inline constexpr double kRoundest = 0.01;

/// Points at several latitudes and longitudes, with one sine and cosine for each of these.
template <std::size_t Rows, std::size_t Columns>
class SurfaceGrid final {
public:
    SurfaceGrid(const Ellipsoid& ellipsoid, const std::array<double, Rows>& latitudes,
                const std::array<double, Columns>& longitudes) noexcept
        : _axesRatio(ellipsoid.squaredRatio()) {
        for (std::size_t i = 0; i < Rows; ++i) {
            _sinLat[i] = std::sin(latitudes[i]);
            _cosLat[i] = std::cos(latitudes[i]);
            _radius[i] = ellipsoid.primeVerticalRadius(_sinLat[i], _cosLat[i]);
        }
        for (std::size_t i = 0; i < Columns; ++i) {
            _sinLon[i] = std::sin(longitudes[i]);
            _cosLon[i] = std::cos(longitudes[i]);
        }
    }

    /// [DERIVATION] section 1: ECEF of a geodetic position.
    [[nodiscard]] glm::dvec3 point(std::size_t row, std::size_t column, double altitude) const noexcept {
        const double rho = (_radius[row] + altitude) * _cosLat[row];
        return {rho * _cosLon[column], rho * _sinLon[column], (_axesRatio * _radius[row] + altitude) * _sinLat[row]};
    }

private:
    double _axesRatio;  // of the polar to the equatorial axis, squared
    std::array<double, Rows> _sinLat, _cosLat, _radius;
    std::array<double, Columns> _sinLon, _cosLon;
};

}  // namespace osgAnalyticBin::core
