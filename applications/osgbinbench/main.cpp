// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Bench.h"
#include "CameraView.h"
#include "Failure.h"
#include "MethodScene.h"
#include "ModuleFolder.h"
#include "Output.h"
#include "Report.h"
#include "ScaleCommand.h"
#include "TextFile.h"

#include <osg/Notify>

#include <cstdlib>
#include <iostream>
#include <malloc.h>

namespace {

using namespace osgAnalyticBin::support;

using namespace osgAnalyticBin::bench;
using osgAnalyticBin::flight::CameraPose;

// Pages lie where their pager's thread gets its memory from. With one store for all threads they lie much alike in
// every run, and so cull times differ less from run to run.
void shareMemoryAmongThreads() {
#ifdef M_ARENA_MAX
    (void)mallopt(M_ARENA_MAX, 1);
#endif
}

std::vector<CameraPose> pathOf(const Settings& settings, FileWatch& watch) {
    if (settings.paths.empty()) return defaultPath(settings, watch);
    return osgAnalyticBin::flight::readCameraPathFiles(settings.paths, [&] { return globeOf(settings, watch); });
}

void write(const Settings& settings, const Measurement& measured) {
    if (!settings.csv.empty()) writeFile(settings.csv, csvOf(measured));
    if (!settings.json.empty()) writeFile(settings.json, jsonOf(settings, measured));
}

// Says what is missing after Ctrl-C. Returns: empty where nothing is.
std::string notePartial(std::size_t measured, std::size_t poses) {
    if (!stopRequested) return {};
    std::string text = "PARTIAL RESULT: interrupted";
    if (measured < poses) text += " after " + std::to_string(measured) + " of " + std::to_string(poses) + " poses";
    std::cout << text << "\n\n";
    return text;
}

void tell(const Settings& settings, const Measurement& measured) {
    write(settings, measured);
    (void)notePartial(0, 0);
    print(std::cout, tablesOf(measured));
}

// Of each path the first.
std::vector<Picture> chosenPictures(const std::vector<std::string>& poses, const std::vector<Picture>& pictures) {
    std::vector<Picture> chosen;
    for (const PathGroup& path : pathGroupsOf(poses)) chosen.push_back(pictures[path.poses.front()]);
    return chosen;
}

void tellOfPoses(const Settings& settings, std::size_t planned, const PoseFigures& found) {
    const Measurement& measured = found.measured;
    write(settings, measured);
    const std::string partial = notePartial(measured.poses.size(), planned);
    HtmlReport report{settings.database, partial, adviceOf(measured), tablesOf(measured), {}, {}};
    print(std::cout, report.tables);
    for (const std::string& sentence : report.sentences)
        std::cout << (&sentence == &report.sentences.front() ? "\n" : "") << sentence << '\n';
    std::cout.flush();
    if (settings.plot.empty() && settings.report.empty()) return;
    report.diagrams = diagramsOf(measured);
    if (!settings.plot.empty()) plot(settings.plot, report.diagrams);
    if (settings.report.empty()) return;
    report.pictures = chosenPictures(measured.poses, found.pictures);
    writeFile(settings.report, report.html());
    std::cout << "\nThe same with diagrams and pictures: " << settings.report << std::endl;
}

void measure(const Settings& settings) {
    const std::vector<CullMethod> methods = cullMethodsFromNames(settings.methods);
    const osg::ref_ptr<FileWatch> watch = new FileWatch;
    watch->install();
    const std::vector<CameraPose> path = pathOf(settings, *watch);
    if (settings.jumps || settings.frames > 0) return tell(settings, fly(settings, methods, path, *watch));
    tellOfPoses(settings, path.size(), measureAtPoses(settings, methods, path, *watch));
}

ExitCode run(int argc, char** argv) {
    Settings settings;
    if (!settingsFromCommandLine(argc, argv, settings)) return kSucceeded;
    // bins are installed at every pose, and the plugin says so each time
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::WARN);
    shareMemoryAmongThreads();
    osgAnalyticBin::addModuleFolder();
    osgAnalyticBin::support::stopOnSignals();
    measure(settings);
    return stopRequested ? kInterrupted : kSucceeded;
}

}  // namespace

int main(int argc, char** argv) {
    using osgAnalyticBin::support::runProgram;
    const std::string command = argc > 1 ? argv[1] : "";
    if (command == "report") return runProgram("osgbinbench report", [&] { return runReport(argc - 1, argv + 1); });
    if (command == "scale")
        return runProgram("osgbinbench scale", [&] { return osgAnalyticBin::scale::run(argc - 1, argv + 1); });
    return runProgram("osgbinbench", [&] { return run(argc, argv); });
}
