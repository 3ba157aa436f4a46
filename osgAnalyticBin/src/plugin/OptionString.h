// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace osgAnalyticBin::plugin {

/// What an option string of OSG, which all plugins read, says about culling.
struct OptionString {
    /// The items that are ours, as cullOptionsFromText() takes them.
    std::string items;
    /// Words that no plugin knows but that resemble one of our keys, as they were typed: "metod=exact", or "method"
    /// alone; each with the key that was probably meant.
    std::vector<std::pair<std::string, std::string>> nearMisses;
    /// Items KEY=VALUE with a key that is neither ours nor any loaded plugin's, in a string that has items of ours.
    std::vector<std::string> unknown;
};

/// Splits the string into items at blanks, commas and semicolons.
[[nodiscard]] OptionString parsedOptionString(const std::string& text);

}  // namespace osgAnalyticBin::plugin
