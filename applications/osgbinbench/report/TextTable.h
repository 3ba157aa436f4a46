// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace osgAnalyticBin::report {

/// The text with HTML's own characters escaped.
[[nodiscard]] std::string htmlText(const std::string& text);

/// Lines of text in columns: the leading columns flush left, the others, numbers, flush right.
class TextTable {
public:
    explicit TextTable(std::size_t leftColumns) : _leftColumns(leftColumns) {}

    void add(std::vector<std::string> cells) { _lines.push_back(std::move(cells)); }

    /// An empty line.
    void addGap() { _lines.emplace_back(); }

    void print(std::ostream& output) const;

    /// The same as an HTML table: the first line is its head, and a gap begins another part of it.
    void printHtml(std::ostream& output) const;

private:
    std::size_t _leftColumns;
    std::vector<std::vector<std::string>> _lines;
};

}  // namespace osgAnalyticBin::report
