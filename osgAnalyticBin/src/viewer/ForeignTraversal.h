// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osgUtil/CullVisitor>

#include <functional>

namespace osgAnalyticBin {

/// Runs a part of a cull traversal with another view, and moves the drawables that it collects into the visitor's own
/// view.
void traverseBy(const CullingView& view, osgUtil::CullVisitor& visitor, const std::function<void()>& traverse);

}  // namespace osgAnalyticBin
