// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Bench.h"
#include "BenchViewer.h"
#include "CullTimer.h"
#include "Failure.h"
#include "MethodScene.h"
#include "ProgressLine.h"
#include "TextFile.h"
#include "TileTruth.h"

#include <osg/ClearNode>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osgDB/WriteFile>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

namespace osgAnalyticBin::bench {

using support::Failure;

namespace {

constexpr const char* kVertexShader = "void main() { gl_Position = ftransform(); }\n";
constexpr const char* kFragmentShader = "uniform vec4 tileColour;\nvoid main() { gl_FragColor = tileColour; }\n";
constexpr unsigned int kOverride = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;

// Numbers from 1 on as colours of 8 bits a channel; 0 is the background.
osg::Vec4 colourOf(std::uint32_t number) {
    const auto channel = [number](unsigned int shift) {
        return static_cast<float>((number >> shift) & 0xFFU) / 255.0F;
    };
    return {channel(0), channel(8), channel(16), 1.0F};
}

std::uint32_t numberOf(const unsigned char* colour) {
    return colour[0] | static_cast<std::uint32_t>(colour[1]) << 8U | static_cast<std::uint32_t>(colour[2]) << 16U;
}

osg::ref_ptr<osg::Group> paintedScene(const std::vector<flight::DrawnTile>& tiles) {
    // A node of its own, because the viewer's background is blue.
    osg::ref_ptr<osg::ClearNode> scene = new osg::ClearNode;
    scene->setClearColor(osg::Vec4(0.0F, 0.0F, 0.0F, 0.0F));
    const osg::ref_ptr<osg::Program> flat = new osg::Program;
    flat->addShader(new osg::Shader(osg::Shader::VERTEX, kVertexShader));
    flat->addShader(new osg::Shader(osg::Shader::FRAGMENT, kFragmentShader));
    scene->getOrCreateStateSet()->setAttributeAndModes(flat, kOverride);
    scene->getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    std::uint32_t number = 0;
    for (const flight::DrawnTile& tile : tiles) {
        const osg::ref_ptr<osg::Uniform> colour = new osg::Uniform("tileColour", colourOf(++number));
        for (const flight::DrawnMesh& mesh : tile.meshes) {
            const osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform(mesh.localToWorld);
            placed->addChild(mesh.drawable);
            placed->getOrCreateStateSet()->addUniform(colour, kOverride);
            scene->addChild(placed);
        }
    }
    return scene;
}

/// Finds out which tiles can be seen: draws every mesh in a flat colour of its tile's own, without light, texture or
/// culling, and counts the pixels of each colour. Skirts are drawn and count like any other part of a mesh; what is
/// smaller than a pixel may be missed.
/// Returns: the pixels of every tile that has one, by key. Throws: Failure when the picture does not come.
std::map<std::string, std::uint64_t> visiblePixels(BenchViewer& viewer, const std::vector<flight::DrawnTile>& tiles,
                                                   const osg::Camera& view) {
    const osg::ref_ptr<osg::Image> picture =
        viewer.pictureOf(*paintedScene(tiles), view, osg::CullSettings::NO_CULLING);
    std::map<std::string, std::uint64_t> pixels;
    for (int row = 0; row < picture->t(); ++row) {
        for (int column = 0; column < picture->s(); ++column) {
            const std::uint32_t number =
                numberOf(picture->data(static_cast<unsigned int>(column), static_cast<unsigned int>(row)));
            if (number > 0 && number <= tiles.size()) ++pixels[tiles[number - 1].key];
        }
    }
    return pixels;
}

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

class PoseBench {
public:
    PoseBench(const Settings& settings, const std::vector<CullMethod>& methods, FileWatch& watch)
        : _settings(settings),
          _watch(watch),
          _viewer(settings.width, settings.height, settings.threading),
          _binScene(binMethod(), settings, watch) {
        for (const CullMethod& method : methods)
            _scenes.push_back(std::make_unique<MethodScene>(method, settings, watch));
    }

    [[nodiscard]] PoseFigures run(const std::vector<flight::CameraPose>& path) {
        Measurement measured;
        for (const auto& scene : _scenes) measured.methods.push_back({scene->method().name, {}});
        support::ProgressLine progress(stderr);
        for (std::size_t i = 0; i < path.size() && !support::stopRequested; ++i) {
            progress.show(static_cast<double>(i) / static_cast<double>(path.size()),
                          "osgbinbench: pose " + std::to_string(i + 1) + " of " + std::to_string(path.size()) + ", " +
                              path[i].name + ", ");
            try {
                const std::vector<report::Json> rows = measure(path[i]);
                for (std::size_t m = 0; m < rows.size(); ++m) measured.methods[m].rows.push_back(rows[m]);
                measured.poses.push_back(path[i].name);
            } catch (const support::Interrupted&) {
                break;
            }
        }
        if (measured.poses.empty()) throw support::Interrupted("interrupted before the first pose was measured");
        return {std::move(measured), std::move(_pictures)};
    }

private:
    // What one method did at the present pose.
    struct Visit {
        flight::Census census;
        osg::ref_ptr<osg::Image> picture;
        std::uint64_t residentTiles = 0;
        std::uint64_t files = 0;
        std::uint64_t bytes = 0;
    };

    [[nodiscard]] Visit visit(MethodScene& scene, const flight::CameraPose& pose) {
        scene.load();
        Visit visit;
        const std::uint64_t files = _watch.nodeFiles();
        const std::uint64_t bytes = _watch.nodeBytes();
        scene.settle(pose);
        // whatever its picture asks for is not read in the next scene's turn
        scene.pause();
        visit.files = _watch.nodeFiles() - files;
        visit.bytes = _watch.nodeBytes() - bytes;
        if (scene.method().replaysVerdicts) scene.replayVerdicts();
        visit.census = scene.census();
        visit.residentTiles = flight::residentTiles(scene.root());
        visit.picture = _viewer.pictureOf(scene.root(), scene.camera(), scene.camera().getCullingMode());
        if (!_settings.pictures.empty()) savePicture(*visit.picture, scene.method().name, pose.name);
        return visit;
    }

    void checkReplays(const std::vector<Visit>& visits, const std::string& pose) const {
        const flight::Census* original = nullptr;
        for (std::size_t i = 0; i < visits.size(); ++i) {
            const CullMethod& method = _scenes[i]->method();
            if (method.name == kReplayedMethod) original = &visits[i].census;
            if (!method.replaysVerdicts) continue;
            const flight::Census& replay = visits[i].census;
            if (replay.keys() == original->keys() && replay.drawables == original->drawables) continue;
            throw Failure("pose " + pose + ": " + kOracleMethod + " draws other tiles (" +
                          std::to_string(replay.tiles.size()) + ") than " + kReplayedMethod + " (" +
                          std::to_string(original->tiles.size()) + "); leave " + kOracleMethod + " out");
        }
    }

    void learnBins(const flight::CameraPose& pose) {
        if (!_isBinSceneLoaded || flight::residentTiles(_binScene.root()) > kMostBinTiles)
            _binScene.load();
        else
            _binScene.resume();
        _isBinSceneLoaded = true;
        _binScene.settle(pose);
        _truth.learnBins(_binScene.census().tiles);
    }

    [[nodiscard]] std::vector<report::Json> measure(const flight::CameraPose& pose) {
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
            row["differing_pixels"] = differingPixels(*reference.picture, *visits[i].picture);
            row[kCullColumn] = times[i].warm.median;
            row["cull_spread_ms"] = times[i].warm.spread;
            row[kCullColdColumn] = times[i].cold.median;
            row["cull_cold_spread_ms"] = times[i].cold.spread;
        }
        return rows;
    }

    void savePicture(const osg::Image& picture, const std::string& method, const std::string& pose) const {
        const std::filesystem::path folder = std::filesystem::path(_settings.pictures) / method;
        const std::string file = (folder / (pose + ".png")).string();
        support::makeFolder(folder.string());
        if (!osgDB::writeImageFile(picture, file)) throw Failure(file + ": the picture cannot be saved");
    }

    const Settings& _settings;
    FileWatch& _watch;
    BenchViewer _viewer;
    std::vector<std::unique_ptr<MethodScene>> _scenes;
    // All tiles of a pose with their bins; what it has loaded it keeps for the next pose.
    MethodScene _binScene;
    bool _isBinSceneLoaded = false;
    TileTruth _truth;
    std::vector<Picture> _pictures;
};

}  // namespace

PoseFigures measureAtPoses(const Settings& settings, const std::vector<CullMethod>& methods,
                           const std::vector<flight::CameraPose>& path, FileWatch& watch) {
    return PoseBench(settings, methods, watch).run(path);
}

}  // namespace osgAnalyticBin::bench
