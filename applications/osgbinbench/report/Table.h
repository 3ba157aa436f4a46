// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// A row of a table is an object: its keys name the columns.
using Json = nlohmann::ordered_json;

/// A cell for people: with so many decimals unless it is a text or a whole number.
[[nodiscard]] std::string cellText(const Json& value, int decimals);

/// Comma-separated values: a line with the columns of all rows, in the order in which they first come, then a line for
/// each row. Numbers read back exactly; a cell that a row does not have is empty; texts with a comma are quoted.
[[nodiscard]] std::string csvOf(const std::vector<Json>& rows);

/// Columns, each a `name` and its `meaning`, for --help: one a line, the meanings below each other.
template <class Columns>
[[nodiscard]] std::string linesOf(const Columns& columns, std::size_t width) {
    std::string text;
    for (const auto& column : columns) {
        std::string name = std::string("  ") + column.name;
        name.resize(width, ' ');
        text += name + column.meaning + "\n";
    }
    return text;
}

/// The value over the reference; "-" where that is not above zero.
[[nodiscard]] std::string ratioText(double value, double reference);

/// Every number of an object over that of the same key of another one, as a text.
[[nodiscard]] Json ratiosOf(const Json& row, const Json& reference);

/// The text with HTML's own characters escaped.
[[nodiscard]] std::string htmlText(const std::string& text);

/// Lines of text in columns: the leading columns flush left, the others, numbers, flush right.
class TextTable {
public:
    explicit TextTable(std::size_t leftColumns) : _leftColumns(leftColumns) {}

    void add(std::vector<std::string> cells) { _lines.push_back(std::move(cells)); }

    /// Adds the cells of a row, below its keys in the first line; `decimals` as of cellText().
    void addRow(const Json& row, int decimals);
    /// An empty line.
    void addGap() { _lines.emplace_back(); }

    void print(std::ostream& output) const;

    /// The same as an HTML table: the first line is its head, and a gap begins another part of it.
    void printHtml(std::ostream& output) const;

private:
    std::size_t _leftColumns;
    std::vector<std::vector<std::string>> _lines;
};

/// What was measured of one method: a row for each pose, or a single one for a flight. All rows have the same columns,
/// which are numbers.
struct MethodFigures {
    std::string method;
    std::vector<Json> rows;
};

/// Poses that belong together: their names share the text before the first `_`, or without one all but the number at
/// their end. This names the path.
struct PathGroup {
    std::string name;
    std::vector<std::size_t> poses;  ///< places in the list of poses
};

/// The groups in the order in which their first poses come; every pose is in one.
[[nodiscard]] std::vector<PathGroup> pathGroupsOf(const std::vector<std::string>& poses);

/// All rows of a method as one group, without a name.
[[nodiscard]] PathGroup allOf(const MethodFigures& method);

/// The sums of the columns over the poses of one group. Requires: at least one row.
[[nodiscard]] Json sumOf(const MethodFigures& method, const PathGroup& group);

}  // namespace osgAnalyticBin::report
