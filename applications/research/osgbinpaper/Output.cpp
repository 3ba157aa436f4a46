// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Output.h"

#include "Claims.h"
#include "RowTable.h"
#include "TextFile.h"
#include "TextTable.h"

#include <ostream>

namespace osgAnalyticBin::paper {

using support::withDecimals;

namespace {

using report::Json;
using report::TextTable;

std::vector<std::string> headLine(const std::string& first) {
    std::vector<std::string> cells{first};
    for (const CountColumn& column : kCountColumns) cells.emplace_back(column.name);
    return cells;
}

std::vector<std::string> countLine(const std::string& first, const Counts& counts) {
    std::vector<std::string> cells{first};
    for (const CountColumn& column : kCountColumns) cells.push_back(std::to_string(counts.*column.count));
    return cells;
}

void addView(TextTable& table, const std::string& name, const ViewResult& view) {
    std::vector<std::string> head =
        headLine(name + ": " + std::to_string(view.cameras) + " cameras, " + std::to_string(view.seen()) + " seen");
    head.emplace_back("ns");
    table.add(std::move(head));
    for (std::size_t method = 0; method < kMethods; ++method) {
        std::vector<std::string> cells = countLine(kMethodNames[method], sumOf(view.methods[method]));
        cells.push_back(withDecimals(view.nanoseconds[method], 1));
        table.add(std::move(cells));
    }
    table.addGap();
}

void addLevels(TextTable& table, const ViewResult& sum, int levels) {
    std::vector<std::string> head{"tested / kept / drawn, all views", "width", "seen"};
    for (const char* const name : kMethodNames) head.emplace_back(name);
    table.add(std::move(head));
    for (std::size_t level = 0; level <= static_cast<std::size_t>(levels); ++level) {
        std::vector<std::string> cells{"level " + std::to_string(level),
                                       withDecimals(std::ldexp(22.5, -static_cast<int>(level)), 2) + " deg",
                                       std::to_string(sum.seenLeaves[level])};
        for (const LevelCounts& counts : sum.methods) {
            cells.push_back(std::to_string(counts[level].tested) + "/" + std::to_string(counts[level].kept) + "/" +
                            std::to_string(counts[level].drawn));
        }
        table.add(std::move(cells));
    }
}

Json jsonOf(const Counts& counts) {
    Json json;
    for (const CountColumn& column : kCountColumns) json[column.name] = counts.*column.count;
    return json;
}

Json jsonOf(const ViewResult& view) {
    Json json;
    json["cameras"] = view.cameras;
    json["seen_leaves"] = view.seen();
    for (std::size_t method = 0; method < kMethods; ++method) {
        Json& sums = json["methods"][kMethodNames[method]];
        sums = jsonOf(sumOf(view.methods[method]));
        sums["ns"] = view.nanoseconds[method];
    }
    return json;
}

void addOcclusion(TextTable& table, const std::string& name, const OcclusionCounts& counts) {
    table.add({name, std::to_string(counts.cameras), std::to_string(counts.drawn), std::to_string(counts.hidden),
               std::to_string(counts.seenHidden)});
}

// Empty unless it was asked for.
TextTable occlusionTable(const Results& results) {
    TextTable table(1);
    OcclusionCounts sum;
    for (const OcclusionCounts& counts : results.occlusion) sum.add(counts);
    if (sum.cameras == 0) return table;
    table.add({"behind terrain", "cameras", "drawn by exact", "hidden", "hidden but seen"});
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind)
        addOcclusion(table, kViewKinds[kind].name, results.occlusion[kind]);
    addOcclusion(table, "all views", sum);
    table.addGap();
    return table;
}

Json jsonOf(const OcclusionCounts& counts) {
    return {{"cameras", counts.cameras},
            {"drawn", counts.drawn},
            {"hidden", counts.hidden},
            {"hidden_but_seen", counts.seenHidden}};
}

Json jsonOf(const WrongCull& worst) {
    return {{"view", kViewKinds[worst.kind].name},
            {"camera", worst.number},
            {"level", worst.tile.level},
            {"x", worst.tile.x},
            {"y", worst.tile.y},
            {"depth_m", worst.depth},
            {"in_picture", worst.isHole}};
}

}  // namespace

std::string csvOf(const Results& results, int levels) {
    std::vector<Json> rows;
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind) {
        const ViewResult& view = results.views[kind];
        for (std::size_t level = 0; level <= static_cast<std::size_t>(levels); ++level) {
            for (std::size_t method = 0; method < kMethods; ++method) {
                rows.push_back({{"view", kViewKinds[kind].name},
                                {"level", level},
                                {"method", kMethodNames[method]},
                                {"cameras", view.cameras},
                                {"seen_leaves", view.seenLeaves[level]}});
                rows.back().update(jsonOf(view.methods[method][level]));
            }
        }
    }
    return report::csvOf(rows);
}

std::string jsonOf(const Settings& settings, const Results& results) {
    Json json;
    json["dem"] = settings.dem;
    json["levels"] = settings.levels;
    json["floor_m"] = settings.floor;
    json["factor"] = settings.experiment.factor;
    json["seed"] = settings.experiment.seed;
    json.update(jsonOf(results.sum()));
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind)
        json["views"][kViewKinds[kind].name] = jsonOf(results.views[kind]);
    for (std::size_t kind = 0; kind < kViewKinds.size() && settings.experiment.hidesBehindTerrain; ++kind)
        json["occlusion"][kViewKinds[kind].name] = jsonOf(results.occlusion[kind]);
    for (std::size_t method = 0; method < kMethods; ++method) {
        if (results.worst[method]) json["worst"][kMethodNames[method]] = jsonOf(*results.worst[method]);
    }
    json["findings"] = findings(results);
    return json.dump(2) + "\n";
}

void printTables(std::ostream& output, const Results& results, int levels) {
    TextTable views(1);
    for (std::size_t kind = 0; kind < kViewKinds.size(); ++kind)
        addView(views, kViewKinds[kind].name, results.views[kind]);
    addView(views, "all views", results.sum());
    views.print(output);
    occlusionTable(results).print(output);
    TextTable byLevel(1);
    addLevels(byLevel, results.sum(), levels);
    byLevel.print(output);
    output << '\n';
    for (const std::string& line : findings(results)) output << line << '\n';
}

}  // namespace osgAnalyticBin::paper
