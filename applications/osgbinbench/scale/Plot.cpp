// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Diagram.h"
#include "Output.h"
#include "Table.h"

#include <algorithm>
#include <string>

namespace osgAnalyticBin::scale {

using report::Diagram;
using report::Json;

namespace {

// Draws NAME.csv.
Diagram diagramOf(const std::string& name, const std::string& commands, const std::vector<Json>& rows) {
    const std::string common = "set datafile separator ','\nset key bottom right\nset grid\nset yrange [0:*]\n";
    return {name, report::csvOf(rows), report::drawnTwice(name, "size 800,500 noenhanced", common + commands)};
}

// A line for each method, through the points of its rows; each method has a column.
template <class Row, class X, class Y>
Diagram lines(const std::string& name, const std::string& commands, const std::vector<Row>& rows, X Row::*x,
              const Y& y) {
    std::vector<Json> points;
    for (const Row& row : rows) {
        auto point = std::find_if(points.begin(), points.end(), [&](const Json& p) { return p["x"] == row.*x; });
        if (point == points.end()) {
            point = points.insert(points.end(), Json());
            (*point)["x"] = row.*x;
        }
        (*point)[row.method] = y(row);
    }
    std::size_t columns = 1;
    for (const Json& point : points) columns = std::max(columns, point.size());
    const std::string draw =
        "plot for [i=2:" + std::to_string(columns) + "] name.'.csv' using 1:i with linespoints title columnhead(i)\n";
    return diagramOf(name, commands + draw, points);
}

Diagram memoryBars(const std::vector<MemoryRow>& rows) {
    std::vector<Json> bars;
    for (const MemoryRow& row : rows) bars.push_back({{"method", row.method}, {"KiB", row.bytesPerTile / 1024.0}});
    return diagramOf("memory", R"(set title 'Memory of a tile'
set ylabel 'KiB'
set style fill solid 0.6
set boxwidth 0.6
unset key
set xtics rotate by 20 right
plot name.'.csv' skip 1 using 0:2:xtic(1) with boxes
)",
                     bars);
}

}  // namespace

void plot(const std::string& folder, const Results& results) {
    std::vector<Diagram> diagrams;
    if (!results.depth.empty()) {
        const std::string levels = "set xlabel 'levels below the start tiles'\n";
        diagrams.push_back(
            lines("depth", levels + "set title 'Cull time for each drawn tile'\nset ylabel 'microseconds'\n",
                  results.depth, &DepthRow::levels, [](const DepthRow& row) { return row.usPerDrawnTile(); }));
        diagrams.push_back(
            lines("flight",
                  levels + "set title 'Cull time of the flight'\nset ylabel 'milliseconds, one frame at each pose'\n",
                  results.depth, &DepthRow::levels, [](const DepthRow& row) { return row.cullMs; }));
    }
    if (!results.residents.empty())
        diagrams.push_back(lines("residents", R"(set title 'Cull time of one view'
set xlabel 'PagedLODs in memory (logarithmic)'
set logscale x
set rmargin 6
set ylabel 'milliseconds'
)",
                                 results.residents, &ResidentRow::pagedLods,
                                 [](const ResidentRow& row) { return row.cullMs; }));
    if (!results.memory.empty()) diagrams.push_back(memoryBars(results.memory));
    report::plot(folder, diagrams);
}

}  // namespace osgAnalyticBin::scale
