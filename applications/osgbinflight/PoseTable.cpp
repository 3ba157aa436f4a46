// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PoseTable.h"

#include "CsvTable.h"
#include "TextFile.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace osgAnalyticBin::flight {

namespace {

struct CountColumn {
    const char* name;
    std::uint64_t TileCounts::*count;
};

constexpr std::array<CountColumn, 9> kCounts{{{"tilesTested", &TileCounts::tested},
                                              {"tilesKept", &TileCounts::kept},
                                              {"tilesDrawn", &TileCounts::drawn},
                                              {"drawables", &TileCounts::drawables},
                                              {"triangles", &TileCounts::triangles},
                                              {"binsTested", &TileCounts::binsTested},
                                              {"binsOutside", &TileCounts::binsOutside},
                                              {"binsInside", &TileCounts::binsInside},
                                              {"binsStraddling", &TileCounts::binsStraddling}}};
// The largest integer up to which a double is exact.
constexpr double kLargestCount = 9007199254740992.0;

std::string textOf(const std::vector<PoseRecord>& records, const std::string& remark) {
    std::ostringstream output;
    output << "# " << remark << "\nname";
    for (const CountColumn& column : kCounts) output << ',' << column.name;
    output << ",files,cullMs,frameMs,picture\n";
    for (const PoseRecord& record : records) {
        output << record.name;
        for (const CountColumn& column : kCounts) output << ',' << record.tiles.*column.count;
        output << ',' << record.files << ',' << textFrom(record.cullMs) << ',' << textFrom(record.frameMs) << ','
               << record.picture << '\n';
    }
    return output.str();
}

/// The cells of one row by column name; the first thing wrong ends up in `error`.
class RowReader {
public:
    RowReader(const CsvTable& table, const CsvTable::Row& row, std::string& error)
        : _table(table), _row(row), _error(error) {}

    std::string text(const char* name) {
        const auto column = _table.column(name);
        if (column) return _row.cells[*column];
        fail(std::string("column \"") + name + "\" is missing");
        return {};
    }

    double number(const char* name) {
        const std::string cell = text(name);
        const auto value = numberFrom(cell);
        if (value && *value >= 0.0) return *value;
        fail(std::string(name) + " is \"" + cell + "\", not a number from 0 on");
        return 0.0;
    }

    std::uint64_t count(const char* name) {
        const double value = number(name);
        if (value <= kLargestCount && value == std::floor(value)) return static_cast<std::uint64_t>(value);
        fail(std::string(name) + " is not a whole number");
        return 0;
    }

private:
    void fail(const std::string& text) {
        if (_error.empty()) _error = atLine(_table, _row, text);
    }

    const CsvTable& _table;
    const CsvTable::Row& _row;
    std::string& _error;
};

PoseRecord recordOf(RowReader row) {
    PoseRecord record;
    record.name = row.text("name");
    for (const CountColumn& column : kCounts) record.tiles.*column.count = row.count(column.name);
    record.files = row.count("files");
    record.cullMs = row.number("cullMs");
    record.frameMs = row.number("frameMs");
    record.picture = row.text("picture");
    return record;
}

}  // namespace

bool writePoseTable(const std::string& folder, const std::vector<PoseRecord>& records, const std::string& remark,
                    std::string& error) {
    const std::string file = (std::filesystem::path(folder) / kPoseTableName).string();
    return support::replaceFile(file, textOf(records, remark), error);
}

std::optional<std::vector<PoseRecord>> readPoseTable(const std::string& folder, std::string& error) {
    error.clear();
    const std::string file = (std::filesystem::path(folder) / kPoseTableName).string();
    std::ifstream input(file);
    if (!input) {
        error = file + ": cannot be opened (did that run fail?)";
        return std::nullopt;
    }
    const auto table = readCsv(input, file, error);
    if (!table) return std::nullopt;
    std::vector<PoseRecord> records;
    for (const CsvTable::Row& row : table->rows) records.push_back(recordOf(RowReader(*table, row, error)));
    if (records.empty() && error.empty()) error = file + ": no pose";
    if (!error.empty()) return std::nullopt;
    return records;
}

}  // namespace osgAnalyticBin::flight
