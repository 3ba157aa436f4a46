// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "Experiment.h"
#include "Failure.h"
#include "ProgressLine.h"
#include "TextFile.h"

#include <cpl_error.h>
#include <gdal.h>

#include <iostream>

namespace {

using namespace osgAnalyticBin::support;

using namespace osgAnalyticBin::paper;

struct Settings {
    std::string dem = "/usr/share/ferret-vis/data/etopo5.cdf";
    int levels = 6;
    int cameras = 400;  // of each kind
    std::string csv;
};

std::string footer() {
    return "Methods:\n"
           "  corners    the eight corners of the bin        paper  nine points of the quadratic over a box grown by "
           "1.1\n"
           "  quadratic  the quadratic, with proven remainder and exact range        exact  the closed form\n"
           "  box        the box along the axes of ECEF, for comparison\n"
           "  hull       exact, and beyond the edges of the frustum: nearly the truth\n"
           "Columns, sums over cameras:\n" +
           meaningOfColumns() +
           "\nExit code: 0; 1 when something failed: one line says what; 2 when the command line is wrong.\n\n"
           "Example:\n  osgbinpaper --cameras 200 --csv paper.csv\n";
}

void declare(CLI::App& app, Settings& settings) {
    app.add_option(
        "DEM", settings.dem,
        "elevation raster that GDAL reads, metres; 0 m where it has no data; cameras stand above it\n(default: " +
            settings.dem + ")");
    app.add_option("--levels", settings.levels, "levels of tiles below the 16 x 8 start tiles, 0 to 8 (default: 6)")
        ->check(CLI::Range(0, Terrain::kDeepest));
    app.add_option("--cameras", settings.cameras, "cameras of each of the six kinds of view (default: 400)")
        ->check(CLI::Range(1, 100000));
    app.add_option("--csv", settings.csv, "write the counts to this file, a line for each view and method");
}

void measure(const Settings& settings) {
    GDALAllRegister();
    CPLSetErrorHandler(CPLQuietErrorHandler);
    Terrain terrain(settings.dem, settings.levels);
    osgAnalyticBin::support::ProgressLine progress(stderr);
    const Results results = runExperiment(terrain, static_cast<std::size_t>(settings.cameras), [&](double share) {
        if (progress.isDue()) progress.show(share, "osgbinpaper: ");
    });
    printTables(std::cout, results);
    if (!std::cout.flush()) throw Failure("cannot write the tables to standard output");
    if (!settings.csv.empty()) writeFile(settings.csv, csvOf(results));
}

ExitCode run(int argc, char** argv) {
    Settings settings;
    CLI::App app{
        "Repeats the published experiment on culling by analytic bins (Ju & Jong): real terrain, a quadtree from 128\n"
        "start tiles, random cameras, the same recursion for every method, and every verdict set against a proof.",
        "osgbinpaper"};
    app.footer(footer());
    declare(app, settings);
    if (osgAnalyticBin::support::parseCommandLine(app, argc, argv)) measure(settings);
    return kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    return osgAnalyticBin::support::runProgram("osgbinpaper", [&] { return run(argc, argv); });
}
