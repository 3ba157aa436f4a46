// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ParameterReader.h"

#include "CsvTable.h"
#include "Failure.h"

#include <cmath>
#include <sstream>

namespace osgAnalyticBin::flight {

namespace {

void read(const std::vector<Parameter>& known, const std::string& item) {
    const std::size_t equals = item.find('=');
    const std::string key = trimmed(item.substr(0, equals));
    const std::string value = equals == std::string::npos ? std::string() : trimmed(item.substr(equals + 1));
    std::string allowed, problem = "unknown";
    for (const Parameter& parameter : known) {
        const std::string text = parameter.text;
        allowed += (allowed.empty() ? "" : ", ") + text;
        if (text.substr(0, text.find('=')) != key) continue;
        if (parameter.take(value)) return;
        problem = "malformed";
    }
    throw support::Failure(problem + " parameter \"" + trimmed(item) + "\"; allowed are " + allowed);
}

}  // namespace

std::function<bool(const std::string&)> numberInto(double& target, double least, double most) {
    return [&target, least, most](const std::string& value) {
        const auto number = numberFrom(value);
        if (!number || !(*number >= least && *number <= most)) return false;
        target = *number;
        return true;
    };
}

std::function<bool(const std::string&)> wholeInto(int& target, int least, int most) {
    return [&target, least, most](const std::string& value) {
        double number = 0.0;
        if (!numberInto(number, least, most)(value) || number != std::floor(number)) return false;
        target = static_cast<int>(number);
        return true;
    };
}

void readBracketed(const std::vector<Parameter>& known, const std::string& text) {
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ',');) read(known, item);
}

}  // namespace osgAnalyticBin::flight
