// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Table.h"

#include "CsvTable.h"
#include "TextFile.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
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

std::vector<std::string> columnsOf(const std::vector<Json>& rows) {
    std::vector<std::string> columns;
    for (const Json& row : rows)
        for (const auto& item : row.items())
            if (std::find(columns.begin(), columns.end(), item.key()) == columns.end()) columns.push_back(item.key());
    return columns;
}

std::string csvCell(const Json& value) {
    if (value.is_number_float()) return flight::textFrom(value.get<double>());
    if (!value.is_string()) return value.dump();
    const auto text = value.get<std::string>();
    return text.find(',') == std::string::npos ? text : "\"" + text + "\"";
}

}  // namespace

std::string cellText(const Json& value, int decimals) {
    if (value.is_number_float()) return support::withDecimals(value.get<double>(), decimals);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string csvOf(const std::vector<Json>& rows) {
    const std::vector<std::string> columns = columnsOf(rows);
    std::string text;
    for (const std::string& column : columns) text += (text.empty() ? "" : ",") + column;
    for (const Json& row : rows) {
        const char* before = "\n";
        for (const std::string& column : columns) {
            text += before + (row.contains(column) ? csvCell(row[column]) : std::string());
            before = ",";
        }
    }
    return text + "\n";
}

std::string ratioText(double value, double reference) {
    return reference > 0.0 ? support::withDecimals(value / reference, 3) : "-";
}

Json ratiosOf(const Json& row, const Json& reference) {
    Json ratios;
    for (const auto& [column, value] : row.items())
        ratios[column] = ratioText(value.get<double>(), reference[column].get<double>());
    return ratios;
}

void TextTable::addRow(const Json& row, int decimals) {
    std::vector<std::string> titles, cells;
    for (const auto& item : row.items()) {
        titles.push_back(item.key());
        cells.push_back(cellText(item.value(), decimals));
    }
    if (_lines.empty()) add(std::move(titles));
    add(std::move(cells));
}

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

std::vector<PathGroup> pathGroupsOf(const std::vector<std::string>& poses) {
    std::vector<PathGroup> groups;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        std::string name = poses[i].substr(0, poses[i].find('_'));
        // recorded flights number their poses
        const std::size_t word = name.find_last_not_of("0123456789");
        if (name == poses[i] && word != std::string::npos) name.resize(word + 1);
        auto group = std::find_if(groups.begin(), groups.end(), [&](const PathGroup& g) { return g.name == name; });
        if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
        group->poses.push_back(i);
    }
    return groups;
}

Json sumOf(const MethodFigures& method, const PathGroup& group) {
    Json sum = method.rows[group.poses.front()];
    for (std::size_t i = 1; i < group.poses.size(); ++i) {
        for (const auto& [column, value] : method.rows[group.poses[i]].items()) {
            Json& total = sum[column];
            if (value.is_number_float())
                total = total.get<double>() + value.get<double>();
            else
                total = total.get<std::uint64_t>() + value.get<std::uint64_t>();
        }
    }
    return sum;
}

PathGroup allOf(const MethodFigures& method) {
    PathGroup all{{}, std::vector<std::size_t>(method.rows.size())};
    std::iota(all.poses.begin(), all.poses.end(), std::size_t{0});
    return all;
}

}  // namespace osgAnalyticBin::report
