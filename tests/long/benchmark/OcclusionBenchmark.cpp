// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "OcclusionBenchmark.h"

#include <osgAnalyticBin/core/occlusion/HorizonBuffer.h>

#include <benchmark/benchmark.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <core/OcclusionScene.h>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

using core::HorizonBuffer;

constexpr std::size_t kCells = 4;
constexpr int kScenes = 6;
constexpr int kRays = 16;

// What a search does for a view, with the plates there already.
class Search {
public:
    explicit Search(Random& random) : _scene(random, false), _frame(frameOf(_scene)) {
        for (const GroundTile& tile : _scene.tiles) _plates.emplace_back(_scene.ellipsoid, tile.mesh, tile.bin);
    }

    [[nodiscard]] std::size_t tiles() const { return _plates.size(); }

    // Returns: the numbers of the hidden quarters, four for each tile.
    [[nodiscard]] std::vector<std::size_t> hidden() const {
        HorizonBuffer buffer = bufferOf(_scene);
        std::vector<std::pair<std::size_t, HorizonBuffer::Outline>> outlines;  // quarters in the picture
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t tile = 0; tile < _plates.size(); ++tile) {
            const core::GeodeticBin& bin = _scene.tiles[tile].bin;
            const core::BinBody body(_scene.ellipsoid, bin, 0.0, _frame);
            if (buffer.isBeside(body.ball())) continue;
            std::size_t quarter = 4 * tile;
            auto hulls = body.quarters();
            _plates[tile].lowerTops(bin, hulls);
            for (const auto& hull : hulls) {
                const HorizonBuffer::Outline outline = buffer.outlineOf(hull);
                if (!outline.isBeside) {
                    order.emplace_back(outline.nearest, outlines.size());
                    outlines.emplace_back(quarter, outline);
                }
                ++quarter;
            }
        }
        std::sort(order.begin(), order.end());
        std::vector<std::size_t> hidden;
        core::EarthColumns columns;
        for (const auto& [nearest, number] : order) {
            const auto& [quarter, outline] = outlines[number];
            if (buffer.hides(outline)) {
                hidden.push_back(quarter);
                continue;
            }
            const double depth = 0.01 * _scene.ellipsoid.equatorialRadius();
            _plates[quarter / 4].columns(kCells, kCells, quarter % 4, depth, _frame, columns);
            buffer.add(columns);
        }
        return hidden;
    }

    [[nodiscard]] bool isRight(Random& random) const {
        for (const std::size_t quarter : hidden()) {
            const core::GeodeticBin& bin = _scene.tiles[quarter / 4].bin;
            const auto [low, high] = bin.altitude();
            const double top = std::clamp(_plates[quarter / 4].most(quarter % 4, bin), low, high);
            const GroundTile part{{}, bin.quarters()[quarter % 4].withAltitude({low, top})};
            for (int ray = 0; ray < kRays; ++ray) {
                const RealVector point = _scene.pointIn(random, part);
                if (isBeforeTheCamera(_scene, point) && !_scene.isBlocked(point)) return false;
            }
        }
        return true;
    }

private:
    OcclusionScene _scene;
    core::InverseFrame _frame;
    std::vector<core::GroundPlates> _plates;
};

}  // namespace

bool addOcclusionBenchmark() {
    Random random(202);
    const auto searches = std::make_shared<std::vector<Search>>();
    for (int i = 0; i < kScenes; ++i) searches->emplace_back(random);
    const bool areRight = std::all_of(searches->begin(), searches->end(),
                                      [&random](const Search& search) { return search.isRight(random); });
    benchmark::RegisterBenchmark("BM_Occlusion", [searches](benchmark::State& state) {
        std::size_t tiles = 0;
        for (auto _ : state) {
            for (const Search& search : *searches) {
                benchmark::DoNotOptimize(search.hidden());
                tiles += search.tiles();
            }
        }
        state.SetItemsProcessed(static_cast<std::int64_t>(tiles));
    });
    return areRight;
}

}  // namespace osgAnalyticBin::test
