// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Angles.h"
#include "Figures.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

constexpr const char* kPale = "#E8E8E8";
using support::kDegreesPerRadian;

std::string boxOf(const TileId& tile) {
    const osgbindem::RectDeg rect = tile.rect();
    return withDecimals(rect.west, 4) + " " + withDecimals(rect.south, 4) + " " + withDecimals(rect.east, 4) + " " +
           withDecimals(rect.north, 4);
}

// Tiles that the recursion ended at, by verdict.
std::vector<std::string> rowsOf(const FigureScene& scene, Verdict verdict) {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < scene.tree.tiles.size(); ++i) {
        const bool isEnd = scene.tree.tiles[i].isLeaf() || verdict != Verdict::Straddling;
        if (scene.verdicts[i] == verdict && isEnd) rows.push_back(boxOf(scene.tree.tiles[i].id));
    }
    return rows;
}

// Where a ray first meets the ellipsoid, in degrees. Returns: false where it misses.
bool meet(const FigureScene& scene, const glm::dvec3& direction, glm::dvec3& longitudeLatitude) {
    const core::Ellipsoid& ellipsoid = scene.terrain.ellipsoid();
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    const glm::dvec3 o = scene.camera.eye / radii;
    const glm::dvec3 d = direction / radii;
    const double b = glm::dot(o, d);
    const double discriminant = b * b - glm::dot(d, d) * (glm::dot(o, o) - 1.0);
    if (discriminant < 0.0) return false;
    const double t = (-b - std::sqrt(discriminant)) / glm::dot(d, d);
    const core::Geodetic p = ellipsoid.toGeodetic(scene.camera.eye + t * direction);
    longitudeLatitude = {p.longitude * kDegreesPerRadian, p.latitude * kDegreesPerRadian, 0.0};
    return t > 0.0;
}

// The border of the picture on the globe.
std::vector<Polyline> footprint(const FigureScene& scene) {
    constexpr int kCurveSteps = 200;
    std::vector<Polyline> lines(1);
    const auto edges = scene.camera.edges();
    for (std::size_t side = 0; side < 4; ++side) {
        for (int i = 0; i <= kCurveSteps; ++i) {
            const double share = static_cast<double>(i) / kCurveSteps;
            glm::dvec3 point(0.0);
            if (meet(scene, edges[side] + share * (edges[(side + 1) % 4] - edges[side]), point)) {
                lines.back().push_back(point);
            } else if (!lines.back().empty()) {
                lines.emplace_back();
            }
        }
    }
    return lines;
}

}  // namespace

void drawRecursionFigure(const Gnuplot& gnuplot, const FigureScene& scene) {
    PlotScript script;
    script.addRows("$outside", rowsOf(scene, Verdict::Outside));
    script.addRows("$straddling", rowsOf(scene, Verdict::Straddling));
    script.addRows("$inside", rowsOf(scene, Verdict::Inside));
    script.addRows("$within", rowsOf(scene, Verdict::WithinInside));
    script.addBlock("$footprint", footprint(scene));
    const double eastDeg = scene.eye.longitude * kDegreesPerRadian;
    const double northDeg = scene.eye.latitude * kDegreesPerRadian;
    script.addBlock("$eye", {{glm::dvec3(eastDeg, northDeg, 0.0)}});
    const std::string border = "fs solid 1 border lc rgb '#404040' lw 0.6 fc rgb '";
    const auto boxes = [&](const char* block, const char* fill) {
        return std::string(block) + " using (0.5*($1+$3)):(0.5*($2+$4)):1:3:2:4 with boxxyerror " + border + fill +
               "', ";
    };
    const auto entry = [&](const char* fill, const char* title) {
        return "with boxes " + border + fill + "' title '" + title + "'";
    };
    const std::string footprintStyle = "with lines lw 2.5 lc rgb 'black'";
    const std::string eyeStyle = "with points pt 7 ps 1.3 lc rgb 'black'";
    const std::string plot = "plot " + boxes("$outside", kPale) + boxes("$straddling", colour::kOrange) +
                             boxes("$inside", colour::kBlue) + boxes("$within", colour::kSky) +
                             "$footprint using 1:2 " + footprintStyle + ", $eye using 1:2 " + eyeStyle;
    script << R"(set multiplot
set xlabel 'longitude (deg)'
set ylabel 'latitude (deg)' offset 1,0
set tics out nomirror
set lmargin at screen 0.07
set rmargin at screen 0.53
set bmargin at screen 0.23
set tmargin at screen 0.91
set xrange [-180:180]
set yrange [-90:90]
set xtics 90
set ytics 45
unset key
set title 'The recursion on the whole globe')"
           << plot;
    script << R"(set lmargin at screen 0.60
set rmargin at screen 0.98
set xtics 5
set ytics 5
set title 'About the eye')"
           << "set xrange [" + withDecimals(eastDeg - 14.0, 2) + ":" + withDecimals(eastDeg + 18.0, 2) + "]"
           << "set yrange [" + withDecimals(northDeg - 6.0, 2) + ":" + withDecimals(northDeg + 20.0, 2) + "]" << plot;
    script.addKey(0.11, {entry(kPale, "outside"), entry(colour::kOrange, "straddling"), entry(colour::kBlue, "inside"),
                         entry(colour::kSky, "within inside: not tested"),
                         footprintStyle + " title 'border of the picture'", eyeStyle + " title 'eye'"});
    gnuplot.draw("figure4", 560, script);
}

}  // namespace osgAnalyticBin::paper
