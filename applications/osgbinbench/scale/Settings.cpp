// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Settings.h"

#include "CullMethod.h"
#include "Failure.h"
#include "ProgramRun.h"
#include "RivalOptions.h"
#include "TextFile.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/Version.h>

#include <CLI/CLI.hpp>

namespace osgAnalyticBin::scale {

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
    "           traversal, of an update traversal, and of the DatabasePager's own update, which walks over all\n"
    "           PagedLODs whenever there are more than its target.\n"
    "memory     Bytes that a tile in memory takes (malloc's own count), and microseconds to make and install it:\n"
    "           without bins, with stored bins that nobody uses, and with those of each method.\n\n"
    "Times are first quartiles: what else the machine does only adds to them; cull_spread_ms is the distance to the\n"
    "third. Figures of the flight are sums over its poses. deepest_tiles: drawn tiles of the deepest level.\n\n"
    "Methods: none, sphere (OSG's own), and BASE[+horizon][+edges] with BASE quadratic, exact, box, orientedbox,\n"
    "paper or corners; oracle repeats what exact+horizon+edges keeps, without a test.\n"
    "Exit code: 0; 1 when something failed: one line says what; 2 when the command line is wrong.\n\n"
    "Example:\n"
    "  osgbinbench scale --levels 8,20 --residents 1000,100000 --json scale.json --plot figures";

struct Words {
    std::vector<std::string> methods{"sphere", "quadratic+horizon+edges", "exact+horizon+edges", bench::kOracleMethod};
    std::vector<std::string> series{"depth", "residents", "memory"};
};

void declare(CLI::App& app, Settings& settings, Words& words) {
    app.footer(kFooter);
    app.add_option("--series", words.series, "comma-separated: depth, residents, memory (default: all)")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--methods", words.methods,
                   "comma-separated (default: sphere, quadratic+horizon+edges,\nexact+horizon+edges, oracle)")
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
    app.add_option("--memory-tiles", settings.memoryTiles,
                   "tiles whose memory is counted, 1 to 1000000 (default 10000)")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--poses", settings.poses, "stops of the flight, 2 to 1000 (default 12)")
        ->check(CLI::Range(2, 1000));
    app.add_option("--cells", settings.cells, "cells along a tile's edge, even, 2 to 64 (default 8)")
        ->check(CLI::Range(2, 64));
    app.add_option("--rounds", settings.rounds, "rounds of three timed traversals each, 1 to 10000 (default 15)")
        ->check(CLI::Range(1, 10000));
    app.add_option("--csv", settings.csv, "file for the figures, a line for each method and measurement");
    app.add_option("--json", settings.json, "file for the figures and the ratios between them");
    app.add_option("--plot", settings.plot,
                   "folder for depth, flight, residents and memory as .svg\nand .png (needs gnuplot)");
}

void takeSeries(const std::vector<std::string>& series, Settings& settings) {
    settings.measuresDepth = settings.measuresResidents = settings.measuresMemory = false;
    for (const std::string& name : series) {
        if (name == "depth") {
            settings.measuresDepth = true;
        } else if (name == "residents") {
            settings.measuresResidents = true;
        } else if (name == "memory") {
            settings.measuresMemory = true;
        } else {
            throw UsageError("--series: unknown series \"" + name + "\"; use depth, residents or memory");
        }
    }
}

}  // namespace

ScaleMethod scaleMethodFromName(const std::string& name) {
    if (name == bench::kOracleMethod) {
        ScaleMethod oracle = scaleMethodFromName(bench::kReplayedMethod);
        oracle.name = name;
        oracle.replaysVerdicts = true;
        return oracle;
    }
    const std::size_t plus = name.find('+');
    const std::string base = name.substr(0, plus);
    const std::string suffixes = plus == std::string::npos ? std::string() : name.substr(plus);
    const auto method = methodFromName(base);
    const bool isRival = rivals::ruleFromName(base).has_value();
    const bool isPlain = suffixes.empty();
    const bool hasBins = isRival || (method && *method != Method::Sphere && *method != Method::None);
    const bool isKnown = isPlain || suffixes == "+horizon" || suffixes == "+edges" || suffixes == "+horizon+edges";
    if (!(method || isRival) || !isKnown || (!hasBins && !isPlain))
        throw UsageError("--methods: unknown method \"" + name +
                         "\"; use none, sphere, oracle, or quadratic, exact, box, orientedbox, paper or corners with "
                         "+horizon, +edges or +horizon+edges after it");
    if (!hasBins) return {name, "method=" + base, "analyticbin", *method == Method::None};
    const bool usesHorizon = suffixes.find("+horizon") != std::string::npos;
    const bool usesEdges = suffixes.find("+edges") != std::string::npos;
    return {
        name,
        "method=" + base + ",horizon=" + (usesHorizon ? "declared" : "off") + ",edges=" + (usesEdges ? "on" : "off"),
        isRival ? "binrival" : "analyticbin"};
}

bool settingsFromCommandLine(int argc, char** argv, Settings& settings) {
    CLI::App app{"Measures how culling scales with the depth of a database and with what is in memory.",
                 "osgbinbench scale"};
    app.set_version_flag("--version", std::string("osgbinbench scale (osgAnalyticBin) ") + osgAnalyticBin::version());
    Words words;
    declare(app, settings, words);
    if (!support::parseCommandLine(app, argc, argv)) return false;
    takeSeries(words.series, settings);
    for (const std::string& name : words.methods) settings.methods.push_back(scaleMethodFromName(name));
    if (settings.cells % 2 != 0)
        throw UsageError("--cells: " + std::to_string(settings.cells) + " is odd; give an even number");
    support::requireFolderOf("--csv", settings.csv);
    support::requireFolderOf("--json", settings.json);
    if (!settings.plot.empty()) support::makeFolder("--plot", settings.plot);
    return true;
}

}  // namespace osgAnalyticBin::scale
