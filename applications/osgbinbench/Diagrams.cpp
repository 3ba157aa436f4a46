// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullMethod.h"
#include "PathGroups.h"
#include "Plot.h"

#include <osgAnalyticBin/viewer/CsvTable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

using flight::textFrom;
using Methods = std::vector<MethodFigures>;

// The colours of Okabe and Ito, which the colour-blind can tell apart; those of OSG's own methods come first.
constexpr std::array<const char*, 7> kColours{"#D55E00", "#E69F00", "#0072B2", "#009E73",
                                              "#CC79A7", "#56B4E9", "#555555"};
constexpr std::array<int, 7> kPointTypes{4, 6, 8, 10, 12, 1, 2};
// Characters that stand side by side below a diagram.
constexpr std::size_t kLabelRoom = 110;
// Bars that are wide enough for a number on top.
constexpr std::size_t kNumberedBars = 64;
constexpr std::size_t kNamedPoses = 30;

std::string colour(std::size_t method) {
    return std::string(" lc rgb \"") + kColours[method % kColours.size()] + "\"";
}

std::string quoted(const std::string& text) {
    return "\"" + text + "\"";
}

Methods worthShowing(const Methods& methods) {
    Methods shown;
    std::copy_if(methods.begin(), methods.end(), std::back_inserter(shown),
                 [](const MethodFigures& method) { return method.method != kReferenceMethod; });
    return shown.empty() ? methods : shown;
}

std::string head(const std::string& name, const std::string& title) {
    return "# Drawn by: gnuplot " + name + ".gp\n" +
           "set datafile separator \",\"\n"
           "set title " +
           quoted(title) +
           "\n"
           "set border 3 lc rgb \"#444444\"\n"
           "set tics nomirror out\n"
           "set grid ytics lt 1 lw 0.6 lc rgb \"#cccccc\"\n"
           "set key outside center top horizontal samplen 2 maxrows 3\n";
}

// Draws what a command of the script defines as the macro "draw", once for each kind of picture.
std::string foot(const std::string& name, int height) {
    const std::string size = " size 1000," + std::to_string(height) + " noenhanced";
    return "set terminal svg" + size + " font \"sans-serif,14\" background rgb \"white\"\nset output \"" + name +
           ".svg\"\n@draw\nunset output\nset terminal pngcairo" + size + " font \"sans,11\"\nset output \"" + name +
           ".png\"\n@draw\nunset output\n";
}

std::string ticsOf(const std::vector<std::pair<std::string, double>>& labels) {
    std::size_t length = 0;
    std::string text;
    for (const auto& [name, place] : labels) {
        length = std::max(length, name.size() + 2);
        text += (text.empty() ? "" : ", ") + quoted(name) + " " + textFrom(place);
    }
    const char* const turned = length * labels.size() > kLabelRoom ? "rotate by 40 right " : "";
    return std::string("set xtics ") + turned + "scale 0 (" + text + ")\n";
}

/// Bars for each path, one a method.
struct BarChart {
    const char* name;
    const char* title;
    const char* valueLabel;
    const char* numberFormat;
    bool isRatio;  ///< bars stand on 1, and equal ratios are equally far apart
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

struct ValueRange {
    double lowest = 1.0;
    double highest = 0.0;
};

ValueRange rangeOf(const BarChart& chart, const std::vector<PathGroup>& groups, const Methods& methods) {
    ValueRange range;
    for (const MethodFigures& method : methods) {
        for (const PathGroup& group : groups) {
            const double value = chart.value(sumOf(method, group), group.poses.size());
            range = {std::fmin(range.lowest, value), std::fmax(range.highest, value)};
        }
    }
    return range;
}

std::string barsOf(const BarChart& chart, const Methods& methods, std::size_t groups) {
    const double width = 0.84 / static_cast<double>(methods.size());
    const std::string file = quoted(std::string(chart.name) + ".csv") + " skip 1 using ";
    std::string bars;
    std::string above;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const double left = width * static_cast<double>(m) - 0.42;
        const std::string column = std::to_string(chart.hasSpread ? 2 * m + 2 : m + 2);
        const std::string value = "column(" + column + ")";
        const std::string spread = "column(" + std::to_string(2 * m + 3) + ")";
        const std::string x = "($0+" + textFrom(left + width / 2) + "):";
        const std::string foot = chart.isRatio ? "1" : "0";
        bars += (bars.empty() ? "" : ", ") + file + x + "(" + value + "):($0+" + textFrom(left) + "):($0+" +
                textFrom(left + 0.92 * width) + "):(" + foot + "):(" + value +
                ") with boxxyerror fs solid 0.9 noborder" + colour(m) + " title " + quoted(methods[m].method);
        if (chart.hasSpread)
            above += ", " + file + x + "(" + value + "-" + spread + "):(0):(2*" + spread +
                     ") with vectors nohead lw 1.5 lc rgb \"#222222\" notitle";
        else if (groups * methods.size() <= kNumberedBars)
            above += ", " + file + x + "(" + (chart.isRatio ? value + " < 1 ? 1 : " : "") + value + "):(sprintf(\"" +
                     chart.numberFormat + "\", " + value + ")) with labels rotate by 90 left offset 0,0.3 notitle";
    }
    return bars + above;
}

Diagram diagramOf(const BarChart& chart, const std::vector<PathGroup>& groups, const Methods& methods) {
    std::vector<std::pair<std::string, double>> labels;
    for (const PathGroup& group : groups) labels.emplace_back(group.name, static_cast<double>(labels.size()));
    const ValueRange range = rangeOf(chart, groups, methods);
    std::string script = head(chart.name, chart.title) + "set ylabel " + quoted(chart.valueLabel) + "\n" +
                         ticsOf(labels) + "set xrange [-0.6:" + textFrom(static_cast<double>(groups.size()) - 0.4) +
                         "]\nset macros\n";
    if (chart.isRatio)
        script += "set logscale y 2\nset yrange [" + textFrom(std::clamp(0.9 * range.lowest, 0.1, 0.95)) + ":" +
                  textFrom(std::max(2.0, 1.6 * range.highest)) +
                  "]\nset arrow from graph 0, first 1 to graph 1, first 1 nohead lw 1.2 lc rgb \"#222222\" front\n";
    else
        script += "set yrange [0:" + textFrom(range.highest > 0.0 ? 1.25 * range.highest : 1.0) + "]\n";
    script += "draw = 'plot " + barsOf(chart, methods, groups.size()) + "'\n";
    return {chart.name, dataOf(chart, groups, methods), script + foot(chart.name, 560)};
}

/// A line for each method along the path.
struct PoseChart {
    const char* column;
    const char* label;
    std::uint64_t Figures::*count;
    double least;  ///< of the logarithmic axis; less is drawn there
};

constexpr std::array<PoseChart, 3> kPoseCharts{{{"drawn_tiles", "tiles drawn", &Figures::drawnTiles, 0.5},
                                                {"triangles", "triangles drawn", &Figures::triangles, 500.0},
                                                {"files_requested", "files requested", &Figures::filesRequested, 0.5}}};

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

// Names of poses where they can be read, of paths otherwise, and lines between paths that follow each other.
std::string poseTicsOf(const std::vector<std::string>& poses, const std::vector<PathGroup>& groups) {
    std::vector<std::pair<std::string, double>> labels;
    std::string lines;
    if (poses.size() <= kNamedPoses)
        for (const std::string& pose : poses) labels.emplace_back(pose, static_cast<double>(labels.size()));
    for (const PathGroup& group : groups) {
        const auto first = static_cast<double>(group.poses.front());
        const auto last = static_cast<double>(group.poses.back());
        if (poses.size() > kNamedPoses) labels.emplace_back(group.name, (first + last) / 2.0);
        if (first > 0.0)
            lines += "set arrow from first " + textFrom(first - 0.5) + ", graph 0 to first " + textFrom(first - 0.5) +
                     ", graph 1 nohead lt 1 lw 0.8 lc rgb \"#999999\" back\n";
    }
    return ticsOf(labels) + lines;
}

std::string linesOf(std::size_t chart, const Methods& methods) {
    const std::string least = textFrom(kPoseCharts[chart].least);
    const auto data = [&](std::size_t column) {
        const std::string value = "$" + std::to_string(column);
        return "\"poses.csv\" skip 1 using 0:(" + value + " > " + least + " ? " + value + " : " + least + ") ";
    };
    std::string lines;
    if (chart == 0) lines = data(2) + "with lines lw 2.5 lc rgb \"#000000\" title \"tiles needed\"";
    for (std::size_t m = 0; m < methods.size(); ++m) {
        lines += (lines.empty() ? "" : ", ") + data(3 + chart * methods.size() + m) +
                 "with linespoints lw 1.4 ps 0.8 pt " + std::to_string(kPointTypes[m % kPointTypes.size()]) +
                 colour(m) + (chart == 0 ? " title " + quoted(methods[m].method) : " notitle");
    }
    return lines;
}

Diagram poseDiagram(const std::vector<std::string>& poses, const Methods& methods) {
    std::string draw = "set multiplot layout 3,1";
    for (std::size_t chart = 0; chart < kPoseCharts.size(); ++chart) {
        if (chart == 1) draw += "; unset title; set key off";
        draw += "; set yrange [" + textFrom(kPoseCharts[chart].least) + ":*]; set ylabel " +
                quoted(kPoseCharts[chart].label) + "; plot " + linesOf(chart, methods);
    }
    draw += "; unset multiplot; set key on; set title title_text";
    const std::string title = "Pose by pose along the path (logarithmic; what is on the base line is less, or none)";
    const std::string script =
        head("poses", title) + "title_text = " + quoted(title) + "\n" + poseTicsOf(poses, pathGroupsOf(poses)) +
        "set xrange [-0.6:" + textFrom(static_cast<double>(poses.size()) - 0.4) +
        "]\nset logscale y\nset format y \"%.0s%c\"\nset lmargin 10\nset macros\ndraw = '" + draw + "'\n";
    return {"poses", poseDataOf(poses, methods), script + foot("poses", 1200)};
}

}  // namespace

std::vector<Diagram> diagramsOf(const std::vector<std::string>& poses, const std::vector<MethodFigures>& methods) {
    const Methods shown = worthShowing(methods);
    const std::vector<PathGroup> groups = pathGroupsOf(poses);
    std::vector<Diagram> diagrams;
    for (const BarChart& chart : kBarCharts) diagrams.push_back(diagramOf(chart, groups, shown));
    diagrams.push_back(poseDiagram(poses, shown));
    return diagrams;
}

}  // namespace osgAnalyticBin::bench
