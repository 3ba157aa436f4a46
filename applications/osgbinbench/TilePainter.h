// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BenchViewer.h"
#include "TileCensus.h"

#include <osg/Camera>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace osgAnalyticBin::bench {

/// Finds out which tiles can be seen: draws every mesh in a flat colour of its tile's own, without light, texture or
/// culling, and counts the pixels of each colour. Skirts are drawn and count like any other part of a mesh; what is
/// smaller than a pixel may be missed.
/// Returns: the pixels of every tile that has one, by key. Throws: Failure when the picture does not come.
[[nodiscard]] std::map<std::string, std::uint64_t> visiblePixels(BenchViewer& viewer,
                                                                 const std::vector<flight::DrawnTile>& tiles,
                                                                 const osg::Camera& view);

}  // namespace osgAnalyticBin::bench
