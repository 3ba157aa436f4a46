// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ReportCommand.h"

#include "Failure.h"
#include "Report.h"

#include <osgAnalyticBin/Version.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

namespace {

using support::ExitCode;
using support::Failure;
using support::UsageError;

struct Arguments {
    std::vector<std::string> folders;
    std::vector<std::string> labels;
    std::string differenceFolder;
};

void declare(CLI::App& app, Arguments& arguments) {
    app.add_option("DIR", arguments.folders,
                   "Folders that flights left (poses.csv and pictures); the first is the reference")
        ->required();
    app.add_option("--labels", arguments.labels, "One name per folder, comma-separated (default: the folders' names)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--difference", arguments.differenceFolder,
                   "Folder for pictures of the differences: differing pixels red");
    app.footer(
        "Tiles: tested = the cull traversal reached the tile; kept = it reached what is below; drawn = its own\n"
        "geometry was drawn. Files: node files read from the camera's arrival on. Cull, frame: milliseconds,\n"
        "median; a frame is from one to the next, drawing included.\n"
        "Exit code: 0; 1 when a picture of a sound method (any but paper and corners) differs from the reference,\n"
        "or when a flight cannot be read; 2 when the command line is wrong.\n\n"
        "Example:\n"
        "  osgbinbench report demo/none demo/sphere demo/quadratic --difference demo/difference");
}

ExitCode compare(const Arguments& arguments) {
    if (!arguments.labels.empty() && arguments.labels.size() != arguments.folders.size())
        throw UsageError("--labels: " + std::to_string(arguments.labels.size()) + " names for " +
                         std::to_string(arguments.folders.size()) + " folders; give one for each");
    std::string error;
    const auto report = Report::of(arguments.folders, arguments.labels, arguments.differenceFolder, error);
    if (!report) throw Failure(error);
    report->print(std::cout);
    const std::vector<Mismatch> mismatches = report->mismatches();
    for (const Mismatch& mismatch : mismatches)
        std::cerr << "osgbinbench report: method " << mismatch.label
                  << " draws another picture than the reference at pose " << mismatch.pose << ": " << mismatch.pixels
                  << " pixels differ\n";
    return mismatches.empty() ? support::kSucceeded : support::kFailed;
}

}  // namespace

ExitCode run(int argc, char** argv) {
    CLI::App app{"Compares flights over a database that were made with different culling methods.",
                 "osgbinbench report"};
    app.set_version_flag("--version", std::string("osgbinbench report (osgAnalyticBin) ") + version());
    Arguments arguments;
    declare(app, arguments);
    if (!support::parseCommandLine(app, argc, argv)) return support::kSucceeded;
    return compare(arguments);
}

}  // namespace osgAnalyticBin::report
