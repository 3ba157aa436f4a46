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

// The largest tile that crosses one side and is well in view.
std::size_t straddlingTile(const FigureScene& scene) {
    std::size_t best = 0;
    double deepest = -1.0;
    for (std::size_t i = 0; i < scene.tree.tiles.size(); ++i) {
        const TreeTile& tile = scene.tree.tiles[i];
        if (!tile.isLeaf() || !tile.witness || sidesCrossed(scene, i) != 1) continue;
        const glm::dvec3 center = scene.terrain.ellipsoid().toEcef(scene.tree.boxes[i].center());
        const double distance = glm::distance(center, scene.camera.eye);
        // Behind the globe nobody looks.
        if (distance > 1.2e6) continue;
        const double size = scene.tree.boxes[i].latitude().width() * (tile.witness->depth / distance);
        if (size <= deepest) continue;
        deepest = size;
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

std::vector<Polyline> frustumLines(const Camera& camera, double depth) {
    std::vector<Polyline> lines;
    Polyline end;
    for (const glm::dvec3& edge : camera.edges()) {
        lines.push_back({camera.eye, camera.eye + depth * edge});
        end.push_back(camera.eye + depth * edge);
    }
    end.push_back(end.front());
    lines.push_back(end);
    return lines;
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
        const core::Interval range = quadratic.distanceRange(planes[i]);
        double least = HUGE_VAL;
        double most = -HUGE_VAL;
        for (const glm::dvec3& corner : corners) {
            least = std::min(least, planes[i].distance(corner));
            most = std::max(most, planes[i].distance(corner));
        }
        rows.push_back(std::string(kSideNames[i]) + " " + std::to_string(4 - i) + " " +
                       decimals(range.lower * 1e-3, 4) + " " + decimals(range.upper * 1e-3, 4) + " " +
                       decimals(least * 1e-3, 4) + " " + decimals(most * 1e-3, 4));
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
    script << "set multiplot"
           << "set ticslevel 0"
           << "set view equal xyz"
           << "set view 66,24"
           << "set lmargin at screen 0.04; set rmargin at screen 0.60; set bmargin at screen 0.10"
           << "set tmargin at screen 0.92"
           << "set key at screen 0.03,0.94 left top Left reverse samplen 2"
           << "set xlabel 'east (km)' offset 0,-0.5"
           << "set ylabel 'north (km)' offset 1,-0.5"
           << "set zlabel 'up (km)' rotate offset 1,0"
           << "set label 1 'A bin against a frustum' at screen 0.3,0.975 center"
           << "set label 2 'Signed distances of the bin' at screen 0.82,0.975 center"
           << "set xtics 200"
           << "set ytics 200"
           << "set ztics 100"
           << "splot $frustum" + line(colour::kDark, "2") + " title 'frustum', $inside" + line(colour::kBlue, "1.5") +
                  " title 'bin, inside all four sides', $outside" + line(colour::kRed, "1.5") +
                  " title 'bin, outside of one', $eye with points pt 7 ps 1.2 lc rgb 'black' title 'eye'";
    script << "unset label 1"
           << "unset label 2"
           << "unset view"
           << "set view map"
           << "set lmargin at screen 0.69; set rmargin at screen 0.97; set bmargin at screen 0.20"
           << "set tmargin at screen 0.92"
           << "set key at screen 0.98,0.055 right horizontal samplen 2"
           << "set yrange [0.4:4.6]"
           << "set ylabel 'side of the frustum' offset -1.5,0 rotate"
           << "set xlabel 'distance to the side (km), > 0 inside' offset 0,0"
           << "unset zlabel"
           << "set ytics ('left' 4, 'right' 3, 'bottom' 2, 'top' 1)"
           << "set xtics auto rotate by -40"
           << "set grid x"
           << "set arrow 1 from 0,0.4 to 0,4.6 nohead lw 2 lc rgb 'black'"
           << std::string("plot $ranges using 3:2:($4-$3):(0) with vectors nohead lw 9 lc rgb '") + colour::kSky +
                  "' title 'quadratic bin', $ranges using 5:2:($6-$5):(0) with vectors nohead lw 3 lc rgb '" +
                  colour::kDark + "' title 'its corners'";
    gnuplot.draw("figure2", 560, script);
}

}  // namespace osgAnalyticBin::paper
