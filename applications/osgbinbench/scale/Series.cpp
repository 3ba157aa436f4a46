// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Series.h"

#include "Angles.h"
#include "ScaleScene.h"

#include <osgDB/DatabasePager>

#include <ProceduralTerrain.h>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <malloc.h>
#include <memory>

namespace osgAnalyticBin::scale {

namespace {

using flight::CameraPose;
using report::Diagram;
using report::Json;
using support::kRadiansPerDegree;
using Scenes = std::vector<std::unique_ptr<ScaleScene>>;

// Stops from 10 000 km above the terrain down to where tiles of the deepest level are near enough.
std::vector<CameraPose> descent(const globe::GlobeOptions& options, int poses) {
    constexpr double kMetresPerDegree = 111195.0;
    constexpr osgbindem::PositionDeg kStart{46.0, 10.0};
    constexpr double kHighest = 1e7;       // metres above the terrain
    constexpr double kSlant = 2.5;         // metres ahead for each metre up
    constexpr double kFarthestDeg = 20.0;  // but no further round the globe
    constexpr double kFovDeg = 60.0;
    // In front of the camera the line of sight meets the ground within a few tiles of the deepest level.
    const double tile = std::ldexp(osgbindem::TileLayout::kStartTileDeg, -options.levels) * kMetresPerDegree;
    const globe::ProceduralTerrain terrain(options.relief);
    const auto above = [&](const osgbindem::PositionDeg& at, double metres) {
        return core::Geodetic{at.latitudeDeg * kRadiansPerDegree, at.longitudeDeg * kRadiansPerDegree,
                              terrain.height(at) + metres};
    };
    std::vector<CameraPose> path;
    for (int i = 0; i < poses; ++i) {
        const double metres = kHighest * std::pow(0.5 * tile / kHighest, static_cast<double>(i) / (poses - 1));
        const double ahead = std::min(kFarthestDeg, kSlant * metres / kMetresPerDegree);
        path.push_back({"descent_" + std::to_string(i), above(kStart, metres),
                        above({kStart.latitudeDeg + ahead, kStart.longitudeDeg}, 0.0), kFovDeg * kRadiansPerDegree,
                        0.1 * metres, 100.0 * kHighest});
    }
    return path;
}

// The DatabasePager's part of a frame's update, without its threads.
class PagerUpdate : public osg::NodeVisitor {
public:
    explicit PagerUpdate(ScaleScene& scene)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _scene(scene), _pager(new osgDB::DatabasePager) {
        scene.root().accept(*this);
        _pager->registerPagedLODs(&scene.root(), scene.frameStamp().getFrameNumber());
    }

    // What is loaded is walked over, but not thrown away.
    using osg::NodeVisitor::apply;
    void apply(osg::PagedLOD& node) override {
        constexpr double kNever = 1e9;
        for (unsigned int i = 0; i < node.getNumMinimumExpiryTimes(); ++i) node.setMinimumExpiryTime(i, kNever);
        traverse(node);
    }

    void setTarget(unsigned int pagedLods) { _pager->setTargetMaximumNumberOfPageLOD(pagedLods); }

    [[nodiscard]] double ms() {
        const Stopwatch watch;
        _pager->updateSceneGraph(_scene.frameStamp());
        return watch.ms();
    }

private:
    ScaleScene& _scene;
    osg::ref_ptr<osgDB::DatabasePager> _pager;
};

double allocatedBytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

Json memoryOf(const std::string& name, const bench::CullMethod& method, int tiles, bool storesBins) {
    std::cerr << "osgbinbench scale: memory, " << name << std::endl;
    globe::GlobeOptions options;
    options.bins = storesBins;
    bench::FileWatch files;
    ScaleScene scene(method, options, files);
    scene.settle({"far", {0.0, 0.0, 1e8}, {0.0, 0.0, 0.0}, 1.0, 1.0, 1e9});
    // What is loaded once, and the start tiles, do not count.
    const std::size_t before = scene.pagedLods();
    const double bytes = allocatedBytes();
    const Stopwatch watch;
    scene.fill(before + static_cast<std::size_t>(tiles));
    const double us = 1000.0 * watch.ms();
    const double more = allocatedBytes() - bytes;
    const auto loaded = static_cast<double>(scene.pagedLods() - before);
    return {{"method", name},
            {"tiles", scene.pagedLods() - before},
            {"bytes_per_tile", more / loaded},
            {"load_us_per_tile", us / loaded}};
}

Diagram diagramOf(const std::string& name, const std::string& commands, const std::vector<Json>& rows) {
    const std::string common = "set datafile separator ','\nset key bottom right\nset grid\nset yrange [0:*]\n";
    return {name, report::csvOf(rows), report::drawnTwice(name, "size 800,500 noenhanced", common + commands)};
}

// A line for each method, through the points of its rows; each method has a column.
Diagram lines(const std::string& name, const std::string& commands, const Rows& rows, const char* x, const char* y) {
    std::vector<Json> points;
    for (const Json& row : rows) {
        auto point = std::find_if(points.begin(), points.end(), [&](const Json& p) { return p["x"] == row[x]; });
        if (point == points.end()) point = points.insert(points.end(), Json{{"x", row[x]}});
        (*point)[row["method"].get<std::string>()] = row[y];
    }
    std::size_t columns = 1;
    for (const Json& point : points) columns = std::max(columns, point.size());
    return diagramOf(name,
                     commands + "plot for [i=2:" + std::to_string(columns) +
                         "] name.'.csv' using 1:i with linespoints title columnhead(i)\n",
                     points);
}

}  // namespace

std::vector<bench::CullMethod> Settings::methods() const {
    std::vector<bench::CullMethod> methods;
    for (const std::string& name : methodNames) {
        const bool isOracle = name == bench::kOracleMethod;
        methods.push_back(bench::cullMethodFromName(isOracle ? bench::kDefaultMethod : name));
        methods.back().name = name;
        methods.back().replaysVerdicts = isOracle;
    }
    return methods;
}

Rows measureDepth(const Settings& settings) {
    bench::FileWatch files;
    Scenes scenes;
    Rows rows;
    std::vector<std::vector<CameraPose>> paths;
    for (const int levels : settings.levels) {
        globe::GlobeOptions options;
        options.levels = levels;
        options.cells = settings.cells;
        for (const bench::CullMethod& method : settings.methods()) {
            scenes.push_back(std::make_unique<ScaleScene>(method, options, files));
            paths.push_back(descent(options, settings.poses));
            rows.push_back({{"levels", levels}, {"method", method.name}});
        }
    }
    std::vector<Timing> sums(scenes.size());
    for (int pose = 0; pose < settings.poses; ++pose) {
        std::cerr << "osgbinbench scale: depth, pose " << pose + 1 << " of " << settings.poses << std::endl;
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            scenes[i]->settle(paths[i][static_cast<std::size_t>(pose)]);
            if (scenes[i]->method().replaysVerdicts) scenes[i]->replay();
            scenes[i]->addCounts(rows[i]);
        }
        const auto times = measuredInTurns(scenes, settings.rounds, [](ScaleScene& scene) { return scene.cullMs(); });
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            sums[i].ms += times[i].ms;
            sums[i].spread += times[i].spread;
        }
    }
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const double drawn = std::max(1.0, rows[i]["drawn_tiles"].get<double>());
        rows[i]["cull_ms"] = sums[i].ms;
        rows[i]["cull_spread_ms"] = sums[i].spread;
        rows[i]["cull_us_per_drawn_tile"] = 1000.0 * sums[i].ms / drawn;
    }
    return rows;
}

Rows measureResidents(const Settings& settings) {
    // From 1000 km up, obliquely.
    const CameraPose view{"resident",
                          {46.0 * kRadiansPerDegree, 10.0 * kRadiansPerDegree, 1e6},
                          {52.0 * kRadiansPerDegree, 10.0 * kRadiansPerDegree, 0.0},
                          30.0 * kRadiansPerDegree,
                          1e4,
                          1e8};
    // Deep enough for a million tiles on half of the globe, with meshes as small as they get.
    globe::GlobeOptions options;
    options.levels = 9;
    options.cells = 2;
    bench::FileWatch files;
    Scenes scenes;
    std::vector<std::unique_ptr<PagerUpdate>> pagers;
    Rows rows;
    for (const int residents : settings.residents) {
        std::cerr << "osgbinbench scale: loading " << residents << " PagedLODs" << std::endl;
        for (const bench::CullMethod& method : settings.methods()) {
            ScaleScene& scene = *scenes.emplace_back(std::make_unique<ScaleScene>(method, options, files));
            scene.settle(view);
            scene.fill(static_cast<std::size_t>(residents));
            pagers.push_back(std::make_unique<PagerUpdate>(scene));
            rows.push_back({{"paged_lods", scene.pagedLods()}, {"method", method.name}});
            if (method.replaysVerdicts) scene.replay();
            scene.addCounts(rows.back());
        }
    }
    std::cerr << "osgbinbench scale: residents, timing" << std::endl;
    const auto cull = measuredInTurns(scenes, settings.rounds, [](ScaleScene& scene) { return scene.cullMs(); });
    const auto update = measuredInTurns(scenes, settings.rounds, [](ScaleScene& scene) { return scene.updateMs(); });
    const auto pagerMs = [&](unsigned int target) {
        for (const auto& pager : pagers) pager->setTarget(target);
        return measuredInTurns(pagers, settings.rounds, [](PagerUpdate& pager) { return pager.ms(); });
    };
    const auto idle = pagerMs(std::numeric_limits<unsigned int>::max());
    const auto full = pagerMs(0);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i]["cull_ms"] = cull[i].ms;
        rows[i]["cull_spread_ms"] = cull[i].spread;
        rows[i]["update_ms"] = update[i].ms;
        rows[i]["pager_below_target_ms"] = idle[i].ms;
        rows[i]["pager_above_target_ms"] = full[i].ms;
    }
    return rows;
}

Rows measureMemory(const Settings& settings) {
    const bench::CullMethod sphere = bench::cullMethodFromName("sphere");
    Rows rows{memoryOf("no bins", sphere, settings.memoryTiles, false),
              memoryOf("stored bins", sphere, settings.memoryTiles, true)};
    for (const bench::CullMethod& method : settings.methods())
        if (method.name != sphere.name && !method.replaysVerdicts)
            rows.push_back(memoryOf(method.name, method, settings.memoryTiles, true));
    return rows;
}

std::vector<Diagram> diagramsOf(const Rows& depth, const Rows& residents, const Rows& memory) {
    std::vector<Diagram> diagrams;
    if (!depth.empty()) {
        const std::string levels = "set xlabel 'levels below the start tiles'\n";
        diagrams.push_back(lines("depth",
                                 levels + "set title 'Cull time for each drawn tile'\nset ylabel 'microseconds'\n",
                                 depth, "levels", "cull_us_per_drawn_tile"));
        diagrams.push_back(
            lines("flight",
                  levels + "set title 'Cull time of the flight'\nset ylabel 'milliseconds, one frame at each pose'\n",
                  depth, "levels", "cull_ms"));
    }
    if (!residents.empty())
        diagrams.push_back(lines("residents", R"(set title 'Cull time of one view'
set xlabel 'PagedLODs in memory (logarithmic)'
set logscale x
set rmargin 6
set ylabel 'milliseconds'
)",
                                 residents, "paged_lods", "cull_ms"));
    std::vector<Json> bars;
    for (const Json& row : memory)
        bars.push_back({{"method", row["method"]}, {"KiB", row["bytes_per_tile"].get<double>() / 1024.0}});
    if (!bars.empty())
        diagrams.push_back(diagramOf("memory", R"(set title 'Memory of a tile'
set ylabel 'KiB'
set style fill solid 0.6
set boxwidth 0.6
unset key
set xtics rotate by 20 right
plot name.'.csv' skip 1 using 0:2:xtic(1) with boxes
)",
                                     bars));
    return diagrams;
}

}  // namespace osgAnalyticBin::scale
