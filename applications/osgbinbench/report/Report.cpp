// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Report.h"

#include "CommandLine.h"
#include "CsvTable.h"
#include "PictureDifference.h"
#include "PoseTable.h"
#include "Table.h"
#include "TextFile.h"

#include <osgDB/WriteFile>

#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

namespace osgAnalyticBin::report {

namespace {

using support::Failure;
using support::withDecimals;

constexpr const char* kRatioBase = "sphere";

struct Column {
    const char* title;
    const char* name;  // in poses.csv
    int decimals;
};

constexpr std::array<Column, 8> kColumns{{{"tested", "tilesTested", 0},
                                          {"kept", "tilesKept", 0},
                                          {"drawn", "tilesDrawn", 0},
                                          {"triangles", "triangles", 0},
                                          {"files", "files", 0},
                                          {"cull ms", "cullMs", 3},
                                          {"frame ms", "frameMs", 2},
                                          {"diff. pixels", kPixelsColumn, 0}}};

void addLine(TextTable& table, const std::string& title, const std::string& label, const Json& figures) {
    std::vector<std::string> cells{title, label};
    for (const Column& column : kColumns)
        cells.push_back(withDecimals(figures[column.name].get<double>(), column.decimals));
    table.add(std::move(cells));
}

void addSums(TextTable& table, const std::string& title, const std::vector<Flight>& flights, const PathGroup& group) {
    table.addGap();
    std::vector<Json> sums;
    std::optional<std::size_t> base;
    for (const Flight& flight : flights) {
        if (!base && flight.figures.method == kRatioBase) base = sums.size();
        sums.push_back(sumOf(flight.figures, group));
        addLine(table, sums.size() == 1 ? title : "", flight.figures.method, sums.back());
    }
    for (std::size_t i = 0; base && i < flights.size(); ++i) {
        if (i == *base) continue;
        std::vector<std::string> cells{"", flights[i].figures.method + " / " + kRatioBase};
        for (const Column& column : kColumns) {
            // a ratio of differing pixels says nothing
            if (column.name == kPixelsColumn) break;
            cells.push_back(ratioText(sums[i][column.name].get<double>(), sums[*base][column.name].get<double>()));
        }
        table.add(std::move(cells));
    }
}

// The number in a cell. Throws: Failure.
double numberIn(const flight::CsvTable& table, const flight::CsvTable::Row& row, std::size_t column) {
    const auto number = flight::numberFrom(row.cells[column]);
    if (number && *number >= 0.0) return *number;
    throw Failure(flight::atLine(table, row,
                                 table.columns[column] + " is \"" + row.cells[column] + "\", not a number from 0 on"));
}

Flight flightFrom(const std::string& folder) {
    namespace fs = std::filesystem;
    const fs::path path = fs::path(folder).lexically_normal();
    Flight flight{folder, {}, {}, {(path.has_filename() ? path : path.parent_path()).filename().string(), {}}};
    const std::string file = (fs::path(folder) / flight::kPoseTableName).string();
    std::ifstream input(file);
    if (!input) throw Failure(file + ": cannot be opened (did that flight fail?)");
    const flight::CsvTable table = flight::readCsv(input, file);
    for (const flight::CsvTable::Row& row : table.rows) {
        Json& figures = flight.figures.rows.emplace_back();
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            const std::string& column = table.columns[i];
            if (column == "name")
                flight.poses.push_back(row.cells[i]);
            else if (column == "picture")
                flight.pictures.push_back(row.cells[i]);
            else
                figures[column] = numberIn(table, row, i);
        }
        figures[kPixelsColumn] = 0.0;
    }
    bool isWhole = !flight.poses.empty() && !flight.pictures.empty();
    for (const Column& column : kColumns) isWhole = isWhole && flight.figures.rows.front().contains(column.name);
    if (!isWhole) throw Failure(file + ": no pose, or a column is missing");
    return flight;
}

void write(const PictureDifference& difference, const std::string& folder, const std::string& name) {
    const std::filesystem::path file = std::filesystem::path(folder) / (name + ".png");
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem || !osgDB::writeImageFile(*difference.picture, file.string()))
        throw Failure(file.string() + ": cannot be written");
}

void comparePictures(const Flight& reference, Flight& flight, const std::string& differenceFolder) {
    for (std::size_t i = 0; i < flight.poses.size(); ++i) {
        const auto pathOf = [i](const Flight& of) {
            return (std::filesystem::path(of.folder) / of.pictures[i]).string();
        };
        const PictureDifference difference = compareFiles(pathOf(reference), pathOf(flight));
        flight.figures.rows[i][kPixelsColumn] = static_cast<double>(difference.pixels);
        if (difference.pixels > 0 && !differenceFolder.empty())
            write(difference, differenceFolder, flight.figures.method + "_" + flight.poses[i]);
    }
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

std::vector<Flight> readFlights(const std::vector<std::string>& folders, const std::string& differenceFolder) {
    std::vector<Flight> flights;
    for (const std::string& folder : folders) {
        Flight& flight = flights.emplace_back(flightFrom(folder));
        if (flight.poses != flights.front().poses)
            throw Failure(folder + ": its poses are not those of " + folders.front());
        if (flights.size() > 1) comparePictures(flights.front(), flight, differenceFolder);
    }
    return flights;
}

void print(std::ostream& output, const std::vector<Flight>& flights) {
    const std::vector<std::string>& poses = flights.front().poses;
    TextTable table(2);
    std::vector<std::string> titles{"pose", "method"};
    for (const Column& column : kColumns) titles.emplace_back(column.title);
    table.add(std::move(titles));
    for (std::size_t i = 0; i < poses.size(); ++i)
        for (const Flight& flight : flights)
            addLine(table, &flight == &flights.front() ? poses[i] : "", flight.figures.method, flight.figures.rows[i]);
    for (const PathGroup& group : pathGroupsOf(poses))
        if (group.poses.size() > 1) addSums(table, "sum of " + group.name + "_*", flights, group);
    addSums(table, "sum of all poses", flights, allOf(flights.front().figures));
    table.print(output);
}

std::vector<Mismatch> mismatchesOf(const std::vector<Flight>& flights) {
    std::vector<Mismatch> found;
    for (const auto& [folder, poses, pictures, figures] : flights) {
        if (figures.method == "paper" || figures.method == "corners") continue;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const auto pixels = figures.rows[i][kPixelsColumn].get<double>();
            if (pixels > 0.0) found.push_back({figures.method, poses[i], pixels});
        }
    }
    return found;
}

support::ExitCode run(int argc, char** argv) {
    CLI::App app{"Compares flights over a database that were made with different culling methods.",
                 "osgbinbench report"};
    app.footer(kFooter);
    std::vector<std::string> folders;
    std::string differenceFolder;
    app.add_option("DIR", folders, "Folders that flights left (poses.csv and pictures); the first is the reference");
    app.add_option("--difference", differenceFolder, "Folder for pictures of the differences: differing pixels red");
    if (!support::parseCommandLine(app, argc, argv)) return support::kSucceeded;
    if (folders.empty()) throw support::UsageError("DIR is required; see osgbinbench report --help");
    const std::vector<Flight> flights = readFlights(folders, differenceFolder);
    print(std::cout, flights);
    const std::vector<Mismatch> mismatches = mismatchesOf(flights);
    for (const Mismatch& mismatch : mismatches)
        std::cerr << "osgbinbench report: method " << mismatch.label
                  << " draws another picture than the reference at pose " << mismatch.pose << ": "
                  << withDecimals(mismatch.pixels, 0) << " pixels differ\n";
    return mismatches.empty() ? support::kSucceeded : support::kFailed;
}

}  // namespace osgAnalyticBin::report
