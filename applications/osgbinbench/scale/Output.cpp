// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Output.h"

#include "Table.h"

#include <algorithm>
#include <ostream>

namespace osgAnalyticBin::scale {

namespace {

using report::Json;

Json jsonOf(const TileTally& tiles) {
    return {{"tested_tiles", tiles.tested},
            {"kept_tiles", tiles.kept},
            {"drawn_tiles", tiles.drawn},
            {"deepest_tiles", tiles.leaves}};
}

Json jsonOf(const DepthRow& row) {
    Json json{{"levels", row.levels}, {"method", row.method}};
    json.update(jsonOf(row.tiles));
    json["cull_ms"] = row.cullMs;
    json["cull_spread_ms"] = row.cullSpreadMs;
    json["cull_us_per_drawn_tile"] = row.usPerDrawnTile();
    return json;
}

Json jsonOf(const ResidentRow& row) {
    Json json{{"paged_lods", row.pagedLods}, {"method", row.method}};
    json.update(jsonOf(row.tiles));
    json["cull_ms"] = row.cullMs;
    json["cull_spread_ms"] = row.cullSpreadMs;
    json["update_ms"] = row.updateMs;
    json["pager_below_target_ms"] = row.pagerIdleMs;
    json["pager_above_target_ms"] = row.pagerFullMs;
    return json;
}

Json jsonOf(const MemoryRow& row) {
    return {{"method", row.method},
            {"tiles", row.tiles},
            {"bytes_per_tile", row.bytesPerTile},
            {"load_us_per_tile", row.loadUsPerTile}};
}

template <class Row>
Json listOf(const std::vector<Row>& rows) {
    Json list = Json::array();
    for (const Row& row : rows) list.push_back(jsonOf(row));
    return list;
}

// Every method with the value of its first row and that of its last.
template <class Row, class Value>
Json ratiosOf(std::vector<Row> rows, const Value& value) {
    Json ratios = Json::object();
    for (const Row& last : rows) {
        const auto first =
            std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.method == last.method; });
        if (value(*first) > 0.0) ratios[last.method] = value(last) / value(*first);
    }
    return ratios;
}

Json depthRatios(std::vector<DepthRow> rows) {
    const auto isShallow = [](const DepthRow& row) { return row.levels < 8; };
    if (!std::all_of(rows.begin(), rows.end(), isShallow))
        rows.erase(std::remove_if(rows.begin(), rows.end(), isShallow), rows.end());
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.levels < b.levels; });
    return ratiosOf(rows, [](const DepthRow& row) { return row.usPerDrawnTile(); });
}

Json residentRatios(std::vector<ResidentRow> rows) {
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.pagedLods < b.pagedLods; });
    return ratiosOf(rows, [](const ResidentRow& row) { return row.cullMs; });
}

Json listsOf(const Results& results) {
    return {
        {"depth", listOf(results.depth)}, {"residents", listOf(results.residents)}, {"memory", listOf(results.memory)}};
}

}  // namespace

std::string csvOf(const Results& results) {
    std::vector<Json> rows;
    const Json lists = listsOf(results);
    for (const auto& list : lists.items()) {
        for (const Json& row : list.value()) {
            rows.push_back({{"series", list.key()}});
            rows.back().update(row);
        }
    }
    return report::csvOf(rows);
}

std::string jsonOf(const Settings& settings, const Results& results) {
    Json json{{"poses", settings.poses}, {"cells", settings.cells}, {"rounds", settings.rounds}};
    json.update(listsOf(results));
    json["ratios"] = {{"cull_us_per_drawn_tile", depthRatios(results.depth)},
                      {"cull_ms_by_residents", residentRatios(results.residents)}};
    return json.dump(2) + "\n";
}

void printTables(std::ostream& output, const Results& results) {
    constexpr std::size_t kNameColumns = 2;
    const Json lists = listsOf(results);
    for (const auto& list : lists.items()) {
        if (list.value().empty()) continue;
        report::TextTable table(kNameColumns);
        std::vector<std::string> titles;
        for (const auto& item : list.value().front().items()) titles.push_back(item.key());
        table.add(std::move(titles));
        for (const auto& row : list.value()) {
            std::vector<std::string> cells;
            for (const auto& value : row) cells.push_back(report::cellText(value, 4));
            table.add(std::move(cells));
        }
        output << list.key() << '\n';
        table.print(output);
        output << '\n';
    }
}

}  // namespace osgAnalyticBin::scale
