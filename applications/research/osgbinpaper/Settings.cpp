// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Settings.h"

#include "NumberRange.h"
#include "ProgramRun.h"

#include <osgAnalyticBin/Version.h>

#include <CLI/CLI.hpp>

namespace osgAnalyticBin::paper {

namespace {

constexpr const char* kDescription =
    "Repeats the published experiment on culling by analytic bins (Ju & Jong): real terrain, a quadtree from 128 "
    "start\n"
    "tiles, random cameras, the same recursion for every method, and every verdict set against a proof.";

constexpr const char* kLegend =
    "Methods:\n"
    "  corners    the eight corners of the bin        paper  nine points of the quadratic over a box grown by 1.1\n"
    "  quadratic  the quadratic, with proven remainder and exact range        exact  the closed form\n"
    "  hull       exact, and beyond the edges of the frustum: nearly the truth\n"
    "  sphere, box  around the bin, the box along the axes of ECEF: for comparison\n"
    "Columns, sums over cameras (in CSV and JSON, too):\n"
    "  tested, kept, drawn   tiles tested; not culled, at any level; leaves not culled\n"
    "  wrong_culls           tiles culled although a point of them, found by sampling, is in the frustum\n"
    "  holes                 of these, such whose terrain is in view and not behind the globe\n"
    "  lost_leaves           leaves with a point in the frustum that were not drawn\n"
    "  wrong_keeps           leaves drawn although a plane parts them from the frustum\n"
    "  wrong_insides         tiles found wholly inside although a point of them is outside\n"
    "  ns                    nanoseconds a tile tested, bins made beforehand (not in the CSV)\n"
    "\n"
    "Exit code: 0; 1 when something failed: one line says what; 2 when the command line is wrong.\n"
    "\n"
    "Example:\n"
    "  osgbinpaper --cameras 200 --csv paper.csv --json paper.json --plot figures\n";

void declare(CLI::App& app, Settings& settings) {
    ExperimentSettings& experiment = settings.experiment;
    app.add_option("DEM", settings.dem,
                   "elevation raster that GDAL reads, metres; 0 m where it has no data; cameras stand above it\n"
                   "(default: " +
                       settings.dem + ")");
    app.add_option("--levels", settings.levels, "levels of tiles below the 16 x 8 start tiles, 0 to 8 (default: 6)")
        ->check(CLI::Range(0, HeightPyramid::kDeepest));
    app.add_option("--floor", settings.floor,
                   "metres; lower heights are taken for this: the sea's surface (default: 0)")
        ->check(support::within(-12000.0, 10000.0));
    app.add_option("--factor", experiment.factor,
                   "a tile is divided while it is nearer to the eye than this many of its widths,\n0.5 to 20 "
                   "(default: 3)")
        ->check(support::within(0.5, 20.0));
    app.add_option("--cameras", experiment.cameras, "cameras of each of the six kinds of view (default: 400)")
        ->check(CLI::Range(1, 100000));
    app.add_option("--seed", experiment.seed, "seed of the cameras (default: 1)");
    app.add_flag(
        "--occlusion", experiment.hidesBehindTerrain,
        "count, too, which of the leaves that exact keeps lie behind terrain, as meshes of 33 x 33 posts: for\n"
        "cameras whose whole picture is ahead of them, and no line of sight to a hidden one may be free");
    app.add_option("--csv", settings.csv, "write the counts to this file, a line for each view, level and method");
    app.add_option("--json", settings.json, "write sums, times and findings to this file");
    app.add_option("--plot", settings.plotFolder,
                   "draw the figures into this folder, as SVG and PNG (needs gnuplot: package gnuplot-nox)");
    app.add_flag("--quiet", settings.isQuiet, "show no progress on stderr");
    app.footer(kLegend);
}

}  // namespace

std::optional<Settings> readSettings(int argc, char** argv) {
    Settings settings;
    CLI::App app{kDescription, "osgbinpaper"};
    app.set_version_flag("--version", std::string("osgbinpaper (osgAnalyticBin) ") + osgAnalyticBin::version());
    declare(app, settings);
    if (!support::parseCommandLine(app, argc, argv)) return std::nullopt;
    return settings;
}

}  // namespace osgAnalyticBin::paper
