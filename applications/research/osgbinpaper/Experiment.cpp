// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Experiment.h"

#include "Table.h"
#include "TextFile.h"

#include <ostream>
#include <tuple>

namespace osgAnalyticBin::paper {

namespace {

using report::Json;

// Metres; a verdict is not blamed for rounding.
constexpr double kRounding = 1e-3;

struct CountColumn {
    const char* name;
    std::uint64_t Counts::*count;
    const char* meaning;
};

constexpr std::array<CountColumn, 7> kColumns{
    {{"tested", &Counts::tested, "tiles tested"},
     {"drawn", &Counts::drawn, "leaves not culled"},
     {"wrong_culls", &Counts::wrongCulls,
      "tiles culled although a point of them, found by sampling, is in the frustum"},
     {"holes", &Counts::holes, "of these, such whose terrain is in view and not behind the globe"},
     {"lost_leaves", &Counts::lostLeaves, "leaves with a point in the frustum that were not drawn"},
     {"wrong_keeps", &Counts::wrongKeeps, "leaves drawn although a plane parts them from the frustum"},
     {"wrong_insides", &Counts::wrongInsides, "tiles found wholly inside although a point of them is outside"}}};

bool isTrulyInside(const core::ExactGeodeticBin& bin, const Camera& camera) {
    for (const core::Plane& plane : camera.planes())
        if (plane.distance(bin.supportPoint(-plane.normal)) < -kRounding) return false;
    return true;
}

// A hole is worse than a tile that nobody misses, and of two of a kind the deeper one.
bool isWorse(const WrongCull& a, const WrongCull& b) {
    return std::tie(a.isHole, a.witness.depth) > std::tie(b.isHole, b.witness.depth);
}

Counts countsOf(Terrain& terrain, const Camera& camera, const TreeTile& tile, Verdict verdict,
                std::optional<WrongCull>& worst) {
    Counts counts;
    counts.tested = isTested(verdict) ? 1 : 0;
    counts.drawn = isKept(verdict) && tile.isLeaf() ? 1 : 0;
    counts.lostLeaves = tile.isLeaf() && tile.witness && !isKept(verdict) ? 1 : 0;
    counts.wrongKeeps = counts.drawn == 1 && tile.isOutside ? 1 : 0;
    counts.wrongInsides = verdict == Verdict::Inside && !isTrulyInside(tile.bins.exact, camera) ? 1 : 0;
    if (verdict != Verdict::Outside || !tile.witness || tile.witness->depth <= kRounding) return counts;
    const auto seen = findTerrainWitness(terrain, tile.box, camera);
    const WrongCull found{camera, tile.box, seen ? *seen : *tile.witness, seen.has_value()};
    counts.wrongCulls = 1;
    counts.holes = found.isHole ? 1 : 0;
    if (!worst || isWorse(found, *worst)) worst = found;
    return counts;
}

/// One camera: the verdicts of all methods against what is proven of the tiles.
void judge(Terrain& terrain, std::size_t kind, std::size_t number, Results& results) {
    const Camera camera = randomCamera(terrain, kind, number);
    const TileTree tree(terrain, camera);
    const Frustum frustum(camera);
    ViewResult& view = results.views[kind];
    ++view.cameras;
    for (const TreeTile& tile : tree.tiles) view.seenLeaves += tile.isLeaf() && tile.witness ? 1U : 0U;
    for (std::size_t method = 0; method < kMethods; ++method) {
        const std::vector<Verdict> verdicts = cull(tree, frustum, static_cast<Method>(method));
        for (std::size_t i = 0; i < verdicts.size(); ++i)
            view.methods[method].add(countsOf(terrain, camera, tree.tiles[i], verdicts[i], results.worst[method]));
    }
}

std::vector<Json> rowsOf(const char* name, const ViewResult& view) {
    std::vector<Json> rows;
    for (std::size_t method = 0; method < kMethods; ++method) {
        Json& row = rows.emplace_back(Json{{"view", name},
                                           {"method", kMethodNames[method]},
                                           {"cameras", view.cameras},
                                           {"seen_leaves", view.seenLeaves}});
        for (const CountColumn& column : kColumns) row[column.name] = view.methods[method].*column.count;
    }
    return rows;
}

}  // namespace

void Counts::add(const Counts& other) noexcept {
    for (const CountColumn& column : kColumns) this->*column.count += other.*column.count;
}

void ViewResult::add(const ViewResult& other) noexcept {
    cameras += other.cameras;
    seenLeaves += other.seenLeaves;
    for (std::size_t method = 0; method < kMethods; ++method) methods[method].add(other.methods[method]);
}

ViewResult Results::sum() const noexcept {
    ViewResult sum;
    for (const ViewResult& view : views) sum.add(view);
    return sum;
}

Results runExperiment(Terrain& terrain, std::size_t cameras, const std::function<void(double)>& progress) {
    Results results;
    for (std::size_t number = 0; number < cameras; ++number) {
        if (progress) progress(static_cast<double>(number) / static_cast<double>(cameras));
        for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) judge(terrain, kind, number, results);
    }
    return results;
}

std::string csvOf(const Results& results) {
    std::vector<Json> rows;
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind)
        for (Json& row : rowsOf(kViewKinds[kind].name, results.views[kind])) rows.push_back(std::move(row));
    return report::csvOf(rows);
}

void printTables(std::ostream& output, const Results& results) {
    report::TextTable table(2);
    const auto add = [&table](const char* name, const ViewResult& view) {
        for (const Json& row : rowsOf(name, view)) table.addRow(row, 0);
        table.addGap();
    };
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) add(kViewKinds[kind].name, results.views[kind]);
    add("all views", results.sum());
    table.print(output);
    for (std::size_t method = 0; method < kMethods; ++method)
        if (const auto& worst = results.worst[method])
            output << kMethodNames[method] << " culls a tile of which a point is "
                   << support::withDecimals(worst->witness.depth * 1e-3, 1) << " km inside the frustum"
                   << (worst->isHole ? ", and in view" : "") << '\n';
}

std::string meaningOfColumns() {
    return report::linesOf(kColumns, 17);
}

}  // namespace osgAnalyticBin::paper
