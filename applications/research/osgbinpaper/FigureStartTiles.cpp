// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Figures.h"

#include <cmath>

namespace osgAnalyticBin::paper {

void drawStartTilesFigure(const Gnuplot& gnuplot, const FigureScene& scene) {
    std::vector<std::string> rows;
    std::vector<std::string> posts;
    constexpr double kStepDeg = 0.5;
    for (int y = 0; y < TileId::kStartRows; ++y) {
        for (int x = 0; x < TileId::kStartColumns; ++x) {
            const TileId tile{0, x, y};
            const osgbindem::RectDeg rect = tile.rect();
            const core::Interval heights = scene.terrain.pyramid().heights(tile);
            rows.push_back(withDecimals(0.5 * (rect.west + rect.east), 3) + " " +
                           withDecimals(0.5 * (rect.south + rect.north), 3) + " " +
                           std::to_string(std::lround(heights.lower)) + " " +
                           std::to_string(std::lround(heights.upper)));
        }
    }
    for (double latitude = -89.75; latitude < 90.0; latitude += kStepDeg) {
        // A row of posts at a time is read.
        scene.terrain.prefetch({-180.0, latitude - kStepDeg, 180.0, latitude + kStepDeg});
        std::string row;
        for (double longitude = -179.75; longitude < 180.0; longitude += kStepDeg)
            row += withDecimals(scene.terrain.height({latitude, longitude}), 0) + " ";
        posts.push_back(row);
    }
    PlotScript script;
    script.addRows("$tiles", rows);
    script.addRows("$posts", posts);
    script
        << "set title 'The 128 start tiles, 22.5 degrees each, with their lowest and highest terrain (m)'"
        << "set xrange [-180:180]"
        << "set yrange [-90:90]"
        << "set xtics -180,45,180 out nomirror"
        << "set ytics -90,22.5,90 out nomirror"
        << "set xlabel 'longitude (deg)'"
        << "set ylabel 'latitude (deg)' offset 1,0"
        << "set size ratio -1"
        << "set cblabel 'height above the ellipsoid (m)' offset 0.5,0"
        << "set palette defined (0 '#dbe9f4', 0.0001 '#dbe9f4', 1 '#f4ecd0', 1000 '#d9b872', 3000 '#a06a3c', "
           "6000 '#5a2d14')"
        << "set cbrange [0:6000]"
        << "set lmargin at screen 0.09; set rmargin at screen 0.85; set tmargin at screen 0.92; set bmargin at screen "
           "0.14";
    for (int i = 1; i < TileId::kStartColumns; ++i) {
        const std::string at = withDecimals(-180.0 + 22.5 * i, 1);
        script << "set arrow from " + at + ",-90 to " + at + ",90 nohead front lw 1.2 lc rgb '" + colour::kBlue + "'";
    }
    for (int i = 1; i < TileId::kStartRows; ++i) {
        const std::string at = withDecimals(-90.0 + 22.5 * i, 1);
        script << "set arrow from -180," + at + " to 180," + at + " nohead front lw 1.2 lc rgb '" + colour::kBlue + "'";
    }
    script << "plot $posts matrix using ($1*0.5-179.75):($2*0.5-89.75):3 with image notitle, "
              "$tiles using 1:($2+4):(sprintf('%d',$4)) with labels font ',10' notitle, "
              "$tiles using 1:($2-5):(sprintf('%d',$3)) with labels font ',10' notitle";
    gnuplot.draw("figure3", 510, script);
}

}  // namespace osgAnalyticBin::paper
