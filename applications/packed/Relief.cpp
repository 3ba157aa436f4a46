// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Relief.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace osgAnalyticBin {

namespace {

struct SnowStop {
    double latitudeDeg;
    double height;
};

// The snow line is highest in the dry belts. The southern hemisphere is colder from the middle latitudes on.
constexpr std::array<SnowStop, 11> kSnow{{{-90.0, -500.0},
                                          {-66.0, -500.0},
                                          {-60.0, 300.0},
                                          {-45.0, 2000.0},
                                          {-30.0, 5200.0},
                                          {-18.0, 5600.0},
                                          {0.0, 4900.0},
                                          {25.0, 5700.0},
                                          {36.0, 5500.0},
                                          {47.0, 2900.0},
                                          {62.0, 1500.0}}};
constexpr std::array<SnowStop, 4> kArcticSnow{{{62.0, 1500.0}, {70.0, 800.0}, {80.0, 200.0}, {90.0, -500.0}}};

template <std::size_t Count>
double between(const std::array<SnowStop, Count>& stops, double latitudeDeg) {
    std::size_t i = 1;
    while (i + 1 < Count && stops[i].latitudeDeg < latitudeDeg) ++i;
    const double share = (latitudeDeg - stops[i - 1].latitudeDeg) / (stops[i].latitudeDeg - stops[i - 1].latitudeDeg);
    return stops[i - 1].height + std::clamp(share, 0.0, 1.0) * (stops[i].height - stops[i - 1].height);
}

}  // namespace

double snowLine(double latitudeDeg) noexcept {
    return latitudeDeg < kSnow.back().latitudeDeg ? between(kSnow, latitudeDeg) : between(kArcticSnow, latitudeDeg);
}

double snowShare(double height, double snowLine, const glm::dvec3& normalLocal) noexcept {
    constexpr double kFringe = 700.0;
    if (height <= 0.0 || height <= snowLine - 0.5 * kFringe) return 0.0;
    const double share = glm::smoothstep(0.0, 1.0, (height - snowLine + 0.5 * kFringe) / kFringe);
    return share * (0.4 + 0.6 * glm::smoothstep(0.0, 1.0, (normalLocal.z - 0.5) / 0.35));
}

double exaggerationFor(double spacing) noexcept {
    constexpr double kTrue = 100.0;
    return std::clamp(std::sqrt(std::sqrt(spacing / kTrue)) * 1.3, 1.0, 5.0);
}

double shadeOf(const glm::dvec3& normalLocal, double exaggeration) noexcept {
    // From the north-west, 45 degrees high. Slopes towards the light shine less than those away from it lie in the
    // dark.
    constexpr float kLight = 0.70710678F;
    constexpr float kDarkest = 0.35F;
    constexpr float kBrightest = 1.3F;
    // Single precision is enough for a colour.
    const auto east = static_cast<float>(exaggeration * normalLocal.x);
    const auto north = static_cast<float>(exaggeration * normalLocal.y);
    const auto up = std::max(static_cast<float>(normalLocal.z), 1e-3F);
    const float shade = (kLight * (north - east) + up) / std::sqrt(east * east + north * north + up * up);
    return static_cast<double>(std::clamp(shade < 1.0F ? shade : 1.0F + 0.7F * (shade - 1.0F), kDarkest, kBrightest));
}

const std::vector<TerrainGrid::ColourStop>& hypsometricStops() {
    // The coast is a step, so that it shows. High ground is bare: snow depends on the latitude too, and comes on top.
    static const std::vector<TerrainGrid::ColourStop> stops{
        {-11000.0F, {6, 18, 58}},   {-6000.0F, {14, 44, 104}},  {-3500.0F, {24, 70, 138}}, {-1500.0F, {44, 104, 166}},
        {-200.0F, {96, 158, 196}},  {-0.5F, {146, 196, 214}},   {0.0F, {74, 120, 66}},     {150.0F, {98, 140, 74}},
        {500.0F, {148, 164, 92}},   {1000.0F, {184, 172, 112}}, {2000.0F, {172, 140, 94}}, {3200.0F, {146, 116, 86}},
        {4500.0F, {152, 132, 112}}, {6500.0F, {172, 162, 152}}};
    return stops;
}

}  // namespace osgAnalyticBin
