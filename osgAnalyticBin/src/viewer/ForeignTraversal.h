// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osgUtil/CullVisitor>

#include <functional>

namespace osgAnalyticBin {

/// Runs a part of a cull traversal by another view, and places what it leaves to draw as the visitor's own view sees
/// it.
void traverseBy(const CullingView& view, osgUtil::CullVisitor& visitor, const std::function<void()>& traverse);

}  // namespace osgAnalyticBin
