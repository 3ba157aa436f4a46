// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"
#include "DiagramScripts.h"
#include "Output.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osgAnalyticBin::bench {

namespace {

using report::Diagram;
using report::Json;
using Methods = std::vector<MethodFigures>;

// Characters that stand side by side below a diagram.
constexpr std::size_t kLabelRoom = 110;

/// Bars for each path, one a method.
struct BarChart {
    const char* name;
    const char* heading;
    const char* label;
    const char* numberFormat;
    bool isRatio;
    bool hasSpread;
    double (*value)(const Json& sum, double poses);
};

constexpr std::array<BarChart, 3> kBarCharts{{
    {"drawn", "Tiles drawn for each tile needed, sums over the poses of a path",
     "tiles drawn / tiles needed (logarithmic)", "%.2f", true, false,
     [](const Json& sum, double) {
         const auto needed = sum["truth_tiles"].get<double>();
         return needed > 0.0 ? sum["drawn_tiles"].get<double>() / needed : std::nan("");
     }},
    {"files", "Files requested on arrival at a pose, mean over the poses of a path", "files a pose", "%.0f", false,
     false, [](const Json& sum, double poses) { return sum["files_requested"].get<double>() / poses; }},
    {"cull", "Time of a cull traversal, mean over the poses of a path; whiskers: half the quartile spread either way",
     "milliseconds a pose", "%.3f", false, true,
     [](const Json& sum, double poses) { return sum[kCullColumn].get<double>() / poses; }},
}};

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

// What the script is told beside its data.
std::string settingsOf(const BarChart& chart, const std::vector<PathGroup>& groups, const Methods& methods) {
    const auto set = [](const char* variable, const std::string& text) {
        return std::string(variable) + " = \"" + text + "\"\n";
    };
    std::string names, tics;
    for (const MethodFigures& method : methods) names += (names.empty() ? "" : " ") + method.method;
    std::size_t length = 0;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        length = std::max(length, groups[i].name.size() + 2);
        tics += (i > 0 ? ", \"" : "\"") + groups[i].name + "\" " + std::to_string(i);
    }
    const char* const turned = length * groups.size() > kLabelRoom ? "rotate by 40 right" : "";
    return set("names", names) + set("turned", turned) + "tics = '" + tics + "'\n" + set("heading", chart.heading) +
           set("label", chart.label) + set("numberFormat", chart.numberFormat) +
           "isRatio = " + std::to_string(chart.isRatio) + "\nhasSpread = " + std::to_string(chart.hasSpread) + "\n";
}

}  // namespace

std::vector<Diagram> diagramsOf(const std::vector<std::string>& poses, const std::vector<MethodFigures>& methods) {
    Methods shown = methods;
    const bool isAlone = methods.size() == 1;
    const auto isReference = [](const MethodFigures& method) { return method.method == kReferenceMethod; };
    if (!isAlone) shown.erase(std::remove_if(shown.begin(), shown.end(), isReference), shown.end());
    const std::vector<PathGroup> groups = pathGroupsOf(poses);
    std::vector<Diagram> diagrams;
    for (const BarChart& chart : kBarCharts) {
        std::vector<Json> rows;
        for (const PathGroup& group : groups) rows.push_back(rowOf(chart, group, shown));
        diagrams.push_back({chart.name, report::csvOf(rows),
                            report::drawnTwice(chart.name, "size 1000,560 noenhanced font 'sans,12'",
                                               settingsOf(chart, groups, shown) + kBarsScript)});
    }
    return diagrams;
}

}  // namespace osgAnalyticBin::bench
