// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CsvTable.h"

#include "Failure.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <istream>
#include <set>
#include <sstream>

namespace osgAnalyticBin::flight {

using support::Failure;

namespace {

// Without leading and trailing blanks.
std::string trimmed(const std::string& text) {
    constexpr const char* kBlanks = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line + ',');  // what stands behind the last comma is a cell, too
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(trimmed(cell));
    return cells;
}

// Reads the next line that is neither empty nor a comment. Returns: false at the end of the file.
bool nextLine(std::istream& input, std::string& line, std::size_t& number) {
    while (std::getline(input, line)) {
        ++number;
        line = trimmed(line);
        if (!line.empty() && line.front() != '#') return true;
    }
    return false;
}

}  // namespace

std::optional<std::size_t> CsvTable::column(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns.begin());
}

CsvTable readCsv(std::istream& input, const std::string& fileName) {
    CsvTable table;
    table.fileName = fileName;
    std::string line;
    std::size_t number = 0;
    if (!nextLine(input, line, number)) throw Failure(fileName + ": no line that names the columns");
    table.columns = cellsOf(line);
    std::set<std::string> seen;
    for (const std::string& name : table.columns)
        if (!seen.insert(name).second)
            throw Failure(fileName + ":" + std::to_string(number) + ": column \"" + name + "\" stands twice");
    while (nextLine(input, line, number)) {
        const CsvTable::Row& row = table.rows.emplace_back(CsvTable::Row{number, cellsOf(line)});
        if (row.cells.size() != table.columns.size())
            throw Failure(atLine(table, row,
                                 std::to_string(row.cells.size()) + " cells, but the header names " +
                                     std::to_string(table.columns.size()) + " columns"));
    }
    return table;
}

std::string atLine(const CsvTable& table, const CsvTable::Row& row, const std::string& text) {
    return table.fileName + ":" + std::to_string(row.line) + ": " + text;
}

std::optional<double> numberFrom(const std::string& text) {
    double number = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    if (problem != std::errc() || stop != end || !std::isfinite(number)) return std::nullopt;
    return number;
}

std::string textFrom(double number) {
    std::array<char, 32> text{};
    const auto [stop, problem] = std::to_chars(text.data(), text.data() + text.size(), number);
    return problem == std::errc() ? std::string(text.data(), stop) : std::string("nan");
}

}  // namespace osgAnalyticBin::flight
