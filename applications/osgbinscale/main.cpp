// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "ModuleFolder.h"
#include "Output.h"
#include "ProgramRun.h"
#include "Series.h"
#include "Settings.h"
#include "TextFile.h"

#include <iostream>

namespace {

using osgAnalyticBin::support::ExitCode;
using osgAnalyticBin::support::kSucceeded;
using osgAnalyticBin::support::writeFile;

using namespace osgAnalyticBin::scale;

void measure(const Settings& settings) {
    if (!settings.plot.empty()) requireGnuplot();
    Results results;
    // First, while little has been allocated and freed.
    if (settings.measuresMemory) results.memory = measureMemory(settings);
    if (settings.measuresResidents) results.residents = measureResidents(settings);
    if (settings.measuresDepth) results.depth = measureDepth(settings);
    if (!settings.csv.empty()) writeFile(settings.csv, csvOf(results));
    if (!settings.json.empty()) writeFile(settings.json, jsonOf(settings, results));
    if (!settings.plot.empty()) plot(settings.plot, results);
    printTables(std::cout, results);
}

ExitCode run(int argc, char** argv) {
    Settings settings;
    if (!settingsFromCommandLine(argc, argv, settings)) return kSucceeded;
    osgAnalyticBin::addModuleFolder();
    measure(settings);
    return kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    return osgAnalyticBin::support::runProgram("osgbinscale", [&] { return run(argc, argv); });
}
