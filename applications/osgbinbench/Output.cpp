// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Output.h"

#include "CullMethod.h"
#include "DiagramScripts.h"
#include "Failure.h"
#include "Table.h"
#include "TextFile.h"
#include "ThreadingName.h"

#include <osg/Version>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <sys/wait.h>

namespace osgAnalyticBin::bench {

namespace {

using report::cellText;
using report::Json;
using report::TextTable;

constexpr std::array<const char*, 2> kComparedWith{"sphere", "cluster"};
// What tables by path have of the figures.
constexpr std::array<const char*, 12> kByPath{"truth_tiles",     "drawn_tiles",   "drawn/truth", "triangles",
                                              "files_requested", "false_culls",   "frame_ms",    "differing_pixels",
                                              kCullColumn,       kCullColdColumn, "over_oracle", "cold_over_oracle"};

Json headOf(const Settings& settings, const char* mode) {
    Json json{{"mode", mode},
              {"database", settings.database},
              {"path", settings.paths},
              {"options", settings.binOptions},
              {"vertical_scale", settings.verticalScale},
              {"width", settings.width},
              {"height", settings.height},
              {"threading", flight::threadingName(settings.threading)},
              {"flush_mib", settings.flush},
              {"expiry", settings.expiry},
              {"osg", osgGetVersion()}};
    if (support::stopRequested) json["interrupted"] = true;
    return json;
}

Json sumsOf(const std::vector<MethodFigures>& methods, const PathGroup& group) {
    Json sums;
    for (const MethodFigures& method : methods) sums[method.method] = sumOf(method, group);
    return sums;
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
    TextTable table(2);
    for (const PathGroup& group : groups) {
        if (&group != &groups.front()) table.addGap();
        Json sums = sumsOf(methods, group);
        addTimesOverOracle(sums);
        for (auto& [method, figures] : sums.items()) {
            if (figures.contains("truth_tiles"))
                figures["drawn/truth"] =
                    report::ratioText(figures["drawn_tiles"].get<double>(), figures["truth_tiles"].get<double>());
            Json row{{"sums by path", group.name}, {"method", method}};
            for (const char* const column : kByPath)
                if (figures.contains(column)) row[column] = figures[column];
            table.addRow(row, 3);
        }
    }
    return table;
}

}  // namespace

std::string csvOf(const Measurement& measured) {
    std::vector<Json> rows;
    for (std::size_t i = 0; i < measured.methods.front().rows.size(); ++i) {
        for (const MethodFigures& method : measured.methods) {
            Json& row = rows.emplace_back();
            if (!measured.poses.empty()) row["pose"] = measured.poses[i];
            row["method"] = method.method;
            row.update(method.rows[i]);
        }
    }
    return report::csvOf(rows);
}

std::string jsonOf(const Settings& settings, const Measurement& measured) {
    const auto& [poses, methods] = measured;
    const bool isFlight = poses.empty();
    Json json = headOf(settings, !isFlight ? "poses" : settings.draw ? "drawn" : settings.jumps ? "jumps" : "flight");
    if (!isFlight) json["poses"] = poses.size();
    json["methods"] = sumsOf(methods, allOf(methods.front()));
    for (const PathGroup& group : pathGroupsOf(poses)) {
        Json& path = json["paths"][group.name];
        path["poses"] = group.poses.size();
        path["methods"] = sumsOf(methods, group);
    }
    return json.dump(2) + "\n";
}

std::vector<TextTable> tablesOf(const Measurement& measured) {
    const auto& [poses, methods] = measured;
    const Json sums = sumsOf(methods, allOf(methods.front()));
    Json shown = sums;
    addTimesOverOracle(shown);
    std::vector<TextTable> tables{poses.empty() ? tableOf("frames", shown, 4) : tableOf("sums over poses", shown, 3)};
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

namespace {

using Methods = std::vector<MethodFigures>;

/// Bars for each path, one a method.
struct BarChart {
    const char* name;
    bool hasSpread;
    double (*value)(const Json& sum, double poses);
};

constexpr std::array<BarChart, 3> kBarCharts{{
    {"drawn", false,
     [](const Json& sum, double) {
         const auto needed = sum["truth_tiles"].get<double>();
         return needed > 0.0 ? sum["drawn_tiles"].get<double>() / needed : std::nan("");
     }},
    {"files", false, [](const Json& sum, double poses) { return sum["files_requested"].get<double>() / poses; }},
    {"cull", true, [](const Json& sum, double poses) { return sum[kCullColumn].get<double>() / poses; }},
}};

std::string quotedForShell(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

Json rowOf(const BarChart& chart, const PathGroup& group, const Methods& methods) {
    Json row{{"path", group.name}};
    const auto poses = static_cast<double>(group.poses.size());
    for (const MethodFigures& method : methods) {
        const Json sum = sumOf(method, group);
        row[method.method] = chart.value(sum, poses);
        if (chart.hasSpread) row[method.method + " half spread"] = sum["cull_spread_ms"].get<double>() / 2.0 / poses;
    }
    return row;
}

}  // namespace

std::vector<Diagram> diagramsOf(const Measurement& measured) {
    Methods shown = measured.methods;
    const bool isAlone = shown.size() == 1;
    const auto isReference = [](const MethodFigures& method) { return method.method == kReferenceMethod; };
    if (!isAlone) shown.erase(std::remove_if(shown.begin(), shown.end(), isReference), shown.end());
    const std::vector<PathGroup> groups = pathGroupsOf(measured.poses);
    std::vector<Diagram> diagrams;
    for (const BarChart& chart : kBarCharts) {
        std::vector<Json> rows;
        for (const PathGroup& group : groups) rows.push_back(rowOf(chart, group, shown));
        diagrams.push_back({chart.name, report::csvOf(rows)});
    }
    return diagrams;
}

void plot(const std::string& folder, const std::vector<Diagram>& diagrams) {
    constexpr int kNoProgram = 127;  // as the shell says it
    support::makeFolder(folder);
    support::writeFile(folder + "/bars.gp", kBarsScript);
    for (const Diagram& diagram : diagrams) support::writeFile(folder + "/" + diagram.name + ".csv", diagram.data);
    for (const Diagram& diagram : diagrams) {
        const std::string draw = "gnuplot -e \"name='" + diagram.name + "'\" bars.gp";
        const std::string command =
            "cd " + quotedForShell(folder) + " && { command -v gnuplot >/dev/null || exit 127; } && exec " + draw;
        const int status = std::system(command.c_str());
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        if (code == kNoProgram)
            throw support::Failure("--plot: gnuplot is not installed (Debian: gnuplot-nox); then, in " + folder + ": " +
                                   draw);
        if (code != 0)
            throw support::Failure("--plot: gnuplot failed on " + diagram.name + ".csv in " + folder +
                                   "; it says why above");
    }
}

namespace {

using support::withDecimals;

// A gain below this share is none.
constexpr double kLeastGain = 0.05;

/// The figures of bins, and the better of what they stand in place of.
struct Comparison {
    double bins = 0.0;
    double other = 0.0;
    std::string name;  // of the other

    [[nodiscard]] double ratio() const { return other > 0.0 ? bins / other : 1.0; }
    [[nodiscard]] bool isGain() const { return ratio() < 1.0 - kLeastGain; }
    [[nodiscard]] bool isLoss() const { return ratio() > 1.0 + kLeastGain; }
};

const MethodFigures* methodNamed(const std::vector<MethodFigures>& methods, const std::string& name) {
    const auto found = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.method == name; });
    return found == methods.end() ? nullptr : &*found;
}

constexpr const char* kTiles = "drawn_tiles";

/// Bins against the better of two methods, over some poses.
class Judge {
public:
    explicit Judge(const std::vector<MethodFigures>& methods) : _bins(methodNamed(methods, kDefaultMethod)) {
        for (const auto& [method, name] : {std::pair("sphere", "spheres"), {"cluster", "cluster callbacks"}})
            if (const MethodFigures* const other = methodNamed(methods, method)) _others.emplace_back(other, name);
    }

    [[nodiscard]] bool isPossible() const { return _bins && !_others.empty(); }

    [[nodiscard]] Comparison compare(const char* column, const PathGroup& poses) const {
        const auto value = [&](const MethodFigures& method) { return sumOf(method, poses)[column].get<double>(); };
        Comparison better{value(*_bins), 0.0, {}};
        for (const auto& [method, name] : _others)
            if (const double other = value(*method); better.name.empty() || other < better.other)
                better = {better.bins, other, name};
        return better;
    }

private:
    const MethodFigures* _bins;
    std::vector<std::pair<const MethodFigures*, const char*>> _others;
};

std::string times(const Comparison& comparison) {
    return withDecimals(comparison.ratio(), 2) + " times";
}

std::string worth(const Comparison& tiles, const Comparison& time) {
    if (time.isLoss() && !tiles.isGain()) return "Bins are not worth it for this database";
    if (!time.isGain() && !tiles.isGain()) return "Bins change little for this database";
    return time.isLoss() ? "Bins are worth it for this database where drawing takes longer than culling"
                         : "Bins are worth it for this database";
}

std::string tilesSentence(const Comparison& tiles, const Comparison& time) {
    return worth(tiles, time) + ": they draw " + withDecimals(tiles.bins, 0) + " tiles where " + tiles.name + " draw " +
           withDecimals(tiles.other, 0) + " (" + times(tiles) + ").";
}

std::string costSentence(const Comparison& files, const Comparison& time, const Comparison& cold, std::size_t poses) {
    const auto perPose = [&](double ms) { return withDecimals(ms / static_cast<double>(poses), 3) + " ms"; };
    // --flush 0 leaves it out
    const std::string coldTimes = cold.other > 0.0 ? ", and " + times(cold) + " with cold caches" : "";
    return "They read " + withDecimals(files.bins, 0) + " files where " + files.name + " read " +
           withDecimals(files.other, 0) + " (" + times(files) + "), and a cull takes " + perPose(time.bins) +
           " where it takes " + perPose(time.other) + " with " + time.name + " (" + times(time) + coldTimes + ").";
}

std::string whereSentence(const Judge& judge, const std::vector<PathGroup>& paths) {
    std::string where;
    for (const PathGroup& path : paths) {
        const Comparison tiles = judge.compare(kTiles, path), time = judge.compare(kCullColumn, path);
        if (tiles.isGain() && !time.isLoss()) continue;
        if (!tiles.isLoss() && time.isGain()) continue;
        where += (where.empty() ? "" : ", ") + path.name + " (" + withDecimals(tiles.ratio(), 2) +
                 " times the tiles, " + withDecimals(time.ratio(), 2) + " times the cull time)";
    }
    return where.empty() ? "They help on every path that was flown."
                         : "They do not help, or cost time, here: " + where + ".";
}

}  // namespace

std::vector<std::string> adviceOf(const Measurement& measured) {
    const auto& [poses, methods] = measured;
    const Judge judge(methods);
    if (!judge.isPossible()) return {};
    const PathGroup all = allOf(methods.front());
    const Comparison tiles = judge.compare(kTiles, all), files = judge.compare("files_requested", all),
                     time = judge.compare(kCullColumn, all);
    return {tilesSentence(tiles, time), costSentence(files, time, judge.compare(kCullColdColumn, all), poses.size()),
            whereSentence(judge, pathGroupsOf(poses))};
}

}  // namespace osgAnalyticBin::bench
