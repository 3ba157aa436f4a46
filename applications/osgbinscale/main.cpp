// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "Output.h"
#include "Series.h"
#include "Settings.h"

#include <osgAnalyticBin/CullOptions.h>

#include <osgDB/Registry>

#include <cstdlib>
#include <dlfcn.h>
#include <exception>
#include <iostream>

namespace {

using namespace osgAnalyticBin::scale;

// The modules stand in a folder beside the kit's library; OpenSceneGraph has to be told, unless they are installed
// where it looks.
void addModuleFolder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&osgAnalyticBin::methodName), &info) == 0 || !info.dli_fname) return;
    const std::string library = info.dli_fname;
    const auto slash = library.rfind('/');
    if (slash != std::string::npos)
        osgDB::Registry::instance()->getLibraryFilePathList().push_back(library.substr(0, slash));
}

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
        addModuleFolder();
        measure(settings);
        return EXIT_SUCCESS;
    } catch (const std::exception& error) {
        std::cerr << "osgbinscale: " << error.what() << std::endl;
        return EXIT_FAILURE;
    }
}
