// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Angles.h"
#include "BinLines.h"
#include "Figures.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

using support::kDegreesPerRadian;
// Drawn to scale, the highest terrain is as thin as the line.
constexpr double kExaggeration = 100.0;

core::GeodeticBin highestStartTile(const HeightPyramid& pyramid) {
    core::GeodeticBin highest = pyramid.bin({0, 0, 0});
    for (int y = 0; y < TileId::kStartRows; ++y) {
        for (int x = 0; x < TileId::kStartColumns; ++x) {
            const core::GeodeticBin bin = pyramid.bin({0, x, y});
            if (bin.altitude().upper > highest.altitude().upper) highest = bin;
        }
    }
    return highest;
}

std::string rangeText(double lower, double upper, int count) {
    return "[" + withDecimals(lower, count) + ":" + withDecimals(upper, count) + "]";
}

}  // namespace

void drawBinFigure(const Gnuplot& gnuplot, const FigureScene& scene) {
    const core::GeodeticBin bin = highestStartTile(scene.terrain.pyramid());
    const core::GeodeticMapping mapping(scene.terrain.ellipsoid());
    const SharePoint inAngles = [&](const glm::dvec3& shares) {
        const core::Geodetic p = positionIn(bin, shares);
        return glm::dvec3(p.longitude * kDegreesPerRadian, p.latitude * kDegreesPerRadian, p.altitude * 1e-3);
    };
    const SharePoint inSpace = [&](const glm::dvec3& shares) {
        const core::Geodetic p = positionIn(bin, shares);
        return mapping.value({p.latitude, p.longitude, kExaggeration * p.altitude}) * 1e-6;
    };
    PlotScript script;
    script.addBlock("$boxGrid", binGrid(inAngles, 6));
    script.addBlock("$boxEdges", binEdges(inAngles));
    script.addBlock("$slabGrid", binGrid(inSpace, 6));
    script.addBlock("$slabEdges", binEdges(inSpace));
    script.addBlock("$center", {{inAngles(glm::dvec3(0.5))}});
    script.addBlock("$slabCenter", {{inSpace(glm::dvec3(0.5))}});
    const double middleDeg = bin.longitude().middle() * kDegreesPerRadian;
    const std::string grid = std::string(" with lines lw 1 lc rgb '") + colour::kGrey + "'";
    const std::string edges = std::string(" with lines lw 2.5 lc rgb '") + colour::kBlue + "'";
    const std::string point = std::string(" with points pt 7 ps 1.3 lc rgb '") + colour::kRed + "'";
    script << R"(set multiplot
set xyplane at 0
unset key
set origin 0.02,0.08
set size 0.48,0.84
set view 62,32,1.05
set xtics 5 offset 0,-0.3
set ytics 5
set ztics 2
set xlabel 'longitude (deg)' offset 0,-0.5
set ylabel 'latitude (deg)' offset 1,-0.5
set zlabel 'altitude (km)' rotate offset 1,0
set label 1 'The bin as it is given: a box' at screen 0.26,0.95 center)"
           << "set zrange " + rangeText(bin.altitude().lower * 1e-3 - 0.01, 1.1 * bin.altitude().upper * 1e-3, 3)
           << "splot $boxGrid" + grid + ", $boxEdges" + edges + ", $center" + point;
    script << R"(set origin 0.52,0.08
set size 0.48,0.84
set view equal xyz
set autoscale z
set xyplane relative 0
set tics 1
set xlabel 'x (1000 km)'
set ylabel 'y (1000 km)'
set zlabel 'z (1000 km)')"
           << "set view 68," + withDecimals(std::fmod(middleDeg + 90.0 - 35.0 + 720.0, 360.0), 1) + ",1.15"
           << "set label 1 'Mapped to ECEF: a curved slab (altitude x " + withDecimals(kExaggeration, 0) +
                  ")' at screen 0.76,0.95 center"
           << "splot $slabGrid" + grid + ", $slabEdges" + edges + ", $slabCenter" + point;
    script.addKey(0.09, {edges + " title 'the bin'", point + " title 'its centre'"});
    gnuplot.draw("figure1", 520, script);
}

}  // namespace osgAnalyticBin::paper
