// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <TileLayout.h>
#include <array>

namespace osgAnalyticBin::globe {

/// Heights for the whole globe, the same at every call: a sum of plane waves through the sphere of directions, from
/// 5000 km down to 4 m long, longer ones higher. Continuous everywhere, poles and date line included.
/// Frame: geodetic latitude and longitude; metres above the ellipsoid.
/// Cost: one sine for each of the 31 waves.
class ProceduralTerrain final {
public:
    /// `relief`: metres; heights lie in 0 .. relief.
    explicit ProceduralTerrain(double relief) noexcept;

    [[nodiscard]] double height(const tiles::PositionDeg& position) const noexcept;

    /// Bounds of the heights in a rectangle, wave by wave: the narrower the rectangle, the tighter.
    /// Guarantee: holds every height; that of a part of a rectangle lies within that of the whole, up to a
    /// micrometre; tests: ProceduralTerrain.*.
    [[nodiscard]] core::Interval heightsIn(const tiles::RectDeg& rect) const noexcept;

    /// Upper bound in metres of how far heights between two posts of a meridian or parallel are from the straight
    /// line between those of the posts. `spacing`: radians.
    [[nodiscard]] double interpolationError(double spacing) const noexcept;

private:
    static constexpr std::size_t kWaves = 31;

    struct Wave {
        glm::dvec3 direction{0.0};  // unit
        double frequency = 0.0;     // radians for each radius
        double phase = 0.0;
        double amplitude = 0.0;
    };

    double _middle;
    std::array<Wave, kWaves> _waves;
};

}  // namespace osgAnalyticBin::globe
