// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/Node>
#include <osg/NodeVisitor>

namespace osgAnalyticBin {

/// Requests the files that a tile needs next, without drawing anything: those that osg::PagedLODs at the node and in
/// plain groups below it would request in a cull traversal. Priorities are lower by one, so that what is seen comes
/// first. PagedLODs that choose by pixels, and those below transforms, are passed over. Does nothing where the cull
/// visitor has no request handler. `cullVisitor`: it is at the node, or at its parent.
void requestAhead(osg::Node& node, osg::NodeVisitor& cullVisitor);

/// The same for a tile that is out of view with all its descendants that are loaded, where the others may be in view:
/// requests no files but those that OSG would request by its spheres, and none below tiles whose descendants are known.
/// PagedLODs of all kinds count. `eye`: nothing is requested behind its horizon; null: there is none.
void requestOutOfView(osg::Node& node, osg::NodeVisitor& cullVisitor, const core::HorizonEye* eye);

}  // namespace osgAnalyticBin
