// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/AnalyticMapping.h>
#include <osgAnalyticBin/mappings/Vec3.h>

#include <cmath>

namespace osgAnalyticBin::test {

/// The formula of a height field in spherical Mercator, for AutodiffMapping: (easting, northing, altitude), all in
/// metres, to earth-centred coordinates on a sphere. A tile of a web map is a parameter box of it.
/// Source: doc/theory/mappings.md, section 6.
/// Guarantee: on tiles of zoom 4 and more the remainder is at most 2.5 times the model's error;
/// tests: MercatorHeightField.*.
class MercatorHeightField final {
public:
    /// Radius of the sphere, metres.
    explicit MercatorHeightField(double radius) noexcept : _radius(radius) {}

    /// The earth-centred point.
    template <class T>
    [[nodiscard]] core::Vec3<T> operator()(T easting, T northing, T altitude) const {
        using std::cos;
        using std::exp;
        using std::sin;
        const T longitude = easting / _radius;
        const T grown = exp(northing / _radius);
        // sin and cos of the latitude are tanh and 1 / cosh of northing / radius.
        const T cosLatitude = 2.0 / (grown + 1.0 / grown);
        const T sinLatitude = 1.0 - 2.0 / (grown * grown + 1.0);
        const T distance = altitude + _radius;
        return {distance * cosLatitude * cos(longitude), distance * cosLatitude * sin(longitude),
                distance * sinLatitude};
    }

    /// See AnalyticMapping; holds for every box.
    [[nodiscard]] double remainder(const core::ParameterBox& box) const noexcept;

private:
    double _radius;
};

}  // namespace osgAnalyticBin::test
