// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace osgAnalyticBin {

namespace {

// Reads the whole of a text without blanks.
std::optional<double> numberFromText(const char* begin, const char* end) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || next != end) return std::nullopt;
    if (!std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace

std::optional<std::vector<double>> numbersFromText(const std::string& text, std::size_t count) {
    std::vector<double> values;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        while (at != end && (*at == ' ' || *at == '\t')) ++at;
        if (at == end) break;
        const char* const next = std::find_if(at, end, [](char c) { return c == ' ' || c == '\t'; });
        const std::optional<double> value = numberFromText(at, next);
        if (!value) return std::nullopt;
        values.push_back(*value);
        if (values.size() > count) return std::nullopt;
        at = next;
    }
    if (values.size() != count) return std::nullopt;
    return values;
}

std::string numberToText(double value) {
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return error == std::errc() ? std::string(buffer, end) : std::string("nan");
}

std::string numbersToText(const std::vector<double>& values) {
    std::string text;
    for (const double value : values) {
        if (!text.empty()) text += ' ';
        text += numberToText(value);
    }
    return text;
}

}  // namespace osgAnalyticBin
