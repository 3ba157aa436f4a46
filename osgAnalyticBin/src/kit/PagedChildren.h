// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The children of levels of detail: which of a PagedLOD come from files, and which are shown.

#pragma once

#include <osg/LOD>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>

#include <algorithm>

namespace osgAnalyticBin {

/// Whether a child of a PagedLOD comes from a file, loaded or not.
[[nodiscard]] inline bool isPaged(const osg::PagedLOD& node, unsigned int child) {
    return child < node.getNumFileNames() && !node.getFileName(child).empty();
}

/// Whether OSG shows those levels whose ranges hold the distance from the visitor's view point.
[[nodiscard]] inline bool choosesByDistance(const osg::LOD& node, const osg::NodeVisitor& visitor) {
    return node.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT &&
           visitor.getTraversalMode() == osg::NodeVisitor::TRAVERSE_ACTIVE_CHILDREN;
}

/// Whether a level is one of these, loaded or not.
[[nodiscard]] inline bool isInRange(const osg::LOD& node, unsigned int level, float distance) {
    return distance >= node.getMinRange(level) && distance < node.getMaxRange(level);
}

/// Whether some level is due at every distance, or size on screen, that occurs.
[[nodiscard]] inline bool isAlwaysDue(const osg::LOD& node) {
    constexpr float kMost = 1e9f;
    float end = 0.0f;  // of what is known to be in a range
    for (unsigned int i = 0; i < node.getNumRanges(); ++i) {
        for (const osg::LOD::MinMaxPair& range : node.getRangeList())
            if (range.first <= end) end = std::max(end, range.second);
    }
    return end >= kMost;
}

}  // namespace osgAnalyticBin
