// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Failure.h"
#include "GnuplotRun.h"
#include "Output.h"

#include <osgAnalyticBin/viewer/CsvTable.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>

namespace osgAnalyticBin::scale {

using support::Failure;

namespace {

using flight::textFrom;

template <class Row>
std::vector<std::string> methodsOf(const std::vector<Row>& rows) {
    std::vector<std::string> methods;
    for (const Row& row : rows)
        if (std::find(methods.begin(), methods.end(), row.method) == methods.end()) methods.push_back(row.method);
    return methods;
}

// A line for each method, through the points of its rows.
template <class Row>
std::string linesOf(const std::vector<Row>& rows, const std::function<std::pair<double, double>(const Row&)>& point) {
    std::ostringstream data;
    std::string plot = "plot ";
    int number = 0;
    for (const std::string& method : methodsOf(rows)) {
        data << "$m" << number << " << EOD\n";
        for (const Row& row : rows) {
            if (row.method != method) continue;
            const auto [x, y] = point(row);
            data << textFrom(x) << ' ' << textFrom(y) << '\n';
        }
        data << "EOD\n";
        if (number > 0) plot += ", ";
        plot += "$m" + std::to_string(number++) + " with linespoints title '" + method + "'";
    }
    return data.str() + plot + "\n";
}

std::string depthPlot(const std::vector<DepthRow>& rows) {
    return "set title 'Cull time for each drawn tile'\nset xlabel 'levels below the start tiles'\n"
           "set ylabel 'microseconds'\nset yrange [0:*]\n" +
           linesOf<DepthRow>(rows, [](const DepthRow& row) {
               return std::pair(static_cast<double>(row.levels), row.usPerDrawnTile());
           });
}

std::string flightPlot(const std::vector<DepthRow>& rows) {
    return "set title 'Cull time of the flight'\nset xlabel 'levels below the start tiles'\n"
           "set ylabel 'milliseconds, one frame at each pose'\nset yrange [0:*]\n" +
           linesOf<DepthRow>(
               rows, [](const DepthRow& row) { return std::pair(static_cast<double>(row.levels), row.cullMs); });
}

std::string residentPlot(const std::vector<ResidentRow>& rows) {
    return "set title 'Cull time of one view'\nset xlabel 'PagedLODs in memory (logarithmic)'\nset logscale x\n"
           "set rmargin 6\n"
           "set ylabel 'milliseconds'\nset yrange [0:*]\n" +
           linesOf<ResidentRow>(
               rows, [](const ResidentRow& row) { return std::pair(static_cast<double>(row.pagedLods), row.cullMs); });
}

std::string memoryPlot(const std::vector<MemoryRow>& rows) {
    std::string data = "$bars << EOD\n";
    for (const MemoryRow& row : rows) data += "\"" + row.method + "\" " + textFrom(row.bytesPerTile / 1024.0) + "\n";
    return data +
           "EOD\nset title 'Memory of a tile'\nset ylabel 'KiB'\nset yrange [0:*]\nset style fill solid 0.6\n"
           "set boxwidth 0.6\nunset key\nset xtics rotate by 20 right\nplot $bars using 0:2:xtic(1) with boxes\n";
}

void runGnuplot(const std::string& commands) {
    if (support::runGnuplot({{}, commands, "", "/dev/null"}) != 0)
        throw Failure("--plot: gnuplot failed; install the package gnuplot-nox");
}

void draw(const std::string& folder, const std::string& name, const std::string& commands) {
    const struct {
        const char* extension;
        const char* terminal;
    } kinds[] = {{".svg", "svg size 800,500 noenhanced background 'white'"},
                 {".png", "pngcairo size 800,500 noenhanced"}};
    for (const auto& kind : kinds) {
        const std::string file = folder + "/" + name + kind.extension;
        const std::string unfinished = file + ".tmp";
        runGnuplot(std::string("set terminal ") + kind.terminal + "\nset output " +
                   support::quotedForGnuplot(unfinished) + "\nset key bottom right\nset grid\n" + commands +
                   "unset output\n");
        std::error_code problem;
        std::filesystem::rename(unfinished, file, problem);
        if (problem) throw Failure(file + ": cannot be written; check that its folder is there and not full");
    }
}

}  // namespace

void requireGnuplot() {
    runGnuplot("exit\n");
}

void plot(const std::string& folder, const Results& results) {
    if (!results.depth.empty()) draw(folder, "depth", depthPlot(results.depth));
    if (!results.depth.empty()) draw(folder, "flight", flightPlot(results.depth));
    if (!results.residents.empty()) draw(folder, "residents", residentPlot(results.residents));
    if (!results.memory.empty()) draw(folder, "memory", memoryPlot(results.memory));
}

}  // namespace osgAnalyticBin::scale
