// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ParameterReader.h"

#include "CsvTable.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace osgAnalyticBin::flight {

bool setNumber(double& target, const std::string& value, double least, double most) {
    const auto number = numberFrom(value);
    if (!number || !(*number >= least && *number <= most)) return false;
    target = *number;
    return true;
}

bool setWhole(int& target, const std::string& value, int least, int most) {
    double number = 0.0;
    if (!setNumber(number, value, least, most) || number != std::floor(number)) return false;
    target = static_cast<int>(number);
    return true;
}

Applied ParameterReader::applyItem(const std::string& item) const {
    const std::size_t equals = item.find('=');
    const std::string value = equals == std::string::npos ? std::string() : trimmed(item.substr(equals + 1));
    return _apply(trimmed(item.substr(0, equals)), value);
}

std::string ParameterReader::complaint(const std::string& item, const char* what) const {
    return std::string(what) + " parameter \"" + item + "\"; allowed are " + _allowed;
}

bool ParameterReader::readBracketed(const std::string& parameters, std::string& error) const {
    std::istringstream items(parameters);
    for (std::string item; std::getline(items, item, ',');) {
        const Applied applied = applyItem(item);
        if (applied == Applied::Yes) continue;
        error = complaint(trimmed(item), applied == Applied::Unknown ? "unknown" : "malformed");
        return false;
    }
    return true;
}

bool ParameterReader::readOptionString(const std::string& options, std::string& error) const {
    std::string blanks = options;
    std::replace(blanks.begin(), blanks.end(), ',', ' ');
    std::istringstream items(blanks);
    for (std::string item; items >> item;) {
        if (applyItem(item) != Applied::Malformed) continue;
        error = complaint(item, "malformed");
        return false;
    }
    return true;
}

}  // namespace osgAnalyticBin::flight
