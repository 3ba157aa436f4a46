// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../PagedChildren.h"

#include <osg/PagedLOD>

#include <cmath>

namespace osgAnalyticBin {

/// Has the node's paged children expire `seconds` after they were last in view, where nobody has set a time: OSG's own
/// is 0.
inline void raiseExpiry(osg::PagedLOD& node, double seconds) {
    for (unsigned int i = 0; seconds > 0.0 && i < node.getNumMinimumExpiryTimes(); ++i) {
        // a number that nobody else sets
        if (isPaged(node, i) && node.getMinimumExpiryTime(i) == 0.0)
            node.setMinimumExpiryTime(i, std::nextafter(seconds, HUGE_VAL));
    }
}

/// Undoes raiseExpiry() with the same number; other times stay.
inline void restoreExpiry(osg::PagedLOD& node, double seconds) {
    for (unsigned int i = 0; i < node.getNumMinimumExpiryTimes(); ++i) {
        if (node.getMinimumExpiryTime(i) == std::nextafter(seconds, HUGE_VAL)) node.setMinimumExpiryTime(i, 0.0);
    }
}

}  // namespace osgAnalyticBin
