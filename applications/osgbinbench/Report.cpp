// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Report.h"

#include "BenchViewer.h"
#include "CommandLine.h"
#include "CsvTable.h"
#include "Output.h"

#include <osgDB/ReadFile>

#include <filesystem>
#include <fstream>
#include <iostream>

namespace osgAnalyticBin::bench {

namespace {

namespace fs = std::filesystem;
using report::Json;
using support::Failure;

constexpr const char* kPixelsColumn = "differing_pixels";

/// One folder: a row for each pose, its name, and its picture.
struct FlownFolder {
    MethodFigures figures;
    std::vector<std::string> columns, poses, pictures;
};

// Times are numbers with a fraction, all others are counts. Throws: Failure.
Json numberIn(const flight::CsvTable& table, const flight::CsvTable::Row& row, std::size_t column) {
    const std::string& name = table.columns[column];
    const auto number = flight::numberFrom(row.cells[column]);
    if (!number || *number < 0.0)
        throw Failure(flight::atLine(table, row, name + " is \"" + row.cells[column] + "\", not a number from 0 on"));
    const bool isTime = name.size() > 3 && name.substr(name.size() - 3) == "_ms";
    return isTime ? Json(*number) : Json(static_cast<std::uint64_t>(*number));
}

FlownFolder flownFrom(const std::string& folder) {
    const fs::path path = fs::path(folder).lexically_normal();
    FlownFolder flown{{(path.has_filename() ? path : path.parent_path()).filename().string(), {}}, {}, {}, {}};
    const std::string file = (path / "poses.csv").string();
    std::ifstream input(file);
    if (!input) throw Failure(file + ": cannot be opened (did that flight fail?)");
    const flight::CsvTable table = flight::readCsv(input, file);
    flown.columns = table.columns;
    for (const flight::CsvTable::Row& row : table.rows) {
        Json& figures = flown.figures.rows.emplace_back();
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            const std::string& column = table.columns[i];
            if (column == "name")
                flown.poses.push_back(row.cells[i]);
            else if (column == "picture")
                flown.pictures.push_back((path / row.cells[i]).string());
            else
                figures[column] = numberIn(table, row, i);
        }
        figures[kPixelsColumn] = std::uint64_t{0};
    }
    if (flown.poses.empty() || flown.pictures.empty()) throw Failure(file + ": no pose, or no picture");
    return flown;
}

// Of two files.
osg::ref_ptr<osg::Image> read(const std::string& file) {
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file);
    if (!image) throw Failure(file + ": cannot be read as a picture");
    return image;
}

std::uint64_t differingInFiles(const std::string& first, const std::string& second) {
    const osg::ref_ptr<osg::Image> a = read(first), b = read(second);
    try {
        return differingPixels(*a, *b);
    } catch (const Failure& failure) {
        throw Failure(first + ", " + second + ": " + failure.what());
    }
}

constexpr const char* kFooter =
    "Sums over all poses and over those whose names share the text before the first _. Tiles: tested_tiles = the cull\n"
    "traversal reached the tile; kept_tiles = it reached what is below; drawn_tiles = its own geometry was drawn.\n"
    "files_requested: node files read from the camera's arrival on. cull_ms, frame_ms: median at each pose; a frame "
    "is\n"
    "from one to the next, drawing included. Methods have the names of the folders.\n"
    "Exit code: 0; 1 when a picture of a sound method (any but paper and corners) differs from the reference,\n"
    "or when a flight cannot be read; 2 when the command line is wrong.\n\n"
    "Example:\n"
    "  osgbinbench report demo/none demo/sphere demo/quadratic";

}  // namespace

Measurement readFlights(const std::vector<std::string>& folders) {
    const FlownFolder reference = flownFrom(folders.front());
    Measurement flown{reference.poses, {reference.figures}};
    for (std::size_t f = 1; f < folders.size(); ++f) {
        FlownFolder other = flownFrom(folders[f]);
        for (const MethodFigures& known : flown.methods)
            if (known.method == other.figures.method)
                throw Failure(folders[f] + ": there is a flight of that name already; rename the folder");
        if (other.poses != reference.poses)
            throw Failure(folders[f] + ": its poses are not those of " + folders.front());
        if (other.columns != reference.columns)
            throw Failure(folders[f] + ": its columns are not those of " + folders.front());
        for (std::size_t i = 0; i < other.poses.size(); ++i)
            other.figures.rows[i][kPixelsColumn] = differingInFiles(reference.pictures[i], other.pictures[i]);
        flown.methods.push_back(std::move(other.figures));
    }
    return flown;
}

std::vector<std::string> mismatchesOf(const Measurement& flown) {
    std::vector<std::string> found;
    for (const auto& [method, rows] : flown.methods) {
        if (method == "paper" || method == "corners") continue;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (const auto pixels = rows[i][kPixelsColumn].get<std::uint64_t>(); pixels > 0)
                found.push_back("method " + method + " draws another picture than the reference at pose " +
                                flown.poses[i] + ": " + std::to_string(pixels) + " pixels differ");
    }
    return found;
}

support::ExitCode runReport(int argc, char** argv) {
    CLI::App app{"Compares flights over a database that were made with different culling methods.",
                 "osgbinbench report"};
    app.footer(kFooter);
    std::vector<std::string> folders;
    app.add_option("DIR", folders, "Folders that flights left (poses.csv and pictures); the first is the reference")
        ->required();
    if (!support::parseCommandLine(app, argc, argv)) return support::kSucceeded;
    const Measurement flown = readFlights(folders);
    print(std::cout, tablesOf(flown));
    const std::vector<std::string> mismatches = mismatchesOf(flown);
    for (const std::string& mismatch : mismatches) std::cerr << "osgbinbench report: " << mismatch << '\n';
    return mismatches.empty() ? support::kSucceeded : support::kFailed;
}

}  // namespace osgAnalyticBin::bench
