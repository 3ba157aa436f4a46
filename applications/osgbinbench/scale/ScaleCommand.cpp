// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ScaleCommand.h"

#include "CommandLine.h"
#include "CullMethod.h"
#include "CullTimer.h"
#include "ModuleFolder.h"
#include "Nodes.h"
#include "Quantiles.h"
#include "Table.h"
#include "TextFile.h"

#include <glm/trigonometric.hpp>
#include <osg/Notify>
#include <osg/PagedLOD>
#include <osg/Timer>
#include <osgDB/DatabasePager>
#include <osgDB/Options>
#include <osgDB/ReadFile>

#include <GlobeOptions.h>
#include <ProceduralGlobe.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <malloc.h>
#include <memory>
#include <string>
#include <vector>

namespace osgAnalyticBin::scale {

namespace {

using bench::CullMethod;
using bench::FileWatch;
using bench::MethodScene;
using flight::CameraPose;
using report::Json;
using namespace support;
using Scenes = std::vector<std::unique_ptr<MethodScene>>;
using PagedLods = std::vector<osg::ref_ptr<osg::PagedLOD>>;

/// What the command line asks for.
struct Settings {
    std::vector<std::string> methodNames{"sphere", bench::kDefaultMethod, bench::kOracleMethod};
    std::vector<std::string> series{"depth", "residents", "memory"};
    std::vector<int> levels{4, 8, 12, 16, 20};
    std::vector<int> residents{100, 1000, 10000, 100000};
    int memoryTiles = 10000;
    int poses = 12;
    int cells = 8;
    int rounds = 15;
    std::string csv;
    std::string json;

    /// The oracle repeats what bins keep. Throws: Failure for an unknown name.
    [[nodiscard]] std::vector<CullMethod> methods() const {
        std::vector<CullMethod> methods;
        for (const std::string& name : methodNames) {
            const bool isOracle = name == bench::kOracleMethod;
            methods.push_back(bench::cullMethodFromName(isOracle ? bench::kDefaultMethod : name));
            methods.back().name = name;
            methods.back().replaysVerdicts = isOracle;
        }
        return methods;
    }
};

/// A row for each method and measurement.
using Rows = std::vector<Json>;

// A procedural globe, culled by one method without a window.
std::unique_ptr<MethodScene> makeScene(const CullMethod& method, const globe::GlobeOptions& options, FileWatch& watch) {
    bench::Settings settings;
    settings.database = globe::rootFileOf(options);
    settings.binOptions = "index=off";
    auto scene = std::make_unique<MethodScene>(method, settings, watch);
    scene->load();
    scene->pause();
    return scene;
}

void settle(MethodScene& scene, const CameraPose& pose) {
    scene.resume();
    scene.settle(pose);
    scene.pause();
}

/// Stops from 10 000 km above the terrain down to where tiles of the deepest level are near enough.
std::vector<CameraPose> descent(const globe::GlobeOptions& options, int poses) {
    constexpr double kMetresPerDegree = 111195.0;
    constexpr tiles::PositionDeg kStart{46.0, 10.0};
    constexpr double kHighest = 1e7;       // metres above the terrain
    constexpr double kSlant = 2.5;         // metres ahead for each metre up
    constexpr double kFarthestDeg = 20.0;  // but no further round the globe
    constexpr double kFovDeg = 60.0;
    // In front of the camera the line of sight meets the ground within a few tiles of the deepest level.
    const double tile = std::ldexp(tiles::TileLayout::kStartTileDeg, -options.levels) * kMetresPerDegree;
    const globe::ProceduralTerrain terrain(globe::GlobeOptions::kRelief);
    const auto above = [&](const tiles::PositionDeg& at, double metres) {
        return core::Geodetic{glm::radians(at.latitudeDeg), glm::radians(at.longitudeDeg), terrain.height(at) + metres};
    };
    std::vector<CameraPose> path;
    for (int i = 0; i < poses; ++i) {
        const double metres = kHighest * std::pow(0.5 * tile / kHighest, static_cast<double>(i) / (poses - 1));
        const double ahead = std::min(kFarthestDeg, kSlant * metres / kMetresPerDegree);
        path.push_back({"descent_" + std::to_string(i), above(kStart, metres),
                        above({kStart.latitudeDeg + ahead, kStart.longitudeDeg}, 0.0), glm::radians(kFovDeg),
                        0.1 * metres, 100.0 * kHighest});
    }
    return path;
}

PagedLods pagedLodsIn(osg::Node& scene) {
    PagedLods found;
    support::forAllNodes(scene, [&](osg::Node& node) {
        if (auto* const paged = dynamic_cast<osg::PagedLOD*>(&node)) found.emplace_back(paged);
    });
    return found;
}

// Reads the finer children of a PagedLOD and merges them as the DatabasePager does.
PagedLods loadChildren(osg::PagedLOD& node) {
    constexpr unsigned int kFiner = 1;
    const auto* const options = dynamic_cast<const osgDB::Options*>(node.getDatabaseOptions());
    const osg::ref_ptr<osg::Node> file =
        osgDB::readRefNodeFile(node.getDatabasePath() + node.getFileName(kFiner), options);
    if (!file) throw Failure(node.getFileName(kFiner) + ": cannot be made");
    node.addChild(file);
    return pagedLodsIn(*file);
}

// Loads tiles of the hemisphere away from the eye, coarse ones first, until there are that many PagedLODs in all.
// Requires: the scene stands at the pose. Returns: how many there were, and are. Throws: Failure when the globe has no
// more.
std::pair<std::size_t, std::size_t> fill(MethodScene& scene, const CameraPose& pose, std::size_t pagedLods) {
    const osg::Vec3d eye = osg::Matrixd::inverse(scene.camera().getViewMatrix()).getTrans();
    const PagedLods loaded = pagedLodsIn(scene.root());
    std::deque<osg::ref_ptr<osg::PagedLOD>> frontier;
    for (const auto& node : loaded)
        if (osg::Vec3d(node->getCenter()) * eye < 0.0 && node->getNumChildren() == 1) frontier.push_back(node);
    std::size_t count = loaded.size();
    while (count < pagedLods) {
        if (frontier.empty())
            throw Failure("--residents: a globe of this depth has no " + std::to_string(pagedLods) +
                          " PagedLODs away from the eye");
        const PagedLods children = loadChildren(*frontier.front());
        frontier.pop_front();
        frontier.insert(frontier.end(), children.begin(), children.end());
        count += children.size();
    }
    // the next cull traversal notices what was loaded, and the next update traversal takes care of it
    for (int frame = 0; frame < 2; ++frame) (void)scene.flyFrame(pose, 1.0 / 60.0);
    return {loaded.size(), count};
}

// Milliseconds, first quartile, of the DatabasePager's part of a frame's update, without its threads: of one that has
// all PagedLODs above its target. What is loaded is walked over, but not thrown away.
double pagerMs(MethodScene& scene, int rounds) {
    constexpr double kNever = 1e9;
    for (const auto& node : pagedLodsIn(scene.root()))
        for (unsigned int i = 0; i < node->getNumMinimumExpiryTimes(); ++i) node->setMinimumExpiryTime(i, kNever);
    const osg::ref_ptr<osgDB::DatabasePager> pager = new osgDB::DatabasePager;
    pager->registerPagedLODs(&scene.root(), scene.frameStamp().getFrameNumber());
    pager->setTargetMaximumNumberOfPageLOD(0);
    std::vector<double> times;
    for (int round = 0; round < rounds; ++round) {
        const osg::ElapsedTime begin;
        pager->updateSceneGraph(scene.frameStamp());
        times.push_back(begin.elapsedTime_m());
    }
    return support::Quantiles(times).at(1, 4);
}

double allocatedBytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

Json memoryOf(const std::string& name, const CullMethod& method, int tiles, bool storesBins, FileWatch& watch) {
    std::cerr << "osgbinbench scale: memory, " << name << std::endl;
    const CameraPose far{"far", {0.0, 0.0, 1e8}, {0.0, 0.0, 0.0}, 1.0, 1.0, 1e9};
    globe::GlobeOptions options;
    options.bins = storesBins;
    const auto scene = makeScene(method, options, watch);
    settle(*scene, far);
    // The start tiles and what is loaded only once do not count.
    const std::size_t start = pagedLodsIn(scene->root()).size();
    const double bytes = allocatedBytes();
    const osg::ElapsedTime begin;
    const auto [before, after] = fill(*scene, far, start + static_cast<std::size_t>(tiles));
    const double us = begin.elapsedTime_u();
    const double more = allocatedBytes() - bytes;
    const auto loaded = static_cast<double>(after - before);
    return {{"method", name},
            {"tiles", after - before},
            {"bytes_per_tile", more / loaded},
            {"load_us_per_tile", us / loaded}};
}

void addCounts(MethodScene& scene, Json& row) {
    const flight::Census census = scene.census();
    for (const auto& [column, count] :
         {std::pair("tested_tiles", census.tested), {"kept_tiles", census.kept}, {"drawn_tiles", census.drawn}})
        row[column] = row.value(column, std::uint64_t{0}) + count;
}

void addTimes(const Scenes& scenes, int rounds, Rows& rows) {
    const std::vector<bench::CullTimes> times = bench::cullTimes(scenes, rounds, 0);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (const auto& [column, ms] :
             {std::pair("cull_ms", times[i].warm.firstQuartile), {"cull_spread_ms", times[i].warm.spread}})
            rows[i][column] = rows[i].value(column, 0.0) + ms;
}

/// Each method on flights down globes of several depths; sums over the poses. Throws: Failure.
Rows measureDepth(const Settings& settings, FileWatch& watch) {
    Scenes scenes;
    Rows rows;
    std::vector<std::vector<CameraPose>> paths;
    for (const int levels : settings.levels) {
        globe::GlobeOptions options;
        options.levels = levels;
        options.cells = settings.cells;
        for (const CullMethod& method : settings.methods()) {
            scenes.push_back(makeScene(method, options, watch));
            paths.push_back(descent(options, settings.poses));
            rows.push_back({{"levels", levels}, {"method", method.name}});
        }
    }
    for (int pose = 0; pose < settings.poses; ++pose) {
        std::cerr << "osgbinbench scale: depth, pose " << pose + 1 << " of " << settings.poses << std::endl;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            MethodScene& scene = *scenes[i];
            const bool isReplayed = scene.method().replaysVerdicts;
            // a replay serves one view alone
            if (isReplayed && pose > 0) scene.load();
            settle(scene, paths[i][static_cast<std::size_t>(pose)]);
            if (isReplayed) scene.replayVerdicts();
            addCounts(scene, rows[i]);
        }
        addTimes(scenes, settings.rounds, rows);
    }
    for (Json& row : rows)
        row["cull_us_per_drawn_tile"] =
            1000.0 * row["cull_ms"].get<double>() / std::max(1.0, row["drawn_tiles"].get<double>());
    return rows;
}

/// Each method with several numbers of PagedLODs in memory; also the DatabasePager's update with more PagedLODs than
/// its target, none of which may go yet. Throws: Failure.
Rows measureResidents(const Settings& settings, FileWatch& watch) {
    // From 1000 km up, obliquely.
    const CameraPose view{"resident",
                          {glm::radians(46.0), glm::radians(10.0), 1e6},
                          {glm::radians(52.0), glm::radians(10.0), 0.0},
                          glm::radians(30.0),
                          1e4,
                          1e8};
    // Deep enough for a million tiles on half of the globe, with meshes as small as they get.
    globe::GlobeOptions options;
    options.levels = 9;
    options.cells = 2;
    Scenes scenes;
    Rows rows;
    for (const int residents : settings.residents) {
        std::cerr << "osgbinbench scale: loading " << residents << " PagedLODs" << std::endl;
        for (const CullMethod& method : settings.methods()) {
            MethodScene& scene = *scenes.emplace_back(makeScene(method, options, watch));
            settle(scene, view);
            const std::size_t pagedLods = fill(scene, view, static_cast<std::size_t>(residents)).second;
            rows.push_back({{"paged_lods", pagedLods}, {"method", method.name}});
            if (method.replaysVerdicts) scene.replayVerdicts();
            addCounts(scene, rows.back());
        }
    }
    std::cerr << "osgbinbench scale: residents, timing" << std::endl;
    addTimes(scenes, settings.rounds, rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i]["pager_above_target_ms"] = pagerMs(*scenes[i], settings.rounds);
    return rows;
}

/// What tiles in memory take by what is installed on them, and the time of making and installing one, in the pager's
/// thread as a rule. Throws: Failure.
Rows measureMemory(const Settings& settings, FileWatch& watch) {
    const CullMethod sphere = bench::cullMethodFromName("sphere");
    Rows rows{memoryOf("no bins", sphere, settings.memoryTiles, false, watch),
              memoryOf("stored bins", sphere, settings.memoryTiles, true, watch)};
    for (const CullMethod& method : settings.methods())
        if (method.name != sphere.name && !method.replaysVerdicts)
            rows.push_back(memoryOf(method.name, method, settings.memoryTiles, true, watch));
    return rows;
}

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
    "  osgbinbench scale --levels 8,20 --residents 1000,100000 --json scale.json";

void declare(CLI::App& app, Settings& settings) {
    support::addList(app, "--series", settings.series, "comma-separated: depth, residents, memory (default: all)");
    support::addList(app, "--methods", settings.methodNames, "comma-separated (default: sphere,bins,oracle)");
    support::addList(app, "--levels", settings.levels, "numbers of levels, 0 to 24 (default 4,8,12,16,20)")
        ->check(CLI::Range(0, 24));
    support::addList(app, "--residents", settings.residents,
                     "PagedLODs in memory, at least, 1 to 1000000\n(default 100,1000,10000,100000)")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--memory-tiles", settings.memoryTiles, "tiles whose memory is counted (default 10000)")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--poses", settings.poses, "stops of the flight (default 12)")->check(CLI::Range(2, 1000));
    app.add_option("--cells", settings.cells, "cells along a tile's edge, even (default 8)")->check(CLI::Range(2, 64));
    app.add_option("--rounds", settings.rounds, "rounds of three timed traversals each (default 15)")
        ->check(CLI::Range(1, 10000));
    app.add_option("--csv", settings.csv, "file for the figures, a line for each method and measurement");
    app.add_option("--json", settings.json, "file for the figures");
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
    const osg::ref_ptr<FileWatch> watch = new FileWatch;
    watch->install();
    const auto rowsOf = [&](const char* name, Rows (*series)(const Settings&, FileWatch&)) {
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
