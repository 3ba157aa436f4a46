// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The children of PagedLODs: those that come from files, and those that are its own.

#pragma once

#include <osg/PagedLOD>

namespace osgAnalyticBin {

/// Whether a child of a PagedLOD comes from a file, loaded or not.
[[nodiscard]] inline bool isPaged(const osg::PagedLOD& node, unsigned int child) {
    return child < node.getNumFileNames() && !node.getFileName(child).empty();
}

}  // namespace osgAnalyticBin
