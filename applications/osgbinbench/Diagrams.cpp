// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CsvTable.h"
#include "CullMethod.h"
#include "DiagramScripts.h"
#include "Output.h"
#include "PathGroups.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

using flight::textFrom;
using report::Diagram;
using Methods = std::vector<MethodFigures>;
using Labels = std::vector<std::pair<std::string, double>>;

// Characters that stand side by side below a diagram.
constexpr std::size_t kLabelRoom = 110;
constexpr std::size_t kNamedPoses = 30;

std::string inQuotes(const std::string& text) {
    return "\"" + text + "\"";
}

Methods worthShowing(const Methods& methods) {
    Methods shown;
    std::copy_if(methods.begin(), methods.end(), std::back_inserter(shown),
                 [](const MethodFigures& method) { return method.method != kReferenceMethod; });
    return shown.empty() ? methods : shown;
}

// What a script is told beside its data.
std::string headOf(const std::string& name, const Methods& methods, const Labels& labels) {
    std::string names;
    for (const MethodFigures& method : methods) names += (names.empty() ? "" : " ") + method.method;
    std::size_t length = 0;
    std::string tics;
    for (const auto& [label, place] : labels) {
        length = std::max(length, label.size() + 2);
        tics += (tics.empty() ? "" : ", ") + inQuotes(label) + " " + textFrom(place);
    }
    const char* const turned = length * labels.size() > kLabelRoom ? "rotate by 40 right" : "";
    return "# Drawn by: gnuplot " + name + ".gp\nname = " + inQuotes(name) + "\nnames = " + inQuotes(names) +
           "\nturned = " + inQuotes(turned) + "\ntics = '" + tics + "'\n";
}

/// Bars for each path, one a method.
struct BarChart {
    const char* name;
    const char* heading;
    const char* label;
    const char* numberFormat;
    bool isRatio;
    bool hasSpread;
    double (*value)(const Figures& sum, std::size_t poses);
};

double perPose(double sum, std::size_t poses) {
    return sum / static_cast<double>(poses);
}

constexpr std::array<BarChart, 3> kBarCharts{{
    {"drawn", "Tiles drawn for each tile needed, sums over the poses of a path",
     "tiles drawn / tiles needed (logarithmic)", "%.2f", true, false,
     [](const Figures& sum, std::size_t) {
         return sum.truthTiles > 0 ? static_cast<double>(sum.drawnTiles) / static_cast<double>(sum.truthTiles)
                                   : std::nan("");
     }},
    {"files", "Files requested on arrival at a pose, mean over the poses of a path", "files a pose", "%.0f", false,
     false,
     [](const Figures& sum, std::size_t poses) { return perPose(static_cast<double>(sum.filesRequested), poses); }},
    {"cull", "Time of a cull traversal, mean over the poses of a path; whiskers: half the quartile spread either way",
     "milliseconds a pose", "%.3f", false, true,
     [](const Figures& sum, std::size_t poses) { return perPose(sum.cullMs, poses); }},
}};

std::string dataOf(const BarChart& chart, const std::vector<PathGroup>& groups, const Methods& methods) {
    std::string text = "path";
    for (const MethodFigures& method : methods)
        text += "," + method.method + (chart.hasSpread ? "," + method.method + " half spread" : "");
    for (const PathGroup& group : groups) {
        text += "\n" + group.name;
        for (const MethodFigures& method : methods) {
            const Figures sum = sumOf(method, group);
            text += "," + textFrom(chart.value(sum, group.poses.size()));
            if (chart.hasSpread) text += "," + textFrom(perPose(sum.cullSpreadMs / 2.0, group.poses.size()));
        }
    }
    return text + "\n";
}

Diagram diagramOf(const BarChart& chart, const std::vector<PathGroup>& groups, const Methods& methods) {
    Labels labels;
    for (const PathGroup& group : groups) labels.emplace_back(group.name, static_cast<double>(labels.size()));
    const std::string settings = "heading = " + inQuotes(chart.heading) + "\nlabel = " + inQuotes(chart.label) +
                                 "\nnumberFormat = " + inQuotes(chart.numberFormat) +
                                 "\nisRatio = " + std::to_string(chart.isRatio) +
                                 "\nhasSpread = " + std::to_string(chart.hasSpread) + "\n";
    return {chart.name, dataOf(chart, groups, methods), headOf(chart.name, methods, labels) + settings + kBarsScript};
}

/// A line for each method along the path.
struct PoseChart {
    const char* column;
    std::uint64_t Figures::*count;
};

constexpr std::array<PoseChart, 3> kPoseCharts{{{"drawn_tiles", &Figures::drawnTiles},
                                                {"triangles", &Figures::triangles},
                                                {"files_requested", &Figures::filesRequested}}};

std::string poseDataOf(const std::vector<std::string>& poses, const Methods& methods) {
    std::string text = "pose,truth_tiles";
    for (const PoseChart& chart : kPoseCharts)
        for (const MethodFigures& method : methods) text += "," + method.method + " " + chart.column;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        text += "\n" + poses[i] + "," + std::to_string(methods.front().poses[i].truthTiles);
        for (const PoseChart& chart : kPoseCharts)
            for (const MethodFigures& method : methods) text += "," + std::to_string(method.poses[i].*chart.count);
    }
    return text + "\n";
}

// Names poses where they can be read, else paths; lines stand between paths that follow each other.
Diagram poseDiagram(const std::vector<std::string>& poses, const Methods& methods) {
    Labels labels;
    std::string borders;
    if (poses.size() <= kNamedPoses)
        for (const std::string& pose : poses) labels.emplace_back(pose, static_cast<double>(labels.size()));
    for (const PathGroup& group : pathGroupsOf(poses)) {
        const auto first = static_cast<double>(group.poses.front());
        const auto last = static_cast<double>(group.poses.back());
        if (poses.size() > kNamedPoses) labels.emplace_back(group.name, (first + last) / 2.0);
        if (first > 0.0) borders += (borders.empty() ? "" : " ") + textFrom(first - 0.5);
    }
    return {"poses", poseDataOf(poses, methods),
            headOf("poses", methods, labels) + "poses = " + std::to_string(poses.size()) +
                "\nborders = " + inQuotes(borders) + "\n" + kPosesScript};
}

}  // namespace

std::vector<report::Diagram> diagramsOf(const std::vector<std::string>& poses,
                                        const std::vector<MethodFigures>& methods) {
    const Methods shown = worthShowing(methods);
    const std::vector<PathGroup> groups = pathGroupsOf(poses);
    std::vector<report::Diagram> diagrams;
    for (const BarChart& chart : kBarCharts) diagrams.push_back(diagramOf(chart, groups, shown));
    diagrams.push_back(poseDiagram(poses, shown));
    return diagrams;
}

}  // namespace osgAnalyticBin::bench
