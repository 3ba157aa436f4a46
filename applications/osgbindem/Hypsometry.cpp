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

// The coast is a step, so that it shows.
constexpr std::array<Stop, 14> kStops{{{-11000.0, 8, 16, 60},
                                       {-6000.0, 16, 44, 110},
                                       {-3000.0, 30, 82, 156},
                                       {-1000.0, 62, 124, 190},
                                       {-200.0, 110, 168, 214},
                                       {-0.5, 160, 206, 232},
                                       {0.0, 92, 142, 84},
                                       {200.0, 122, 164, 92},
                                       {500.0, 168, 186, 112},
                                       {1000.0, 202, 190, 128},
                                       {2000.0, 176, 142, 96},
                                       {3000.0, 142, 108, 82},
                                       {4500.0, 196, 188, 182},
                                       {6500.0, 250, 250, 250}}};

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
