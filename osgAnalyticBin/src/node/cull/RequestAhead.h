// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>
#include <osg/NodeVisitor>

namespace osgAnalyticBin {

/// Requests the files that a tile needs next, without drawing anything: what osg::PagedLODs at the node and in plain
/// groups below it request where they are traversed. What is seen comes first: one is taken off the priorities.
/// PagedLODs that choose by pixels, and those below transforms, are passed over. Does nothing where the cull visitor
/// has no request handler. `cullVisitor`: it is at the node, or at its parent.
void requestAhead(osg::Node& node, osg::NodeVisitor& cullVisitor);

}  // namespace osgAnalyticBin
