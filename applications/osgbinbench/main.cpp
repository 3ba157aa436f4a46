// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Compare.h"
#include "ContinuousPath.h"
#include "DrawnFlight.h"
#include "Failure.h"
#include "FlightBench.h"
#include "ModuleFolder.h"
#include "Output.h"
#include "Plot.h"
#include "PoseBench.h"
#include "ProgramRun.h"
#include "ReportCommand.h"
#include "ScaleCommand.h"
#include "TextFile.h"

#include <osg/Notify>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <malloc.h>

namespace {

using osgAnalyticBin::support::ExitCode;
using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::kFailed;
using osgAnalyticBin::support::kSucceeded;
using osgAnalyticBin::support::writeFile;

using namespace osgAnalyticBin::bench;
using osgAnalyticBin::flight::CameraPose;

// Pages lie where their pager's thread gets its memory from. With one store for all threads they lie much alike in
// every run, and so cull times differ less from run to run.
void shareMemoryAmongThreads() {
#ifdef M_ARENA_MAX
    (void)mallopt(M_ARENA_MAX, 1);
#endif
}

std::vector<std::string> namesOf(const std::vector<CameraPose>& path) {
    std::vector<std::string> names;
    for (const CameraPose& pose : path) names.push_back(pose.name);
    return names;
}

std::vector<CameraPose> livePath(const std::vector<CameraPose>& path, int framesPerLeg) {
    return continuousPath(path, 1 + framesPerLeg * std::max(1, static_cast<int>(path.size()) - 1));
}

void write(const Settings& settings, const std::string& csv, const std::string& json) {
    if (!settings.csv.empty()) writeFile(settings.csv, csv);
    if (!settings.json.empty()) writeFile(settings.json, json);
}

void measure(const Settings& settings) {
    std::string error;
    const auto path = osgAnalyticBin::flight::readCameraPathFiles(settings.paths, error);
    if (!path) throw Failure(error);
    const std::vector<CullMethod> methods = cullMethodsFromNames(settings.methods);
    FileWatch watch;
    if (settings.draw) {
        const auto figures = flyDrawn(settings, methods, continuousPath(*path, settings.frames), watch);
        write(settings, csvOf(figures), jsonOf(settings, figures));
        return printTable(std::cout, figures);
    }
    if (settings.frames > 0 || settings.jumps) {
        const auto figures = settings.jumps
                                 ? jump(settings, methods, *path, watch)
                                 : flyContinuously(settings, methods, continuousPath(*path, settings.frames), watch);
        write(settings, csvOf(figures), jsonOf(settings, figures));
        return printTable(std::cout, figures);
    }
    const auto figures = PoseBench(settings, methods, watch).run(*path);
    std::vector<FlightFigures> live;
    if (settings.live > 0) live = flyContinuously(settings, methods, livePath(*path, settings.live), watch);
    write(settings, csvOf(namesOf(*path), figures), jsonOf(settings, namesOf(*path), figures, live));
    printTable(std::cout, namesOf(*path), figures);
    if (!live.empty()) {
        std::cout << '\n';
        printTable(std::cout, live);
    }
    std::cout.flush();
    if (!settings.plot.empty()) plot(settings.plot, diagramsOf(namesOf(*path), figures));
}

ExitCode run(int argc, char** argv) {
    Settings settings;
    if (!settingsFromCommandLine(argc, argv, settings)) return kSucceeded;
    if (!settings.compared.empty())
        return compareFiles(settings.compared[0], settings.compared[1], std::cout) ? kFailed : kSucceeded;
    // bins are installed at every pose, and the plugin says so each time
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::WARN);
    shareMemoryAmongThreads();
    osgAnalyticBin::addModuleFolder();
    measure(settings);
    return kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    using osgAnalyticBin::support::runProgram;
    const std::string command = argc > 1 ? argv[1] : "";
    if (command == "report")
        return runProgram("osgbinbench report", [&] { return osgAnalyticBin::report::run(argc - 1, argv + 1); });
    if (command == "scale")
        return runProgram("osgbinbench scale", [&] { return osgAnalyticBin::scale::run(argc - 1, argv + 1); });
    return runProgram("osgbinbench", [&] { return run(argc, argv); });
}
