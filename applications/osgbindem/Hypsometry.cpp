// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Hypsometry.h"

#include <algorithm>
#include <cmath>

namespace osgbindem {

namespace {

struct Stop {
    double height;
    double red, green, blue;
};

// The coast is a step, so that it shows. High ground is bare: snow depends on the latitude too, and comes on top.
constexpr std::array<Stop, 14> kStops{{{-11000.0, 6, 18, 58},
                                       {-6000.0, 14, 44, 104},
                                       {-3500.0, 24, 70, 138},
                                       {-1500.0, 44, 104, 166},
                                       {-200.0, 96, 158, 196},
                                       {-0.5, 146, 196, 214},
                                       {0.0, 74, 120, 66},
                                       {150.0, 98, 140, 74},
                                       {500.0, 148, 164, 92},
                                       {1000.0, 184, 172, 112},
                                       {2000.0, 172, 140, 94},
                                       {3200.0, 146, 116, 86},
                                       {4500.0, 152, 132, 112},
                                       {6500.0, 172, 162, 152}}};

std::uint8_t mixed(double a, double b, double share) {
    return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
}

}  // namespace

Rgb hypsometricColour(double height) noexcept {
    const double clamped = std::clamp(height, kStops.front().height, kStops.back().height);
    std::size_t i = 1;
    while (i + 1 < kStops.size() && kStops[i].height < clamped) ++i;
    const Stop& a = kStops[i - 1];
    const Stop& b = kStops[i];
    const double share = (clamped - a.height) / (b.height - a.height);
    return {mixed(a.red, b.red, share), mixed(a.green, b.green, share), mixed(a.blue, b.blue, share)};
}

std::vector<osgAnalyticBin::TerrainGrid::ColourStop> hypsometricStops() {
    std::vector<osgAnalyticBin::TerrainGrid::ColourStop> stops;
    for (const Stop& stop : kStops)
        stops.push_back({static_cast<float>(stop.height),
                         {static_cast<std::uint8_t>(stop.red), static_cast<std::uint8_t>(stop.green),
                          static_cast<std::uint8_t>(stop.blue)}});
    return stops;
}

}  // namespace osgbindem
