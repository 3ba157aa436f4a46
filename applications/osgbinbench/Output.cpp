// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Output.h"

#include "CsvTable.h"
#include "CullMethod.h"
#include "PathGroups.h"
#include "TextFile.h"
#include "TextTable.h"

#include <osg/Version>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace osgAnalyticBin::bench {

using support::withDecimals;

namespace {

using Json = nlohmann::ordered_json;
using report::TextTable;

constexpr std::array<const char*, 2> kComparedWith{"sphere", "cluster"};

std::string ratio(double value, double reference) {
    return reference > 0.0 ? withDecimals(value / reference, 3) : "-";
}

Json headOf(const Settings& settings, const char* mode) {
    Json json;
    json["mode"] = mode;
    json["database"] = settings.database;
    json["path"] = settings.paths;
    json["options"] = settings.binOptions;
    json["vertical_scale"] = settings.verticalScale;
    json["width"] = settings.width;
    json["height"] = settings.height;
    json["threading"] = threadingName(settings.threading);
    json["flush_mib"] = settings.flush;
    json["expiry"] = settings.expiry;
    json["osg"] = osgGetVersion();
    return json;
}

Json flightOf(const std::vector<FlightFigures>& methods) {
    Json json;
    for (const FlightFigures& method : methods) {
        Json& sums = json[method.method];
        sums["frames"] = method.frames;
        for (const FlightColumn& column : kFlightColumns) sums[column.name] = method.*column.count;
        sums[kCullColumn] = method.cullMs;
        sums[kCullMedianColumn] = method.cullMedianMs;
        sums[kCull99thColumn] = method.cull99thMs;
    }
    return json;
}

std::vector<std::string> flightHead(const std::string& first) {
    std::vector<std::string> cells{first, "frames"};
    for (const FlightColumn& column : kFlightColumns) cells.emplace_back(column.name);
    cells.insert(cells.end(), {kCullColumn, kCullMedianColumn, kCull99thColumn});
    return cells;
}

std::vector<std::string> flightLine(const FlightFigures& m) {
    std::vector<std::string> cells{m.method, std::to_string(m.frames)};
    for (const FlightColumn& column : kFlightColumns) cells.push_back(std::to_string(m.*column.count));
    cells.insert(cells.end(),
                 {withDecimals(m.cullMs, 3), withDecimals(m.cullMedianMs, 4), withDecimals(m.cull99thMs, 4)});
    return cells;
}

std::vector<std::string> flightRatios(const FlightFigures& m, const FlightFigures& reference) {
    std::vector<std::string> cells{m.method,
                                   ratio(static_cast<double>(m.frames), static_cast<double>(reference.frames))};
    for (const FlightColumn& column : kFlightColumns)
        cells.push_back(ratio(static_cast<double>(m.*column.count), static_cast<double>(reference.*column.count)));
    cells.insert(cells.end(), {ratio(m.cullMs, reference.cullMs), ratio(m.cullMedianMs, reference.cullMedianMs),
                               ratio(m.cull99thMs, reference.cull99thMs)});
    return cells;
}

std::vector<std::string> drawnHead(const std::string& first) {
    std::vector<std::string> cells{first, "frames"};
    for (const DrawnColumn& column : kDrawnColumns) cells.emplace_back(column.name);
    return cells;
}

std::vector<std::string> drawnLine(const DrawnFigures& m) {
    std::vector<std::string> cells{m.method, std::to_string(m.frames)};
    for (const DrawnColumn& column : kDrawnColumns) cells.push_back(withDecimals(m.*column.ms, 3));
    return cells;
}

std::vector<std::string> drawnRatios(const DrawnFigures& m, const DrawnFigures& reference) {
    std::vector<std::string> cells{m.method,
                                   ratio(static_cast<double>(m.frames), static_cast<double>(reference.frames))};
    for (const DrawnColumn& column : kDrawnColumns) cells.push_back(ratio(m.*column.ms, reference.*column.ms));
    return cells;
}

template <class Method>
const Method* find(const std::vector<Method>& methods, const std::string& name) {
    const auto found = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.method == name; });
    return found == methods.end() ? nullptr : &*found;
}

std::vector<std::string> headLine(const std::string& first) {
    std::vector<std::string> cells{first};
    for (const CountColumn& column : kCountColumns) cells.emplace_back(column.name);
    for (const TimeColumn& column : kTimeColumns)
        if (!column.isSpread) cells.emplace_back(column.name);
    return cells;
}

const char* const kOverOracle = "over_oracle";
const char* const kColdOverOracle = "cold_over_oracle";

// Times as multiples of what culling would cost if tests were free.
std::array<std::string, 2> overOracle(const Figures& sum, const Figures& oracle) {
    return {ratio(sum.cullMs, oracle.cullMs), ratio(sum.cullColdMs, oracle.cullColdMs)};
}

void append(std::vector<std::string>& cells, const std::array<std::string, 2>& more) {
    cells.insert(cells.end(), more.begin(), more.end());
}

std::vector<std::string> ratioLine(const MethodFigures& method, const Figures& reference) {
    const Figures sum = method.sum();
    std::vector<std::string> cells{method.method};
    for (const CountColumn& column : kCountColumns)
        cells.push_back(ratio(static_cast<double>(sum.*column.count), static_cast<double>(reference.*column.count)));
    for (const TimeColumn& column : kTimeColumns)
        if (!column.isSpread) cells.push_back(ratio(sum.*column.ms, reference.*column.ms));
    return cells;
}

Json sumsOf(const Figures& sum) {
    Json sums;
    for (const CountColumn& column : kCountColumns) sums[column.name] = sum.*column.count;
    for (const TimeColumn& column : kTimeColumns) sums[column.name] = sum.*column.ms;
    return sums;
}

Json byPose(const MethodFigures& method) {
    Json columns;
    for (const Figures& pose : method.poses) {
        for (const CountColumn& column : kCountColumns) columns[column.name].push_back(pose.*column.count);
        for (const TimeColumn& column : kTimeColumns) columns[column.name].push_back(pose.*column.ms);
    }
    return columns;
}

void printByPath(std::ostream& output, const std::vector<std::string>& poses,
                 const std::vector<MethodFigures>& methods) {
    const std::vector<PathGroup> groups = pathGroupsOf(poses);
    if (groups.size() < 2) return;
    const MethodFigures* const oracle = find(methods, kOracleMethod);
    std::vector<std::string> head{"sums by path",     "method",    "truth_tiles",     "drawn_tiles",
                                  "drawn/truth",      "triangles", "files_requested", "false_culls",
                                  "differing_pixels", kCullColumn, kCullColdColumn};
    if (oracle) append(head, {kOverOracle, kColdOverOracle});
    TextTable table(2);
    table.add(head);
    for (const PathGroup& group : groups) {
        table.addGap();
        for (const MethodFigures& method : methods) {
            const Figures sum = sumOf(method, group);
            std::vector<std::string> cells{
                group.name,
                method.method,
                std::to_string(sum.truthTiles),
                std::to_string(sum.drawnTiles),
                ratio(static_cast<double>(sum.drawnTiles), static_cast<double>(sum.truthTiles)),
                std::to_string(sum.triangles),
                std::to_string(sum.filesRequested),
                std::to_string(sum.falseCulls),
                std::to_string(sum.differingPixels),
                withDecimals(sum.cullMs, 3),
                withDecimals(sum.cullColdMs, 3)};
            if (oracle) append(cells, overOracle(sum, sumOf(*oracle, group)));
            table.add(cells);
        }
    }
    output << '\n';
    table.print(output);
}

// The longer a table's lines, the harder they are to read: columns become lines.
TextTable turned(const std::vector<std::vector<std::string>>& lines) {
    TextTable table(1);
    for (std::size_t column = 0; column < lines.front().size(); ++column) {
        std::vector<std::string> cells;
        for (const auto& line : lines) cells.push_back(line[column]);
        table.add(std::move(cells));
    }
    return table;
}

template <class Flights, class Head, class Line, class Ratios>
void printFlights(std::ostream& output, const Flights& methods, const std::string& title, const Head& head,
                  const Line& line, const Ratios& ratios) {
    std::vector<std::vector<std::string>> lines{head(title)};
    for (const auto& m : methods) lines.push_back(line(m));
    turned(lines).print(output);
    for (const char* const name : kComparedWith) {
        const auto* const reference = find(methods, name);
        if (!reference) continue;
        lines = {head(std::string("ratio to ") + name)};
        for (const auto& m : methods) lines.push_back(ratios(m, *reference));
        output << '\n';
        turned(lines).print(output);
    }
}

}  // namespace

std::string csvOf(const std::vector<std::string>& poses, const std::vector<MethodFigures>& methods) {
    std::string text = "pose,method";
    for (const CountColumn& column : kCountColumns) text += std::string(",") + column.name;
    for (const TimeColumn& column : kTimeColumns) text += std::string(",") + column.name;
    text += "\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
        for (const MethodFigures& method : methods) {
            const Figures& figures = method.poses[i];
            text += poses[i] + "," + method.method;
            for (const CountColumn& column : kCountColumns) text += "," + std::to_string(figures.*column.count);
            for (const TimeColumn& column : kTimeColumns) text += "," + flight::textFrom(figures.*column.ms);
            text += "\n";
        }
    }
    return text;
}

std::string csvOf(const std::vector<FlightFigures>& methods) {
    std::string text = "method,frames";
    for (const FlightColumn& column : kFlightColumns) text += std::string(",") + column.name;
    text += std::string(",") + kCullColumn + "," + kCullMedianColumn + "," + kCull99thColumn + "\n";
    for (const FlightFigures& method : methods) {
        text += method.method + "," + std::to_string(method.frames);
        for (const FlightColumn& column : kFlightColumns) text += "," + std::to_string(method.*column.count);
        text += "," + flight::textFrom(method.cullMs) + "," + flight::textFrom(method.cullMedianMs) + "," +
                flight::textFrom(method.cull99thMs) + "\n";
    }
    return text;
}

std::string csvOf(const std::vector<DrawnFigures>& methods) {
    std::string text = "method,frames";
    for (const DrawnColumn& column : kDrawnColumns) text += std::string(",") + column.name;
    text += "\n";
    for (const DrawnFigures& method : methods) {
        text += method.method + "," + std::to_string(method.frames);
        for (const DrawnColumn& column : kDrawnColumns) text += "," + flight::textFrom(method.*column.ms);
        text += "\n";
    }
    return text;
}

std::string jsonOf(const Settings& settings, const std::vector<std::string>& poses,
                   const std::vector<MethodFigures>& methods, const std::vector<FlightFigures>& live) {
    Json json = headOf(settings, "poses");
    json["poses"] = poses.size();
    for (const MethodFigures& method : methods) json["methods"][method.method] = sumsOf(method.sum());
    for (const PathGroup& group : pathGroupsOf(poses)) {
        Json& path = json["paths"][group.name];
        path["poses"] = group.poses.size();
        for (const MethodFigures& method : methods) path["methods"][method.method] = sumsOf(sumOf(method, group));
    }
    if (!live.empty()) json["live"] = {{"frames", live.front().frames}, {"methods", flightOf(live)}};
    json["pose_names"] = poses;
    for (const MethodFigures& method : methods) json["by_pose"][method.method] = byPose(method);
    return json.dump(2) + "\n";
}

std::string jsonOf(const Settings& settings, const std::vector<FlightFigures>& methods) {
    Json json = headOf(settings, settings.jumps ? "jumps" : "flight");
    json["methods"] = flightOf(methods);
    return json.dump(2) + "\n";
}

std::string jsonOf(const Settings& settings, const std::vector<DrawnFigures>& methods) {
    Json json = headOf(settings, "drawn");
    for (const DrawnFigures& method : methods) {
        Json& times = json["methods"][method.method];
        times["frames"] = method.frames;
        for (const DrawnColumn& column : kDrawnColumns) times[column.name] = method.*column.ms;
    }
    return json.dump(2) + "\n";
}

void printTable(std::ostream& output, const std::vector<std::string>& poses,
                const std::vector<MethodFigures>& methods) {
    std::vector<std::vector<std::string>> lines{headLine("sums over poses")};
    const MethodFigures* const oracle = find(methods, kOracleMethod);
    if (oracle) append(lines.front(), {kOverOracle, kColdOverOracle});
    for (const MethodFigures& method : methods) {
        const Figures sum = method.sum();
        lines.push_back({method.method});
        for (const CountColumn& column : kCountColumns) lines.back().push_back(std::to_string(sum.*column.count));
        for (const TimeColumn& column : kTimeColumns)
            if (!column.isSpread) lines.back().push_back(withDecimals(sum.*column.ms, 3));
        if (oracle) append(lines.back(), overOracle(sum, oracle->sum()));
    }
    turned(lines).print(output);
    for (const char* const name : kComparedWith) {
        const MethodFigures* const reference = find(methods, name);
        if (!reference) continue;
        lines = {headLine(std::string("ratio to ") + name)};
        for (const MethodFigures& method : methods) lines.push_back(ratioLine(method, reference->sum()));
        output << '\n';
        turned(lines).print(output);
    }
    printByPath(output, poses, methods);
}

void printTable(std::ostream& output, const std::vector<FlightFigures>& methods) {
    printFlights(output, methods, "paging live", flightHead, flightLine, flightRatios);
}

void printTable(std::ostream& output, const std::vector<DrawnFigures>& methods) {
    printFlights(output, methods, "drawn with paging live", drawnHead, drawnLine, drawnRatios);
}

}  // namespace osgAnalyticBin::bench
