// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Gnuplot.h"

#include "Failure.h"
#include "GnuplotRun.h"

#include <array>
#include <filesystem>
#include <fstream>

namespace osgAnalyticBin::paper {

using support::Failure;

namespace {

namespace fs = std::filesystem;

// What gnuplot says after the place in the script: "PLACE: REASON".
std::string reasonIn(const std::string& file) {
    std::ifstream stream(file);
    std::string line;
    while (std::getline(stream, line)) {
        const std::size_t place = line.find(": ");
        const std::size_t reason = place == std::string::npos ? place : line.find_first_not_of(' ', place + 1);
        if (reason != std::string::npos) return line.substr(reason);
    }
    return "gnuplot gives no reason";
}

struct Terminal {
    const char* ending;
    const char* command;
    int fontSize;
};

constexpr std::array<Terminal, 2> kTerminals{
    {{".svg", "set terminal svg background 'white'", 15}, {".png", "set terminal pngcairo", 12}}};

}  // namespace

PlotScript& PlotScript::operator<<(const std::string& line) {
    _text += line + "\n";
    return *this;
}

void PlotScript::addBlock(const std::string& name, const std::vector<Polyline>& lines) {
    std::vector<std::string> rows;
    for (const Polyline& line : lines) {
        for (const glm::dvec3& p : line)
            rows.push_back(withDecimals(p.x, 6) + " " + withDecimals(p.y, 6) + " " + withDecimals(p.z, 6));
        rows.emplace_back();
        rows.emplace_back();
    }
    addRows(name, rows);
}

void PlotScript::addRows(const std::string& name, const std::vector<std::string>& rows) {
    _text += name + " << END\n";
    for (const std::string& row : rows) _text += row + "\n";
    _text += "END\n";
}

void PlotScript::addKey(double part, const std::vector<std::string>& entries) {
    _text += R"(unset label
unset arrow
unset object
unset tics
unset border
unset grid
unset title
unset xlabel
unset ylabel
set origin 0,0
set lmargin at screen 0.01
set rmargin at screen 0.99
set bmargin at screen 0
set xrange [0:1]
set yrange [0:1]
set key center center horizontal samplen 2
)";
    _text += "set size 1," + withDecimals(part, 3) + "\nset tmargin at screen " + withDecimals(part, 3) +
             "\nplot NaN notitle";
    for (const std::string& entry : entries) _text += ", keyentry " + entry;
    _text += "\n";
}

Gnuplot::Gnuplot(const std::string& folder) : _folder(folder) {
    support::makeFolder("--plot", folder);
    if (support::runGnuplot({{"--version"}, "", "", "/dev/null"}) != 0)
        throw Failure("cannot run gnuplot; install the package gnuplot-nox, or leave --plot out");
}

void Gnuplot::draw(const std::string& name, int height, const PlotScript& script) const {
    for (const Terminal& terminal : kTerminals) {
        const std::string target = file(name + terminal.ending);
        const std::string unfinished = target + ".tmp";
        const std::string messages = file(name + ".messages.tmp");
        const std::string head = std::string(terminal.command) + " size " + std::to_string(kWidth) + "," +
                                 std::to_string(height) + " font 'DejaVu Sans," + std::to_string(terminal.fontSize) +
                                 "'\nset output " + support::quotedForGnuplot(unfinished) + "\nset encoding utf8\n";
        const auto code =
            support::runGnuplot({{}, head + script.text() + "unset multiplot\nunset output\n", "", messages});
        const std::string reason = code == 0 ? "" : reasonIn(messages);
        std::error_code problem;
        fs::remove(messages, problem);
        if (code == 0) fs::rename(unfinished, target, problem);
        if (code == 0 && !problem) continue;
        const std::string why = code == 0 ? problem.message() : reason;
        fs::remove(unfinished, problem);
        throw Failure("cannot draw \"" + target + "\": " + why +
                      "; check that the folder can be written and is not full");
    }
}

}  // namespace osgAnalyticBin::paper
