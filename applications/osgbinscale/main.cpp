// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "ModuleFolder.h"
#include "Output.h"
#include "Series.h"
#include "Settings.h"
#include "TextFile.h"

#include <cstdlib>
#include <exception>
#include <iostream>

namespace {

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

}  // namespace

int main(int argc, char** argv) {
    try {
        Settings settings;
        if (!settingsFromCommandLine(argc, argv, settings)) return EXIT_SUCCESS;
        osgAnalyticBin::addModuleFolder();
        measure(settings);
        return EXIT_SUCCESS;
    } catch (const std::exception& error) {
        std::cerr << "osgbinscale: " << error.what() << std::endl;
        return EXIT_FAILURE;
    }
}
