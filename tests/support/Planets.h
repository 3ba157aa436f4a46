// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <ostream>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

/// A globe; radii in metres.
struct Planet {
    const char* name;
    double equatorialRadius, polarRadius;

    /// Units to a metre in which tests run: metres, kilometres and equatorial radii.
    [[nodiscard]] std::array<double, 3> units() const { return {1.0, 1e-3, 1.0 / equatorialRadius}; }
    [[nodiscard]] core::Ellipsoid in(double unit) const { return {equatorialRadius * unit, polarRadius * unit}; }
};

/// Found by GoogleTest.
inline std::ostream& operator<<(std::ostream& out, const Planet& planet) {
    return out << planet.name;
}

/// From Phobos to Saturn, with an oblate and a prolate extreme.
inline constexpr std::array<Planet, 9> kPlanets{{{"Moon", 1738100.0, 1736000.0},
                                                 {"Earth", 6378137.0, 6356752.3142},
                                                 {"Mars", 3396190.0, 3376200.0},
                                                 {"Jupiter", 71492000.0, 66854000.0},
                                                 {"Saturn", 60268000.0, 54364000.0},
                                                 {"Vesta", 285000.0, 229000.0},
                                                 {"Phobos", 11080.0, 11080.0},
                                                 {"Half", 6378137.0, 0.5 * 6378137.0},
                                                 {"Egg", 3189068.5, 6378137.0}}};

/// Flatter and longer than any planet, to the ends of what is promised.
inline constexpr std::array<Planet, 6> kFlatPlanets{{{"TwoFifths", 6378137.0, 0.4 * 6378137.0},
                                                     {"Fifth", 6378137.0, 0.2 * 6378137.0},
                                                     {"Plate", 6378137.0, 0.05 * 6378137.0},
                                                     {"Disk", 6378137.0, 0.01 * 6378137.0},
                                                     {"Rod", 0.2 * 6378137.0, 6378137.0},
                                                     {"Needle", 0.1 * 6378137.0, 6378137.0}}};

/// A bin as on the earth, with altitudes in proportion to the globe.
[[nodiscard]] inline core::GeodeticBin randomBinOn(const core::Ellipsoid& ellipsoid, Random& random) {
    const core::GeodeticBin bin = randomBin(random);
    const double scale = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius()) / 6356752.0;
    return bin.withAltitude({bin.altitude().lower * scale, bin.altitude().upper * scale});
}

}  // namespace osgAnalyticBin::test
