// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Experiment.h"
#include "Gnuplot.h"

namespace osgAnalyticBin::paper {

/// One camera and what the quadratic bins made of its tiles: what the figures show.
struct FigureScene {
    /// Requires: the terrain outlives it.
    FigureScene(Terrain& terrain, double factor);

    Terrain& terrain;
    core::Geodetic eye;
    double azimuthDeg = 0.0;
    double pitchDeg = 0.0;
    Camera camera;
    TileTree tree;
    Frustum frustum;
    std::vector<Verdict> verdicts;
};

/// figure1: a bin in both of its coordinate systems.
void drawBinFigure(const Gnuplot& gnuplot, const FigureScene& scene);
/// figure2: a bin that straddles a side of the frustum, and the ranges of its distances to the sides.
void drawFrustumFigure(const Gnuplot& gnuplot, const FigureScene& scene);
/// figure3: the 128 start tiles and their heights.
void drawStartTilesFigure(const Gnuplot& gnuplot, const FigureScene& scene);
/// figure4: the recursion on a map.
void drawRecursionFigure(const Gnuplot& gnuplot, const FigureScene& scene);
/// figure5: the terrain of the tiles drawn, with their outlines.
void drawTerrainFigure(const Gnuplot& gnuplot, const FigureScene& scene);
/// wrong_cull_METHOD: the tile, the frustum and the witness. Requires: method is Corners or Paper.
void drawWrongCullFigure(const Gnuplot& gnuplot, const core::Ellipsoid& ellipsoid, Method method,
                         const WrongCull& wrong);

/// All of them; a wrong cull that the cameras did not meet is left out, with a line on stderr.
void drawFigures(const Gnuplot& gnuplot, Terrain& terrain, double factor, const Results& results, Progress& progress);

}  // namespace osgAnalyticBin::paper
