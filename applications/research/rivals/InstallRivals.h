// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RivalOptions.h"

#include <osg/Node>

namespace osgAnalyticBin::rivals {

/// Culls the tiles of a database by a rule in place of the bins that the kit has installed on it, those that are paged
/// in later from the update traversal on in which they arrive. The root's callbacks see to that; nothing takes the rule
/// off again. `root`: the node that installBins() was called for.
/// Returns: how many tiles have the rule now.
std::size_t installRivals(osg::Node& root, const RivalOptions& options);

}  // namespace osgAnalyticBin::rivals
