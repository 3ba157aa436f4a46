// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/BinIndex.h>
#include <osgAnalyticBin/CullOptions.h>

#include <osg/Node>

#include <cstddef>

namespace osgAnalyticBin {

/// Installs bins on what is loaded below the root of a scene or of a database; see installBins(). `index`: of the
/// database; null: none. `keepsDatabases`: databases that are there keep what they know.
/// Returns: the number of callbacks installed.
std::size_t installBelow(osg::Node& root, const CullOptions& options, const BinIndex* index, bool keepsDatabases);

}  // namespace osgAnalyticBin
