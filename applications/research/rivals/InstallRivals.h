// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

#include <string>

namespace osgAnalyticBin::rivals {

/// Rules for culling that others use or have published, to be compared with bins.
enum class Rule {
    Paper,       ///< the published nine-point rule: unsound
    Corners,     ///< the eight corners of the bin: unsound
    Box,         ///< the bin's box along the axes of ECEF: sound
    OrientedBox  ///< the bin's box along east, north and up, and a horizon point: sound
};

/// How a rule culls.
struct RivalOptions {
    Rule rule = Rule::Paper;
    bool usesHorizon = false;  ///< of the lowest surface shown, as the kit finds it
    bool testsEdges = false;   ///< also against edges of the frustum; boxes: by their faces
    std::string binOptions;    ///< those for the kit, which finds the tiles and their bins
};

/// Culls the tiles of a database by a rule in place of the bins that the kit has installed on it, those that are paged
/// in later from the update traversal on in which they arrive. The root's callbacks see to that; nothing takes the rule
/// off again. `root`: the node that installBins() was called for.
/// Returns: how many tiles have the rule now.
std::size_t installRivals(osg::Node& root, const RivalOptions& options);

}  // namespace osgAnalyticBin::rivals
