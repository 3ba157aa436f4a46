// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RivalOptions.h"

#include <osgAnalyticBin/CullOptions.h>

#include <array>
#include <sstream>
#include <utility>

namespace osgAnalyticBin::rivals {

namespace {

// Returns: what is wrong; empty: nothing.
std::string applyItem(const std::string& item, RivalOptions& options) {
    const std::size_t equals = item.find('=');
    const std::string key = item.substr(0, equals);
    const std::string value = equals == std::string::npos ? std::string() : item.substr(equals + 1);
    if (key == "method") {
        const std::optional<Rule> rule = ruleFromName(value);
        if (!rule) return "unknown method \"" + value + "\" (use paper, corners, box or orientedbox)";
        options.rule = *rule;
    } else if (key == "edges") {
        if (value != "on" && value != "off") return "bad edges \"" + value + "\" (use on or off)";
        options.testsEdges = value == "on";
    } else {
        if (key == "horizon") options.usesHorizon = value != "off";
        options.binOptions += item + ',';
    }
    return {};
}

}  // namespace

std::optional<Rule> ruleFromName(const std::string& name) {
    constexpr std::array<std::pair<const char*, Rule>, 4> kNames{
        {{"paper", Rule::Paper}, {"corners", Rule::Corners}, {"box", Rule::Box}, {"orientedbox", Rule::OrientedBox}}};
    for (const auto& [known, rule] : kNames)
        if (name == known) return rule;
    return std::nullopt;
}

std::optional<RivalOptions> rivalOptionsFromText(const std::string& text, std::string& error) {
    RivalOptions options;
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ',');) {
        if (!item.empty()) error = applyItem(item, options);
        if (!error.empty()) return std::nullopt;
    }
    // what the rules do not use costs time
    options.binOptions += options.usesHorizon ? "occlusion=off" : "horizon=off,occlusion=off";
    if (!cullOptionsFromText(options.binOptions, error)) return std::nullopt;
    return options;
}

}  // namespace osgAnalyticBin::rivals
