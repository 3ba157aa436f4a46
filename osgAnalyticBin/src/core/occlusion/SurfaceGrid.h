// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Frame.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace osgAnalyticBin::core {

/// The largest |e²| of an ellipsoid for which the bounds of doc/theory/occlusion.md hold.
inline constexpr double kRoundest = 0.01;

/// Computes points at several latitudes and longitudes in the coordinates of a frame. It takes one sine and one cosine
/// for each latitude and longitude, and a few products for each point.
template <std::size_t Most>
class SurfaceGrid final {
public:
    /// Uses the first `count` latitudes and longitudes.
    SurfaceGrid(const Ellipsoid& ellipsoid, const std::array<double, Most>& latitudes,
                const std::array<double, Most>& longitudes, std::size_t count, const Frame& frame) noexcept
        : _axesRatio(ellipsoid.squaredRatio()),
          _polar(frame.x.z, frame.y.z, frame.z.z),
          _origin(glm::dot(frame.origin, frame.x), glm::dot(frame.origin, frame.y), glm::dot(frame.origin, frame.z)),
          _isPlane(ellipsoid.isPlane()) {
        if (_isPlane) {
            layOut(latitudes, longitudes, count, frame);
            return;
        }
        for (std::size_t i = 0; i < count; ++i) {
            _sinLat[i] = std::sin(latitudes[i]);
            _cosLat[i] = std::cos(latitudes[i]);
            _radius[i] = ellipsoid.primeVerticalRadius(_sinLat[i], _cosLat[i]);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const double cosLon = std::cos(longitudes[i]), sinLon = std::sin(longitudes[i]);
            _meridian[i] = {frame.x.x * cosLon + frame.x.y * sinLon, frame.y.x * cosLon + frame.y.y * sinLon,
                            frame.z.x * cosLon + frame.z.y * sinLon};
        }
    }

    /// The points of one latitude and altitude.
    struct Ring {
        double axisDistance;
        glm::dvec3 middle;  ///< on the globe's axis; in a map, where x is 0
    };
    /// [DERIVATION] section 1: ECEF of a geodetic position is rho (cos l, sin l, 0) + z (0, 0, 1).
    [[nodiscard]] Ring ring(std::size_t row, double altitude) const noexcept {
        if (_isPlane) return {1.0, _northing[row] + altitude * _polar - _origin};
        const double z = (_axesRatio * _radius[row] + altitude) * _sinLat[row];
        return {(_radius[row] + altitude) * _cosLat[row], z * _polar - _origin};
    }
    /// Returns: the point in the coordinates of the frame. Error: some 30 units in the last place of the longest of the
    /// vectors.
    [[nodiscard]] glm::dvec3 point(const Ring& ring, std::size_t column) const noexcept {
        return ring.axisDistance * _meridian[column] + ring.middle;
    }

private:
    void layOut(const std::array<double, Most>& latitudes, const std::array<double, Most>& longitudes,
                std::size_t count, const Frame& frame) noexcept {
        for (std::size_t i = 0; i < count; ++i) {
            const double x = Ellipsoid::kMapUnitsInRadian * longitudes[i];
            const double y = Ellipsoid::kMapUnitsInRadian * latitudes[i];
            _meridian[i] = x * glm::dvec3(frame.x.x, frame.y.x, frame.z.x);
            _northing[i] = y * glm::dvec3(frame.x.y, frame.y.y, frame.z.y);
        }
    }

    double _axesRatio;           // of the polar to the equatorial axis, squared
    glm::dvec3 _polar, _origin;  // the globe's axis and the frame's origin, along the frame's axes
    bool _isPlane;
    std::array<double, Most> _sinLat, _cosLat, _radius;
    std::array<glm::dvec3, Most> _northing;  // of a plane's rows, along the frame's axes
    std::array<glm::dvec3, Most> _meridian;  // the direction from the globe's axis, along the frame's axes
};

}  // namespace osgAnalyticBin::core
