// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <optional>
#include <string>

namespace osgAnalyticBin::rivals {

/// Rules for culling that others use or have published, to be compared with bins.
enum class Rule {
    Paper,       ///< the published nine-point rule: unsound
    Corners,     ///< the eight corners of the bin: unsound
    Box,         ///< the bin's box along the axes of ECEF: sound
    OrientedBox  ///< the bin's box along east, north and up, and a horizon point: sound
};

/// Returns: the rule with the name "paper", "corners", "box" or "orientedbox"; nullopt for another name.
[[nodiscard]] std::optional<Rule> ruleFromName(const std::string& name);

/// How a rule culls.
struct RivalOptions {
    Rule rule = Rule::Paper;
    bool usesHorizon = false;  ///< of the lowest surface shown, as the kit finds it
    bool testsEdges = false;   ///< also against edges of the frustum; boxes: by their faces
    std::string binOptions;    ///< those for the kit, which finds the tiles and their bins
};

/// Reads "method=paper,horizon=declared,edges=on"; all but method= may be left out. Other items go to the
/// kit. Returns: nullopt, with one line in `error`, where an item is malformed.
[[nodiscard]] std::optional<RivalOptions> rivalOptionsFromText(const std::string& text, std::string& error);

}  // namespace osgAnalyticBin::rivals
