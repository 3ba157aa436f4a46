// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osg/NodeVisitor>

namespace osgAnalyticBin {

/// Requests the files that a tile needs next, without drawing anything: those that osg::PagedLODs at the node and in
/// plain groups below it would request in a cull traversal. Priorities are lower by one, so that what is seen comes
/// first. PagedLODs that choose by pixels, and those below transforms, are passed over. Does nothing where the cull
/// visitor has no request handler. `cullVisitor`: it is at the node, or at its parent.
void requestAhead(osg::Node& node, osg::NodeVisitor& cullVisitor);

}  // namespace osgAnalyticBin
