// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Experiment.h"

#include "Stopwatch.h"
#include "VerdictCheck.h"

namespace osgAnalyticBin::paper {

namespace {

// Trees that are kept for timing: enough tests that their outcomes cannot be learned.
constexpr std::size_t kTimedCameras = 16;

class ViewRun {
public:
    ViewRun(Terrain& terrain, const ExperimentSettings& settings, std::size_t kind, Results& results)
        : _terrain(terrain), _occlusion(terrain), _settings(settings), _kind(kind), _results(results) {}

    void add(std::size_t number) {
        const Camera camera = randomCamera(_terrain, _kind, number, _settings.seed);
        TimedTree tree{TileTree(_terrain, camera, _settings.factor), Frustum(camera)};
        ViewResult& view = _results.views[_kind];
        ++view.cameras;
        countLeaves(tree.tree, view);
        for (std::size_t method = 0; method < kMethods; ++method)
            judge(tree, camera, number, static_cast<Method>(method), view);
        if (_settings.hidesBehindTerrain) hide(tree, camera);
        if (_settings.isTimed && _timed.size() < kTimedCameras) _timed.push_back(std::move(tree));
    }

    void time() {
        for (std::size_t method = 0; method < kMethods; ++method)
            _results.views[_kind].nanoseconds[method] = nanosecondsPerTile(_timed, static_cast<Method>(method));
    }

private:
    static void countLeaves(const TileTree& tree, ViewResult& view) {
        for (const TreeTile& tile : tree.tiles) {
            if (!tile.isLeaf()) continue;
            const auto level = static_cast<std::size_t>(tile.id.level);
            ++view.leaves[level];
            if (tile.witness) ++view.seenLeaves[level];
        }
    }

    void judge(const TimedTree& timed, const Camera& camera, std::size_t number, Method method, ViewResult& view) {
        std::vector<Verdict> verdicts(timed.tree.tiles.size(), Verdict::Untested);
        cull(timed.tree, timed.frustum, method, verdicts);
        VerdictCheck check(_terrain, timed.tree, camera);
        LevelCounts& levels = view.methods[indexOf(method)];
        for (std::size_t tile = 0; tile < verdicts.size(); ++tile)
            levels[static_cast<std::size_t>(timed.tree.tiles[tile].id.level)].add(check.count(tile, verdicts[tile]));
        keepWorst(check.worst(), number, _results.worst[indexOf(method)]);
    }

    void hide(const TimedTree& timed, const Camera& camera) {
        std::vector<Verdict> verdicts(timed.tree.tiles.size(), Verdict::Untested);
        cull(timed.tree, timed.frustum, Method::Exact, verdicts);
        _results.occlusion[_kind].add(_occlusion.count(timed.tree, verdicts, camera));
    }

    void keepWorst(const std::optional<WrongCull>& found, std::size_t number, std::optional<WrongCull>& worst) const {
        if (!found || (worst && !isWorse(*found, *worst))) return;
        worst = found;
        worst->kind = _kind;
        worst->number = number;
    }

    Terrain& _terrain;
    TerrainOcclusion _occlusion;
    const ExperimentSettings& _settings;
    std::size_t _kind;
    Results& _results;
    std::vector<TimedTree> _timed;
};

}  // namespace

ViewResult Results::sum() const noexcept {
    ViewResult sum;
    for (const ViewResult& view : views) {
        sum.add(view);
        for (std::size_t method = 0; method < kMethods; ++method)
            sum.nanoseconds[method] += view.nanoseconds[method] / static_cast<double>(views.size());
    }
    return sum;
}

Results runExperiment(Terrain& terrain, const ExperimentSettings& settings, Progress& progress) {
    Results results;
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) {
        ViewRun run(terrain, settings, kind, results);
        for (std::size_t number = 0; number < settings.cameras; ++number) {
            progress.show(kViewKinds[kind].name, number, settings.cameras);
            run.add(number);
        }
        if (settings.isTimed) run.time();
    }
    progress.finish();
    return results;
}

}  // namespace osgAnalyticBin::paper
