// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "Figures.h"
#include "Output.h"
#include "ProgramRun.h"
#include "TextFile.h"

#include <cpl_error.h>
#include <gdal.h>

#include <iostream>
#include <optional>

namespace {

using osgAnalyticBin::support::ExitCode;
using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::kSucceeded;
using osgAnalyticBin::support::writeFile;

using namespace osgAnalyticBin::paper;

void measure(const Settings& settings) {
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
}

ExitCode run(int argc, char** argv) {
    if (const std::optional<Settings> settings = readSettings(argc, argv)) measure(*settings);
    return kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    return osgAnalyticBin::support::runProgram("osgbinpaper", [&] { return run(argc, argv); });
}
