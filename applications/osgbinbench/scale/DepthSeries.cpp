// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Angles.h"
#include "Failure.h"
#include "Series.h"

#include <ProceduralTerrain.h>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

namespace osgAnalyticBin::scale {

namespace {

using support::kPi;
using support::kRadiansPerDegree;
constexpr double kMetresPerDegree = 111195.0;
constexpr osgbindem::PositionDeg kStart{46.0, 10.0};
constexpr double kHighest = 1e7;  // metres above the terrain

core::Geodetic above(const globe::ProceduralTerrain& terrain, const osgbindem::PositionDeg& at, double metres) {
    return {at.latitudeDeg * kRadiansPerDegree, at.longitudeDeg * kRadiansPerDegree, terrain.height(at) + metres};
}

using Scenes = std::vector<std::unique_ptr<ScaleScene>>;

}  // namespace

std::vector<flight::CameraPose> descent(const globe::GlobeOptions& options, int poses) {
    constexpr double kSlant = 2.5;         // metres ahead for each metre up
    constexpr double kFarthestDeg = 20.0;  // but no further round the globe
    constexpr double kFovDeg = 60.0;
    // In front of the camera the line of sight meets the ground within a few tiles of the deepest level.
    const double tile = std::ldexp(osgbindem::TileLayout::kStartTileDeg, -options.levels) * kMetresPerDegree;
    const globe::ProceduralTerrain terrain(options.relief);
    std::vector<flight::CameraPose> path;
    for (int i = 0; i < poses; ++i) {
        const double metres = kHighest * std::pow(0.5 * tile / kHighest, static_cast<double>(i) / (poses - 1));
        const double ahead = std::min(kFarthestDeg, kSlant * metres / kMetresPerDegree);
        path.push_back({"descent_" + std::to_string(i), above(terrain, kStart, metres),
                        above(terrain, {kStart.latitudeDeg + ahead, kStart.longitudeDeg}, 0.0),
                        kFovDeg * kRadiansPerDegree, 0.1 * metres, 100.0 * kHighest});
    }
    return path;
}

std::vector<DepthRow> measureDepth(const Settings& settings) {
    Scenes scenes;
    std::vector<DepthRow> rows;
    std::vector<std::vector<flight::CameraPose>> paths;
    for (const int levels : settings.levels) {
        globe::GlobeOptions options;
        options.levels = levels;
        options.cells = settings.cells;
        for (const ScaleMethod& method : settings.methods) {
            scenes.push_back(std::make_unique<ScaleScene>(method, options));
            paths.push_back(descent(options, settings.poses));
            rows.push_back({levels, method.name, {}, 0.0, 0.0});
        }
    }
    for (int pose = 0; pose < settings.poses; ++pose) {
        std::cerr << "osgbinbench scale: depth, pose " << pose + 1 << " of " << settings.poses << std::endl;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            scenes[i]->settle(paths[i][static_cast<std::size_t>(pose)]);
            if (scenes[i]->method().replaysVerdicts) scenes[i]->replay();
            rows[i].tiles.add(scenes[i]->tally());
        }
        const auto times = measuredInTurns(scenes, settings.rounds, [](ScaleScene& scene) { return scene.cullMs(); });
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            rows[i].cullMs += times[i].ms;
            rows[i].cullSpreadMs += times[i].spread;
        }
    }
    return rows;
}

}  // namespace osgAnalyticBin::scale
