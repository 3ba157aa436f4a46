// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "Figures.h"
#include "Output.h"

#include <cpl_error.h>
#include <gdal.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>

namespace {

using osgAnalyticBin::support::Failure;

using namespace osgAnalyticBin::paper;

int complain(const std::string& message) {
    std::cerr << "osgbinpaper: " << message << std::endl;
    return EXIT_FAILURE;
}

int run(int argc, char** argv) {
    const Settings settings = readSettings(argc, argv);
    std::optional<Gnuplot> gnuplot;
    if (!settings.plotFolder.empty()) gnuplot.emplace(settings.plotFolder);
    GDALAllRegister();
    CPLSetErrorHandler(CPLQuietErrorHandler);
    Progress progress(settings.isQuiet);
    Terrain terrain(settings.dem, settings.levels, settings.floor, progress);
    const Results results = runExperiment(terrain, settings.experiment, progress);
    printTables(std::cout, results, settings.levels);
    if (!std::cout.flush()) throw Failure("cannot write the tables to standard output");
    if (!settings.csv.empty()) writeFile(settings.csv, csvOf(results, settings.levels));
    if (!settings.json.empty()) writeFile(settings.json, jsonOf(settings, results));
    if (gnuplot) drawFigures(*gnuplot, terrain, settings.experiment.factor, results, progress);
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        return complain(error.what());
    }
}
