// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Report.h"

#include <osgAnalyticBin/Version.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace {

using osgAnalyticBin::report::Mismatch;
using osgAnalyticBin::report::Report;

constexpr int kDiffers = 1;
constexpr int kUnreadable = 2;

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
        "geometry was drawn. Files: node files read from the camera's arrival on. Cull: milliseconds, median.\n"
        "Exit code: 0; 1 when a picture of a sound method (any but paper and corners) differs from the reference;\n"
        "2 when a run is missing or broken, or the command line is wrong.\n\n"
        "Example:\n"
        "  osgbinreport demo/none demo/sphere demo/quadratic --difference demo/difference");
}

int report(const Arguments& arguments) {
    std::string error;
    const auto report = Report::of(arguments.folders, arguments.labels, arguments.differenceFolder, error);
    if (!report) {
        std::cerr << "osgbinreport: " << error << '\n';
        return kUnreadable;
    }
    report->print(std::cout);
    const std::vector<Mismatch> mismatches = report->mismatches();
    for (const Mismatch& mismatch : mismatches)
        std::cerr << "osgbinreport: method " << mismatch.label << " draws another picture than the reference at pose "
                  << mismatch.pose << ": " << mismatch.pixels << " pixels differ\n";
    return mismatches.empty() ? 0 : kDiffers;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{"Compares flights over a database that were made with different culling methods.", "osgbinreport"};
    app.set_version_flag("--version", std::string("osgbinreport (osgAnalyticBin) ") + osgAnalyticBin::version());
    Arguments arguments;
    declare(app, arguments);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "osgbinreport: " << error.what() << "; see osgbinreport --help\n";
        return kUnreadable;
    }
    return report(arguments);
}
