// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TextTable.h"

#include <algorithm>
#include <ostream>

namespace osgAnalyticBin::report {

namespace {

std::vector<std::size_t> widthsOf(const std::vector<std::vector<std::string>>& lines) {
    std::vector<std::size_t> widths;
    for (const auto& line : lines) {
        widths.resize(std::max(widths.size(), line.size()));
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    }
    return widths;
}

}  // namespace

void TextTable::print(std::ostream& output) const {
    const std::vector<std::size_t> widths = widthsOf(_lines);
    for (const auto& line : _lines) {
        std::string text;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const std::string padding(widths[i] - line[i].size(), ' ');
            if (i > 0) text += "  ";
            text += i < _leftColumns ? line[i] + padding : padding + line[i];
        }
        text.erase(text.find_last_not_of(' ') + 1);
        output << text << '\n';
    }
}

std::string htmlText(const std::string& text) {
    std::string html;
    for (const char c : text) html += c == '<' ? std::string("&lt;") : c == '&' ? "&amp;" : std::string(1, c);
    return html;
}

void TextTable::printHtml(std::ostream& output) const {
    output << "<table>\n<thead>\n";
    const char* cell = "th";
    for (const auto& line : _lines) {
        output << (line.empty() ? "<tbody>" : "<tr>");
        for (std::size_t i = 0; i < line.size(); ++i)
            output << '<' << cell << (i < _leftColumns ? " class=\"left\">" : ">") << htmlText(line[i]) << "</" << cell
                   << '>';
        output << '\n';
        if (&line == &_lines.front()) output << "<tbody>\n";
        cell = "td";
    }
    output << "</table>\n";
}

}  // namespace osgAnalyticBin::report
