// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ScaleCommand.h"

#include "Failure.h"
#include "ModuleFolder.h"
#include "Output.h"
#include "Series.h"
#include "Settings.h"
#include "TextFile.h"

#include <osg/Notify>

#include <cstdlib>
#include <iostream>

namespace osgAnalyticBin::scale {

namespace {

void measure(const Settings& settings) {
    Results results;
    // First, while little has been allocated and freed.
    if (settings.measuresMemory) results.memory = measureMemory(settings);
    if (settings.measuresResidents) results.residents = measureResidents(settings);
    if (settings.measuresDepth) results.depth = measureDepth(settings);
    if (!settings.csv.empty()) support::writeFile(settings.csv, csvOf(results));
    if (!settings.json.empty()) support::writeFile(settings.json, jsonOf(settings, results));
    if (!settings.plot.empty()) plot(settings.plot, results);
    printTables(std::cout, results);
}

}  // namespace

support::ExitCode run(int argc, char** argv) {
    Settings settings;
    if (!settingsFromCommandLine(argc, argv, settings)) return support::kSucceeded;
    // globes are read again and again, and the plugin says each time that they have bins
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::WARN);
    addModuleFolder();
    measure(settings);
    return support::kSucceeded;
}

}  // namespace osgAnalyticBin::scale
