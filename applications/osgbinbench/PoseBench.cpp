// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PoseBench.h"

#include "CullTimer.h"
#include "Failure.h"
#include "Interruption.h"
#include "PictureDifference.h"
#include "ProgressLine.h"
#include "TilePainter.h"
#include "VerdictReplay.h"

#include <osgDB/WriteFile>

#include <algorithm>
#include <filesystem>

namespace osgAnalyticBin::bench {

using support::Failure;

namespace {

// With more tiles in memory than this the scene of the bins starts from the root file again.
constexpr std::uint64_t kMostBinTiles = 10000;

// Every tile is reached, each with its bin.
CullMethod binMethod() {
    CullMethod method = cullMethodFromName("exact");
    method.clusters = Clusters::Remove;
    method.cullsNothing = true;
    return method;
}

void addFalseVerdicts(report::Json& row, const flight::Census& census, const NeededTiles& needed,
                      const std::map<std::string, std::uint64_t>& visible) {
    const std::set<std::string> drawn = census.keys();
    std::uint64_t culls = 0, pixelsOfThese = 0;
    for (const auto& [key, pixels] : visible) {
        if (drawn.count(key) != 0) continue;
        ++culls;
        pixelsOfThese += pixels;
    }
    row["false_culls"] = culls;
    row["false_cull_pixels"] = pixelsOfThese;
    row["false_keeps"] =
        std::count_if(drawn.begin(), drawn.end(), [&](const auto& key) { return needed.keys.count(key) == 0; });
}

}  // namespace

PoseBench::PoseBench(const Settings& settings, const std::vector<CullMethod>& methods, FileWatch& watch)
    : _settings(settings),
      _watch(watch),
      _viewer(settings.width, settings.height, settings.threading),
      _binScene(binMethod(), settings, watch) {
    for (const CullMethod& method : methods) _scenes.push_back(std::make_unique<MethodScene>(method, settings, watch));
}

std::vector<MethodFigures> PoseBench::run(const std::vector<flight::CameraPose>& path) {
    std::vector<MethodFigures> methods;
    for (const auto& scene : _scenes) methods.push_back({scene->method().name, {}});
    support::ProgressLine progress(stderr);
    for (std::size_t i = 0; i < path.size() && !support::stopRequested; ++i) {
        progress.show(static_cast<double>(i) / static_cast<double>(path.size()),
                      "osgbinbench: pose " + std::to_string(i + 1) + " of " + std::to_string(path.size()) + ", " +
                          path[i].name + ", ");
        try {
            const std::vector<report::Json> rows = measure(path[i]);
            for (std::size_t m = 0; m < methods.size(); ++m) methods[m].rows.push_back(rows[m]);
        } catch (const support::Interrupted&) {
            break;
        }
    }
    if (methods.front().rows.empty()) throw support::Interrupted("interrupted before the first pose was measured");
    return methods;
}

PoseBench::Visit PoseBench::visit(MethodScene& scene, const flight::CameraPose& pose) {
    scene.load();
    Visit visit;
    const std::uint64_t files = _watch.nodeFiles();
    const std::uint64_t bytes = _watch.nodeBytes();
    scene.settle(pose);
    // whatever its picture asks for is not read in the next scene's turn
    scene.pause();
    visit.files = _watch.nodeFiles() - files;
    visit.bytes = _watch.nodeBytes() - bytes;
    if (scene.method().replaysVerdicts) replayVerdicts(scene.camera(), scene.frameStamp());
    visit.census = scene.census();
    visit.residentTiles = flight::residentTiles(scene.root());
    visit.picture = _viewer.pictureOf(scene.root(), scene.camera(), scene.camera().getCullingMode());
    if (!_settings.pictures.empty()) savePicture(*visit.picture, scene.method().name, pose.name);
    return visit;
}

void PoseBench::checkReplays(const std::vector<Visit>& visits, const std::string& pose) const {
    const flight::Census* original = nullptr;
    for (std::size_t i = 0; i < visits.size(); ++i) {
        const CullMethod& method = _scenes[i]->method();
        if (method.name == kReplayedMethod) original = &visits[i].census;
        if (method.replaysVerdicts) requireSameTiles(visits[i].census, *original, pose);
    }
}

void PoseBench::learnBins(const flight::CameraPose& pose) {
    if (!_isBinSceneLoaded || flight::residentTiles(_binScene.root()) > kMostBinTiles)
        _binScene.load();
    else
        _binScene.resume();
    _isBinSceneLoaded = true;
    _binScene.settle(pose);
    _truth.learnBins(_binScene.census().tiles);
}

std::vector<report::Json> PoseBench::measure(const flight::CameraPose& pose) {
    std::vector<Visit> visits;
    for (const auto& scene : _scenes) visits.push_back(visit(*scene, pose));
    checkReplays(visits, pose.name);
    if (!_settings.report.empty()) _pictures.emplace_back(pose.name, visits.back().picture);
    const Visit& reference = visits.front();
    MethodScene& view = *_scenes.front();
    learnBins(pose);
    const NeededTiles needed = _truth.neededTiles(reference.census.tiles, view.camera(), view.globe());
    const auto visible = visiblePixels(_viewer, reference.census.tiles, view.camera());
    const std::vector<CullTimes> times = cullTimes(_scenes, _settings.repeats, _settings.flush);

    std::vector<report::Json> rows;
    for (std::size_t i = 0; i < visits.size(); ++i) {
        const flight::Census& census = visits[i].census;
        report::Json& row = rows.emplace_back(report::Json{{"truth_tiles", needed.keys.size()},
                                                           {"hidden_tiles", needed.hidden},
                                                           {"visible_tiles", visible.size()},
                                                           {"nodes", census.nodes},
                                                           {"tested_tiles", census.tested},
                                                           {"kept_tiles", census.kept},
                                                           {"drawn_tiles", census.tiles.size()},
                                                           {"drawables", census.drawables},
                                                           {"triangles", census.triangles},
                                                           {"paged_lods", census.pagedLods},
                                                           {"resident_tiles", visits[i].residentTiles},
                                                           {"files_requested", visits[i].files},
                                                           {"bytes", visits[i].bytes}});
        addFalseVerdicts(row, census, needed, visible);
        row["differing_pixels"] = report::compare(*reference.picture, *visits[i].picture).pixels;
        row[kCullColumn] = times[i].warm.median;
        row["cull_spread_ms"] = times[i].warm.spread;
        row[kCullColdColumn] = times[i].cold.median;
        row["cull_cold_spread_ms"] = times[i].cold.spread;
    }
    return rows;
}

void PoseBench::savePicture(const osg::Image& picture, const std::string& method, const std::string& pose) const {
    const std::filesystem::path folder = std::filesystem::path(_settings.pictures) / method;
    const std::string file = (folder / (pose + ".png")).string();
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem || !osgDB::writeImageFile(picture, file)) throw Failure(file + ": the picture cannot be saved");
}

}  // namespace osgAnalyticBin::bench
