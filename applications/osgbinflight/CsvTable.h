// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::flight {

/// A file of comma-separated values whose first line names the columns. Lines that start with `#` and empty lines are
/// skipped; blanks around a cell are dropped; there are no quotes.
struct CsvTable {
    /// A line of the file.
    struct Row {
        std::size_t line = 0;            ///< line number in the file, from 1
        std::vector<std::string> cells;  ///< a text for each column
    };

    std::string fileName;              ///< for messages
    std::vector<std::string> columns;  ///< their names, from the first line
    std::vector<Row> rows;             ///< all other lines

    /// Returns: nullopt when there is no such column.
    [[nodiscard]] std::optional<std::size_t> column(const std::string& name) const;
};

/// Reads a table; the file name is used in messages only.
/// Throws: Failure that names the file and the line, when the header is missing or names a column twice, or when a row
/// has more or fewer cells than the header.
[[nodiscard]] CsvTable readCsv(std::istream& input, const std::string& fileName);

/// Returns: "file:line: text", the form of all messages about a line.
[[nodiscard]] std::string atLine(const CsvTable& table, const CsvTable::Row& row, const std::string& text);

/// Returns: nullopt unless the whole text is one finite number, written with a decimal point whatever the locale.
[[nodiscard]] std::optional<double> numberFrom(const std::string& text);

/// The shortest text that reads back to the same number.
[[nodiscard]] std::string textFrom(double number);

}  // namespace osgAnalyticBin::flight
