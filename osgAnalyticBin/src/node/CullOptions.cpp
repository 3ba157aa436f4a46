// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Text.h"

#include <osgAnalyticBin/CullOptions.h>

#include <array>
#include <sstream>
#include <utility>

namespace osgAnalyticBin {

namespace {

constexpr std::array<std::pair<Method, const char*>, 5> kMethodNames{{{Method::Quadratic, "quadratic"},
                                                                      {Method::Paper, "paper"},
                                                                      {Method::Corners, "corners"},
                                                                      {Method::Sphere, "sphere"},
                                                                      {Method::None, "none"}}};

constexpr double kMaxGrowth = 10.0;

bool applyItem(const std::string& key, const std::string& value, CullOptions& options, std::string& error) {
    if (key == "method") {
        const std::optional<Method> method = methodFromName(value);
        if (!method) {
            error = "unknown method \"" + value + "\" (use quadratic, paper, corners, sphere or none)";
            return false;
        }
        options.method = *method;
        return true;
    }
    if (key == "growth") {
        const auto number = numbersFromText(value, 1);
        if (!number || (*number)[0] < 1.0 || (*number)[0] > kMaxGrowth) {
            error = "bad growth \"" + value + "\" (use a factor from 1 to 10, e.g. growth=1.1)";
            return false;
        }
        options.growth = (*number)[0];
        return true;
    }
    error = "unknown parameter \"" + key + "\" (use method=NAME or growth=FACTOR)";
    return false;
}

}  // namespace

const char* methodName(Method method) noexcept {
    for (const auto& [value, name] : kMethodNames) {
        if (value == method) return name;
    }
    return "quadratic";
}

std::optional<Method> methodFromName(const std::string& name) noexcept {
    for (const auto& [value, known] : kMethodNames) {
        if (name == known) return value;
    }
    return std::nullopt;
}

std::optional<CullOptions> cullOptionsFromText(const std::string& text, std::string& error) {
    std::string spaced = text;
    for (char& c : spaced) {
        if (c == ',' || c == ';') c = ' ';
    }
    CullOptions options;
    std::istringstream items(spaced);
    for (std::string item; items >> item;) {
        const std::size_t equals = item.find('=');
        const std::string value = equals == std::string::npos ? std::string() : item.substr(equals + 1);
        if (!applyItem(item.substr(0, equals), value, options, error)) return std::nullopt;
    }
    return options;
}

std::string toText(const CullOptions& options) {
    return std::string("method=") + methodName(options.method) + ",growth=" + numberToText(options.growth);
}

}  // namespace osgAnalyticBin
