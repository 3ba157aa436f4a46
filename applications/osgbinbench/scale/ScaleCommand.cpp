// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CommandLine.h"
#include "Failure.h"
#include "ModuleFolder.h"
#include "Series.h"
#include "TextFile.h"

#include <osg/Notify>

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace osgAnalyticBin::scale {

using report::Json;
using support::UsageError;

namespace {

constexpr const char* kFooter =
    "Everything is measured on procedural globes (NUMBER.proceduralglobe), without files and without a display; what "
    "is\n"
    "compared takes turns, so that what slows the machine down slows all of it.\n\n"
    "depth      A flight from 10 000 km down to where tiles of the deepest level are drawn, for each number of "
    "levels:\n"
    "           tiles tested, kept and drawn, milliseconds of a cull traversal and its sorting.\n"
    "residents  One view, with more and more PagedLODs in memory on the far side of the globe: milliseconds of a cull\n"
    "           traversal, and of the DatabasePager's own update, which walks over all PagedLODs whenever there are\n"
    "           more than its target.\n"
    "memory     Bytes that a tile in memory takes (malloc's own count), and microseconds to make and install it:\n"
    "           without bins, with stored bins that nobody uses, and with those of each method.\n\n"
    "Times are first quartiles: what else the machine does only adds to them; cull_spread_ms is the distance to the\n"
    "third. Figures of the flight are sums over its poses. Methods: those of osgbinbench; oracle repeats what bins "
    "keep.\n"
    "Exit code: 0; 1 when something failed: one line says what; 2 when the command line is wrong.\n\n"
    "Example:\n"
    "  osgbinbench scale --levels 8,20 --residents 1000,100000 --json scale.json --plot figures";

void declare(CLI::App& app, Settings& settings) {
    app.add_option("--series", settings.series, "comma-separated: depth, residents, memory (default: all)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--methods", settings.methodNames, "comma-separated (default: sphere,bins,oracle)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--levels", settings.levels, "numbers of levels, 0 to 24 (default 4,8,12,16,20)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(0, 24));
    app.add_option("--residents", settings.residents,
                   "PagedLODs in memory, at least, 1 to 1000000\n(default 100,1000,10000,100000)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(1, 1000000));
    app.add_option("--memory-tiles", settings.memoryTiles, "tiles whose memory is counted (default 10000)")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--poses", settings.poses, "stops of the flight (default 12)")->check(CLI::Range(2, 1000));
    app.add_option("--cells", settings.cells, "cells along a tile's edge, even (default 8)")->check(CLI::Range(2, 64));
    app.add_option("--rounds", settings.rounds, "rounds of three timed traversals each (default 15)")
        ->check(CLI::Range(1, 10000));
    app.add_option("--csv", settings.csv, "file for the figures, a line for each method and measurement");
    app.add_option("--json", settings.json, "file for the figures");
    app.add_option("--plot", settings.plot,
                   "folder for depth, flight, residents and memory as .svg\nand .png (needs gnuplot)");
}

void check(const Settings& settings) {
    for (const std::string& name : settings.series)
        if (name != "depth" && name != "residents" && name != "memory")
            throw UsageError("--series: unknown series \"" + name + "\"; use depth, residents or memory");
    (void)settings.methods();
    if (settings.cells % 2 != 0)
        throw UsageError("--cells: " + std::to_string(settings.cells) + " is odd; give an even number");
    support::requireFolderOf("--csv", settings.csv);
    support::requireFolderOf("--json", settings.json);
    if (!settings.plot.empty()) support::makeFolder("--plot", settings.plot);
}

// A line for each row of all series.
std::string csvOf(const Json& lists) {
    std::vector<Json> rows;
    for (const auto& list : lists.items()) {
        for (const Json& row : list.value()) {
            rows.push_back({{"series", list.key()}});
            rows.back().update(row);
        }
    }
    return report::csvOf(rows);
}

void measure(const Settings& settings) {
    const osg::ref_ptr<bench::FileWatch> watch = new bench::FileWatch;
    watch->install();
    const auto rowsOf = [&](const char* name, Rows (*series)(const Settings&, bench::FileWatch&)) {
        const bool isAsked = std::count(settings.series.begin(), settings.series.end(), name) > 0;
        return isAsked ? series(settings, *watch) : Rows();
    };
    // First, while little has been allocated and freed.
    const Rows memory = rowsOf("memory", measureMemory);
    const Rows residents = rowsOf("residents", measureResidents);
    const Rows depth = rowsOf("depth", measureDepth);
    const Json lists{{"depth", depth}, {"residents", residents}, {"memory", memory}};
    Json json{{"poses", settings.poses}, {"cells", settings.cells}, {"rounds", settings.rounds}};
    json.update(lists);
    if (!settings.csv.empty()) support::writeFile(settings.csv, csvOf(lists));
    if (!settings.json.empty()) support::writeFile(settings.json, json.dump(2) + "\n");
    if (!settings.plot.empty()) report::plot(settings.plot, diagramsOf(depth, residents, memory));
    for (const auto& list : lists.items()) {
        if (list.value().empty()) continue;
        report::TextTable table(2);
        for (const Json& row : list.value()) table.addRow(row, 4);
        std::cout << list.key() << '\n';
        table.print(std::cout);
        std::cout << '\n';
    }
}

}  // namespace

support::ExitCode run(int argc, char** argv) {
    CLI::App app{"Measures how culling scales with the depth of a database and with what is in memory.",
                 "osgbinbench scale"};
    app.footer(kFooter);
    Settings settings;
    declare(app, settings);
    if (!support::parseCommandLine(app, argc, argv)) return support::kSucceeded;
    check(settings);
    // globes are read again and again, and the plugin says each time that they have bins
    if (std::getenv("OSG_NOTIFY_LEVEL") == nullptr) osg::setNotifyLevel(osg::WARN);
    addModuleFolder();
    measure(settings);
    return support::kSucceeded;
}

}  // namespace osgAnalyticBin::scale
