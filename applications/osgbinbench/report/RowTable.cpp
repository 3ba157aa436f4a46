// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RowTable.h"

#include "CsvTable.h"
#include "TextFile.h"

#include <algorithm>

namespace osgAnalyticBin::report {

namespace {

std::vector<std::string> columnsOf(const std::vector<Json>& rows) {
    std::vector<std::string> columns;
    for (const Json& row : rows) {
        for (const auto& item : row.items())
            if (std::find(columns.begin(), columns.end(), item.key()) == columns.end()) columns.push_back(item.key());
    }
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

}  // namespace osgAnalyticBin::report
