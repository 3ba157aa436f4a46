// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinLines.h"
#include "Figures.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

constexpr std::array<const char*, 4> kSideNames{"left", "right", "bottom", "top"};

std::size_t sidesCrossed(const FigureScene& scene, std::size_t tile) {
    const auto& exact = std::get<indexOf(Method::Exact)>(scene.tree.bins)[tile];
    std::size_t crossed = 0;
    for (const core::Plane& plane : scene.camera.planes())
        crossed += exact.classify(plane) == core::Side::Straddling ? 1U : 0U;
    return crossed;
}

// The tile that looks largest of those that cross one side and are well in view.
std::size_t straddlingTile(const FigureScene& scene) {
    std::size_t best = 0;
    double largest = 0.0;
    for (std::size_t i = 0; i < scene.tree.tiles.size(); ++i) {
        const TreeTile& tile = scene.tree.tiles[i];
        if (!tile.witness || sidesCrossed(scene, i) != 1) continue;
        const glm::dvec3 center = scene.terrain.ellipsoid().toEcef(scene.tree.boxes[i].center());
        const double distance = glm::distance(center, scene.camera.eye);
        // Behind the globe nobody looks.
        if (distance > 1.2e6) continue;
        const double width = scene.tree.boxes[i].latitude().width() * scene.terrain.ellipsoid().equatorialRadius();
        if (tile.witness->depth < 0.3 * width) continue;
        const double size = width / distance;
        if (size <= largest) continue;
        largest = size;
        best = i;
    }
    return best;
}

// The parts of lines where `inside` holds, or those where it does not.
std::vector<Polyline> parts(const std::vector<Polyline>& lines, const std::array<core::Plane, 4>& planes, bool inside) {
    std::vector<Polyline> result;
    for (const Polyline& line : lines) {
        Polyline part;
        for (const glm::dvec3& point : line) {
            const bool isIn = std::all_of(planes.begin(), planes.end(),
                                          [&](const core::Plane& plane) { return plane.distance(point) >= 0.0; });
            if (isIn == inside) {
                part.push_back(point);
            } else if (!part.empty()) {
                part.push_back(point);
                result.push_back(std::move(part));
                part.clear();
            }
        }
        if (!part.empty()) result.push_back(std::move(part));
    }
    return result;
}

// A row a side: name, and lowest and highest distance in km by the bin and by its eight corners.
std::vector<std::string> rangeRows(const FigureScene& scene, std::size_t tile) {
    const auto& quadratic = std::get<indexOf(Method::Quadratic)>(scene.tree.bins)[tile];
    const auto& ellipsoid = scene.terrain.ellipsoid();
    const Polyline corners = binCorners(
        [&](const glm::dvec3& shares) { return ellipsoid.toEcef(positionIn(scene.tree.boxes[tile], shares)); });
    std::vector<std::string> rows;
    const auto planes = scene.camera.planes();
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const core::Interval range =
            std::visit([&](const auto& form) { return form.distanceRange(planes[i]); }, quadratic);
        double least = HUGE_VAL;
        double most = -HUGE_VAL;
        for (const glm::dvec3& corner : corners) {
            least = std::min(least, planes[i].distance(corner));
            most = std::max(most, planes[i].distance(corner));
        }
        rows.push_back(std::string(kSideNames[i]) + " " + std::to_string(4 - i) + " " +
                       withDecimals(range.lower * 1e-3, 4) + " " + withDecimals(range.upper * 1e-3, 4) + " " +
                       withDecimals(least * 1e-3, 4) + " " + withDecimals(most * 1e-3, 4));
    }
    return rows;
}

}  // namespace

void drawFrustumFigure(const Gnuplot& gnuplot, const FigureScene& scene) {
    const std::size_t tile = straddlingTile(scene);
    const core::GeodeticBin& bin = scene.tree.boxes[tile];
    const core::Ellipsoid& ellipsoid = scene.terrain.ellipsoid();
    const LocalFrame frame(ellipsoid, {scene.eye.latitude, scene.eye.longitude, 0.0});
    const auto local = [&](const glm::dvec3& ecef) { return frame.toLocalKm(ecef); };
    const auto lines = binGrid([&](const glm::dvec3& shares) { return ellipsoid.toEcef(positionIn(bin, shares)); }, 8);
    const double depth = 1.25 * glm::dot(ellipsoid.toEcef(bin.center()) - scene.camera.eye, scene.camera.forward);
    const auto planes = scene.camera.planes();
    PlotScript script;
    script.addBlock("$inside", mapped(parts(lines, planes, true), local));
    script.addBlock("$outside", mapped(parts(lines, planes, false), local));
    script.addBlock("$frustum", mapped(frustumLines(scene.camera, depth), local));
    script.addBlock("$eye", {{local(scene.camera.eye)}});
    script.addRows("$ranges", rangeRows(scene, tile));
    const auto line = [](const char* lc, const char* lw) {
        return std::string(" with lines lw ") + lw + " lc rgb '" + lc + "'";
    };
    script << R"(set multiplot
set xyplane relative 0
set view equal xyz
set view 66,24,1.4
set origin 0.04,0.10
set size 0.56,0.84
unset key
set xlabel 'east (km)' offset 0,-0.5
set ylabel 'north (km)' offset 1,-0.5
set zlabel 'up (km)' rotate offset 1,0
set label 1 'A bin against a frustum' at screen 0.3,0.96 center
set tics 200)"
           << "splot $frustum" + line(colour::kDark, "2") + ", $inside" + line(colour::kBlue, "1.5") + ", $outside" +
                  line(colour::kRed, "1.5") + ", $eye with points pt 7 ps 1.2 lc rgb 'black'";
    script << R"(set origin 0,0
set size 1,1
unset view
set lmargin at screen 0.71
set rmargin at screen 0.97
set bmargin at screen 0.24
set tmargin at screen 0.92
set label 1 'Its signed distances to the sides' at screen 0.84,0.96 center
set yrange [0.4:4.6]
set ylabel 'side of the frustum' offset -0.5,0 rotate
set xlabel 'distance (km), > 0 inside' offset 0,0
set ytics ('left' 4, 'right' 3, 'bottom' 2, 'top' 1)
set xtics autofreq font ',10'
set grid x
set arrow 1 from 0,0.4 to 0,4.6 nohead lw 2 lc rgb 'black')"
           << std::string("plot $ranges using 3:2:($4-$3):(0) with vectors nohead lw 9 lc rgb '") + colour::kSky +
                  "', $ranges using 5:2:($6-$5):(0) with vectors nohead lw 3 lc rgb '" + colour::kDark + "'";
    script.addKey(0.11,
                  {line(colour::kDark, "2") + " title 'frustum'", "with points pt 7 ps 1.2 lc rgb 'black' title 'eye'",
                   line(colour::kBlue, "1.5") + " title 'bin, inside all sides'",
                   line(colour::kRed, "1.5") + " title 'bin, outside of one'",
                   line(colour::kSky, "9") + " title 'range by the quadratic bin'",
                   line(colour::kDark, "3") + " title 'by eight corners'"});
    gnuplot.draw("figure2", 560, script);
}

}  // namespace osgAnalyticBin::paper
