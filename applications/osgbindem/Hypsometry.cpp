// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Hypsometry.h"

#include <algorithm>
#include <cmath>

namespace osgbindem {

namespace {

using Stop = osgAnalyticBin::TerrainGrid::ColourStop;

// The coast is a step, so that it shows. High ground is bare: snow depends on the latitude too, and comes on top.
constexpr std::array<Stop, 14> kStops{{{-11000.0F, {6, 18, 58}},
                                       {-6000.0F, {14, 44, 104}},
                                       {-3500.0F, {24, 70, 138}},
                                       {-1500.0F, {44, 104, 166}},
                                       {-200.0F, {96, 158, 196}},
                                       {-0.5F, {146, 196, 214}},
                                       {0.0F, {74, 120, 66}},
                                       {150.0F, {98, 140, 74}},
                                       {500.0F, {148, 164, 92}},
                                       {1000.0F, {184, 172, 112}},
                                       {2000.0F, {172, 140, 94}},
                                       {3200.0F, {146, 116, 86}},
                                       {4500.0F, {152, 132, 112}},
                                       {6500.0F, {172, 162, 152}}}};

}  // namespace

Rgb hypsometricColour(double height) noexcept {
    const double clamped = std::clamp<double>(height, kStops.front().height, kStops.back().height);
    std::size_t i = 1;
    while (i + 1 < kStops.size() && kStops[i].height < clamped) ++i;
    const Stop& a = kStops[i - 1];
    const Stop& b = kStops[i];
    const double share = (clamped - a.height) / (double{b.height} - a.height);
    Rgb colour{};
    for (std::size_t c = 0; c < colour.size(); ++c)
        colour[c] = static_cast<std::uint8_t>(std::lround(a.colour[c] + share * (b.colour[c] - a.colour[c])));
    return colour;
}

std::vector<osgAnalyticBin::TerrainGrid::ColourStop> hypsometricStops() {
    return {kStops.begin(), kStops.end()};
}

}  // namespace osgbindem
