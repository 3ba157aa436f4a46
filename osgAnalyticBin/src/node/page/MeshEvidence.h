// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Node>

namespace osgAnalyticBin {

/// Call when a family was placed on a group or made anew: meshes of its tiles that have changed since bins were
/// installed are trusted again, by new evidence. osgUtil::Optimizer may have changed their form: the new form is as
/// good. Requires: no cull traversal runs.
void trustMeshes(osg::Node& group);

}  // namespace osgAnalyticBin
