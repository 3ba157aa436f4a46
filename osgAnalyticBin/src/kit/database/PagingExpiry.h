// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

namespace osg {
class PagedLOD;
}

namespace osgAnalyticBin {

/// Raises the minimum expiry time of the node's paged children to `seconds`; longer ones stay. What it overrides is
/// remembered with the node.
void raiseExpiry(osg::PagedLOD& node, double seconds);

/// Undoes raiseExpiry() with the same number; times that were changed since then stay.
void restoreExpiry(osg::PagedLOD& node, double seconds);

}  // namespace osgAnalyticBin
