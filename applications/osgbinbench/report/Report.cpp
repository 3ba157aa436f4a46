// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Report.h"

#include "CommandLine.h"
#include "CsvTable.h"
#include "Failure.h"
#include "PathGroups.h"
#include "PictureDifference.h"
#include "PoseTable.h"
#include "Table.h"
#include "TextFile.h"

#include <osgDB/WriteFile>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>

namespace osgAnalyticBin::report {

namespace {

using support::withDecimals;

constexpr const char* kRatioBase = "sphere";

struct Column {
    const char* title;
    const char* name;  // in poses.csv
    int decimals;
};

constexpr std::array<Column, 7> kColumns{{{"tested", "tilesTested", 0},
                                          {"kept", "tilesKept", 0},
                                          {"drawn", "tilesDrawn", 0},
                                          {"triangles", "triangles", 0},
                                          {"files", "files", 0},
                                          {"cull ms", "cullMs", 3},
                                          {"frame ms", "frameMs", 2}}};

double sumOf(const std::vector<double>& numbers, const PathGroup& group) {
    return std::accumulate(group.poses.begin(), group.poses.end(), 0.0,
                           [&](double sum, std::size_t pose) { return sum + numbers[pose]; });
}

PathGroup allOf(const std::vector<std::string>& poses) {
    PathGroup all{"all poses", std::vector<std::size_t>(poses.size())};
    std::iota(all.poses.begin(), all.poses.end(), std::size_t{0});
    return all;
}

void addLine(TextTable& table, const std::string& title, const Flight& flight, const PathGroup& group) {
    std::vector<std::string> cells{title, flight.label};
    for (const Column& column : kColumns)
        cells.push_back(withDecimals(sumOf(flight.figures.at(column.name), group), column.decimals));
    cells.push_back(withDecimals(sumOf(flight.differingPixels, group), 0));
    table.add(std::move(cells));
}

void addSums(TextTable& table, const std::string& title, const std::vector<Flight>& flights, const PathGroup& group) {
    table.addGap();
    for (const Flight& flight : flights) addLine(table, &flight == &flights.front() ? title : "", flight, group);
    const auto base =
        std::find_if(flights.begin(), flights.end(), [](const Flight& f) { return f.label == kRatioBase; });
    for (const Flight& flight : flights) {
        if (base == flights.end() || &flight == &*base) continue;
        // of all but the pixels: a ratio of differing pixels says nothing
        std::vector<std::string> cells{"", flight.label + " / " + kRatioBase};
        for (const Column& column : kColumns)
            cells.push_back(
                ratioText(sumOf(flight.figures.at(column.name), group), sumOf(base->figures.at(column.name), group)));
        table.add(std::move(cells));
    }
}

std::optional<Flight> flightFrom(const std::string& folder, std::string& error) {
    namespace fs = std::filesystem;
    const fs::path path = fs::path(folder).lexically_normal();
    Flight flight{folder, (path.has_filename() ? path : path.parent_path()).filename().string(), {}, {}, {}, {}};
    const std::string file = (fs::path(folder) / flight::kPoseTableName).string();
    std::ifstream input(file);
    if (!input) error = file + ": cannot be opened (did that flight fail?)";
    const auto table = input ? flight::readCsv(input, file, error) : std::nullopt;
    if (!table) return std::nullopt;
    for (const flight::CsvTable::Row& row : table->rows) {
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            const std::string &column = table->columns[i], &cell = row.cells[i];
            const auto number = flight::numberFrom(cell);
            if (column == "name") {
                flight.poses.push_back(cell);
            } else if (column == "picture") {
                flight.pictures.push_back(cell);
            } else if (number && *number >= 0.0) {
                flight.figures[column].push_back(*number);
            } else {
                error = flight::atLine(*table, row, column + " is \"" + cell + "\", not a number from 0 on");
                return std::nullopt;
            }
        }
    }
    bool isWhole = !flight.poses.empty() && !flight.pictures.empty();
    for (const Column& column : kColumns) isWhole = isWhole && flight.figures.count(column.name) > 0;
    if (!isWhole) error = file + ": no pose, or a column is missing";
    flight.differingPixels.resize(flight.poses.size());
    return isWhole ? std::optional(flight) : std::nullopt;
}

bool write(const PictureDifference& difference, const std::string& folder, const std::string& name,
           std::string& error) {
    const std::filesystem::path file = std::filesystem::path(folder) / (name + ".png");
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (!problem && osgDB::writeImageFile(*difference.picture, file.string())) return true;
    error = file.string() + ": cannot be written";
    return false;
}

bool comparePictures(const Flight& reference, Flight& flight, const std::string& differenceFolder, std::string& error) {
    for (std::size_t i = 0; i < flight.poses.size(); ++i) {
        const auto pathOf = [i](const Flight& of) {
            return (std::filesystem::path(of.folder) / of.pictures[i]).string();
        };
        const auto difference = compareFiles(pathOf(reference), pathOf(flight), error);
        if (!difference) return false;
        flight.differingPixels[i] = static_cast<double>(difference->pixels);
        if (difference->pixels > 0 && !differenceFolder.empty() &&
            !write(*difference, differenceFolder, flight.label + "_" + flight.poses[i], error))
            return false;
    }
    return true;
}

constexpr const char* kFooter =
    "Tiles: tested = the cull traversal reached the tile; kept = it reached what is below; drawn = its own\n"
    "geometry was drawn. Files: node files read from the camera's arrival on. Cull, frame: milliseconds,\n"
    "median; a frame is from one to the next, drawing included. Methods have the names of the folders.\n"
    "Exit code: 0; 1 when a picture of a sound method (any but paper and corners) differs from the reference,\n"
    "or when a flight cannot be read; 2 when the command line is wrong.\n\n"
    "Example:\n"
    "  osgbinbench report demo/none demo/sphere demo/quadratic --difference demo/difference";

}  // namespace

double Flight::sum(const std::string& column) const {
    return sumOf(figures.at(column), allOf(poses));
}

std::optional<Report> Report::of(const std::vector<std::string>& folders, const std::string& differenceFolder,
                                 std::string& error) {
    Report report;
    for (const std::string& folder : folders) {
        auto flight = flightFrom(folder, error);
        if (!flight) return std::nullopt;
        const bool isReference = report._flights.empty();
        if (!isReference && flight->poses != report._flights.front().poses) {
            error = folder + ": its poses are not those of " + folders.front();
            return std::nullopt;
        }
        if (!isReference && !comparePictures(report._flights.front(), *flight, differenceFolder, error))
            return std::nullopt;
        report._flights.push_back(std::move(*flight));
    }
    return report;
}

void Report::print(std::ostream& output) const {
    if (_flights.empty()) return;
    const std::vector<std::string>& poses = _flights.front().poses;
    TextTable table(2);
    std::vector<std::string> titles{"pose", "method"};
    for (const Column& column : kColumns) titles.emplace_back(column.title);
    titles.emplace_back("diff. pixels");
    table.add(std::move(titles));
    for (std::size_t i = 0; i < poses.size(); ++i)
        for (const Flight& flight : _flights)
            addLine(table, &flight == &_flights.front() ? poses[i] : "", flight, {"", {i}});
    for (const PathGroup& group : pathGroupsOf(poses))
        if (group.poses.size() > 1) addSums(table, "sum of " + group.name + "_*", _flights, group);
    addSums(table, "sum of all poses", _flights, allOf(poses));
    table.print(output);
}

std::vector<Mismatch> Report::mismatches() const {
    std::vector<Mismatch> found;
    for (const Flight& flight : _flights) {
        if (flight.label == "paper" || flight.label == "corners") continue;
        for (std::size_t i = 0; i < flight.poses.size(); ++i)
            if (flight.differingPixels[i] > 0.0)
                found.push_back({flight.label, flight.poses[i], flight.differingPixels[i]});
    }
    return found;
}

support::ExitCode run(int argc, char** argv) {
    support::CommandLine line("osgbinbench report",
                              "Compares flights over a database that were made with different culling methods.",
                              kFooter);
    std::vector<std::string> folders;
    std::string differenceFolder;
    line.addAll("DIR", folders, "Folders that flights left (poses.csv and pictures); the first is the reference");
    line.add("--difference", differenceFolder, "Folder for pictures of the differences: differing pixels red");
    if (!line.parse(argc, argv)) return support::kSucceeded;
    if (folders.empty()) throw support::UsageError("DIR is required; see osgbinbench report --help");
    std::string error;
    const auto report = Report::of(folders, differenceFolder, error);
    if (!report) throw support::Failure(error);
    report->print(std::cout);
    const std::vector<Mismatch> mismatches = report->mismatches();
    for (const Mismatch& mismatch : mismatches)
        std::cerr << "osgbinbench report: method " << mismatch.label
                  << " draws another picture than the reference at pose " << mismatch.pose << ": "
                  << withDecimals(mismatch.pixels, 0) << " pixels differ\n";
    return mismatches.empty() ? support::kSucceeded : support::kFailed;
}

}  // namespace osgAnalyticBin::report
