// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/Node>
#include <osg/NodeVisitor>

namespace osgAnalyticBin {

/// Requests the files that OSG would request by its spheres below a tile that is out of view with all its descendants
/// that are loaded, where the others may be in view: none below tiles whose descendants are known. Draws nothing.
/// Priorities are lower by one, so that what is seen comes first. PagedLODs of all kinds count. Does nothing where the
/// cull visitor has no request handler. `cullVisitor`: it is at the node, or at its parent.
/// `eye`: nothing is requested behind its horizon; null: there is none.
void requestOutOfView(osg::Node& node, osg::NodeVisitor& cullVisitor, const core::HorizonEye* eye);

}  // namespace osgAnalyticBin
