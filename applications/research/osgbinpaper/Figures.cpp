// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Figures.h"

#include "Angles.h"

#include <algorithm>
#include <iostream>

namespace osgAnalyticBin::paper {

namespace {

using support::kRadiansPerDegree;
constexpr double kFovDeg = 50.0;

struct Stand {
    double latitudeDeg, longitudeDeg, altitude, azimuthDeg, pitchDeg;
};

// Of a globe: over the Ligurian Sea, with the Alps before it. Else south of the raster, looking across it.
Stand standFor(const Terrain& terrain) {
    const osgbindem::RectDeg extent = terrain.extent();
    if (extent.east - extent.west >= 360.0) return {42.6, 8.2, 1.6e5, 10.0, 28.0};
    constexpr double kMetresPerDegree = 1.11e5;
    const double height = extent.north - extent.south;
    return {extent.south - 0.1 * height, 0.5 * (extent.west + extent.east), 0.5 * height * kMetresPerDegree, 0.0, 38.0};
}

core::Geodetic positionOf(const Stand& stand) {
    return {std::max(stand.latitudeDeg, -90.0) * kRadiansPerDegree, stand.longitudeDeg * kRadiansPerDegree,
            stand.altitude};
}

}  // namespace

FigureScene::FigureScene(Terrain& terrainSeen, double factor)
    : terrain(terrainSeen),
      eye(positionOf(standFor(terrain))),
      azimuthDeg(standFor(terrain).azimuthDeg),
      pitchDeg(standFor(terrain).pitchDeg),
      camera(cameraAt(terrain.ellipsoid(), eye, azimuthDeg, pitchDeg, kFovDeg)),
      tree(terrain, camera, factor),
      frustum(camera),
      verdicts(tree.tiles.size(), Verdict::Untested) {
    cull(tree, frustum, Method::Quadratic, verdicts);
}

void drawFigures(const Gnuplot& gnuplot, Terrain& terrain, double factor, const Results& results, Progress& progress) {
    constexpr std::size_t kFigures = 7;
    const FigureScene scene(terrain, factor);
    std::size_t done = 0;
    for (const auto draw :
         {drawBinFigure, drawFrustumFigure, drawStartTilesFigure, drawRecursionFigure, drawTerrainFigure}) {
        progress.show("figures", done++, kFigures);
        draw(gnuplot, scene);
    }
    for (const Method method : {Method::Corners, Method::Paper}) {
        progress.show("figures", done++, kFigures);
        const auto& worst = results.worst[indexOf(method)];
        if (worst) {
            drawWrongCullFigure(gnuplot, terrain.ellipsoid(), method, *worst);
        } else {
            std::cerr << "osgbinpaper: no wrong cull by " << kMethodNames[indexOf(method)]
                      << " to draw; take more --cameras\n";
        }
    }
    progress.finish();
}

}  // namespace osgAnalyticBin::paper
