// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Output.h"

#include "CullMethod.h"
#include "Interruption.h"
#include "Table.h"
#include "ThreadingName.h"

#include <osg/Version>

#include <algorithm>
#include <ostream>

namespace osgAnalyticBin::bench {

namespace {

using report::cellText;
using report::Json;
using report::TextTable;

constexpr std::array<const char*, 2> kComparedWith{"sphere", "cluster"};

Json headOf(const Settings& settings, const char* mode) {
    Json json;
    json["mode"] = mode;
    json["database"] = settings.database;
    json["path"] = settings.paths;
    json["options"] = settings.binOptions;
    json["vertical_scale"] = settings.verticalScale;
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["threading"] = flight::threadingName(settings.threading);
    json["flush_mib"] = settings.flush;
    json["expiry"] = settings.expiry;
    json["osg"] = osgGetVersion();
    if (support::stopRequested) json["interrupted"] = true;
    return json;
}

Json sumsOf(const std::vector<MethodFigures>& methods) {
    Json sums;
    for (const MethodFigures& method : methods) sums[method.method] = sumOf(method);
    return sums;
}

Json sumsOf(const std::vector<MethodFigures>& methods, const PathGroup& group) {
    Json sums;
    for (const MethodFigures& method : methods) sums[method.method] = sumOf(method, group);
    return sums;
}

Json byPose(const MethodFigures& method) {
    Json columns;
    for (const Json& row : method.rows)
        for (const auto& [column, value] : row.items()) columns[column].push_back(value);
    return columns;
}

// Gives each method its times as multiples of what culling would cost if tests were free, where that was measured.
void addTimesOverOracle(Json& methods) {
    if (!methods.contains(kOracleMethod)) return;
    for (const auto& [title, column] : {std::pair("over_oracle", kCullColumn), {"cold_over_oracle", kCullColdColumn}}) {
        const double oracle = methods[kOracleMethod][column].get<double>();
        for (Json& sums : methods) sums[title] = report::ratioText(sums[column].get<double>(), oracle);
    }
}

// A column for each method: the longer a table's lines, the harder they are to read.
TextTable tableOf(const std::string& title, const Json& methods, int decimals) {
    TextTable table(1);
    std::vector<std::string> head{title};
    for (const auto& method : methods.items()) head.push_back(method.key());
    table.add(std::move(head));
    for (const auto& figure : methods.front().items()) {
        if (figure.key().find("_spread") != std::string::npos) continue;
        std::vector<std::string> cells{figure.key()};
        for (const Json& sums : methods) cells.push_back(cellText(sums[figure.key()], decimals));
        table.add(std::move(cells));
    }
    return table;
}

void addRatios(std::vector<TextTable>& tables, const Json& methods) {
    for (const char* const name : kComparedWith) {
        if (!methods.contains(name)) continue;
        Json ratios;
        for (const auto& method : methods.items())
            ratios[method.key()] = report::ratiosOf(method.value(), methods[name]);
        tables.push_back(tableOf(std::string("ratio to ") + name, ratios, 0));
    }
}

TextTable tableByPath(const std::vector<PathGroup>& groups, const std::vector<MethodFigures>& methods) {
    std::vector<std::string> columns{"truth_tiles",      "drawn_tiles",     "drawn/truth",
                                     "triangles",        "files_requested", "false_culls",
                                     "differing_pixels", kCullColumn,       kCullColdColumn};
    Json first = sumsOf(methods);
    addTimesOverOracle(first);
    for (const char* const title : {"over_oracle", "cold_over_oracle"})
        if (first.front().contains(title)) columns.emplace_back(title);
    TextTable table(2);
    std::vector<std::string> head{"sums by path", "method"};
    head.insert(head.end(), columns.begin(), columns.end());
    table.add(std::move(head));
    for (const PathGroup& group : groups) {
        table.addGap();
        Json sums = sumsOf(methods, group);
        addTimesOverOracle(sums);
        for (auto& [method, figures] : sums.items()) {
            figures["drawn/truth"] =
                report::ratioText(figures["drawn_tiles"].get<double>(), figures["truth_tiles"].get<double>());
            std::vector<std::string> cells{group.name, method};
            for (const std::string& column : columns) cells.push_back(cellText(figures[column], 3));
            table.add(std::move(cells));
        }
    }
    return table;
}

}  // namespace

std::string csvOf(const std::vector<std::string>& poses, const std::vector<MethodFigures>& methods) {
    std::vector<Json> rows;
    for (std::size_t i = 0; i < methods.front().rows.size(); ++i) {
        for (const MethodFigures& method : methods) {
            Json& row = rows.emplace_back();
            if (!poses.empty()) row["pose"] = poses[i];
            row["method"] = method.method;
            row.update(method.rows[i]);
        }
    }
    return report::csvOf(rows);
}

std::string jsonOf(const Settings& settings, const std::vector<std::string>& poses,
                   const std::vector<MethodFigures>& methods) {
    const bool isFlight = poses.empty();
    Json json = headOf(settings, !isFlight ? "poses" : settings.draw ? "drawn" : settings.jumps ? "jumps" : "flight");
    if (!isFlight) json["poses"] = poses.size();
    json["methods"] = sumsOf(methods);
    for (const PathGroup& group : pathGroupsOf(poses)) {
        Json& path = json["paths"][group.name];
        path["poses"] = group.poses.size();
        path["methods"] = sumsOf(methods, group);
    }
    if (!isFlight) json["pose_names"] = poses;
    for (const MethodFigures& method : methods)
        if (!isFlight) json["by_pose"][method.method] = byPose(method);
    return json.dump(2) + "\n";
}

std::vector<TextTable> tablesOf(const std::vector<std::string>& poses, const std::vector<MethodFigures>& methods) {
    const Json sums = sumsOf(methods);
    Json shown = sums;
    addTimesOverOracle(shown);
    std::vector<TextTable> tables{poses.empty() ? tableOf("paging live", shown, 4)
                                                : tableOf("sums over poses", shown, 3)};
    addRatios(tables, sums);
    const std::vector<PathGroup> groups = pathGroupsOf(poses);
    if (groups.size() > 1) tables.push_back(tableByPath(groups, methods));
    return tables;
}

void print(std::ostream& output, const std::vector<TextTable>& tables) {
    for (const TextTable& table : tables) {
        if (&table != &tables.front()) output << '\n';
        table.print(output);
    }
}

}  // namespace osgAnalyticBin::bench
