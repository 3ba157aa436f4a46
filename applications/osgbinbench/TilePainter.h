// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BenchViewer.h"
#include "TileCensus.h"

#include <osg/Camera>
#include <osg/Program>

#include <cstdint>
#include <map>
#include <string>

namespace osgAnalyticBin::bench {

/// Finds out which tiles can be seen: draws every mesh in a flat colour of its tile's own, without light, texture or
/// culling, and counts the pixels of each colour. Skirts are drawn and count like any other part of a mesh; what is
/// smaller than a pixel may be missed.
class TilePainter {
public:
    explicit TilePainter(BenchViewer& viewer);

    /// Returns: the pixels of every tile that has one, by key. Throws: Failure when the picture does not come.
    [[nodiscard]] std::map<std::string, std::uint64_t> visiblePixels(const std::vector<flight::DrawnTile>& tiles,
                                                                     const osg::Camera& view);

private:
    [[nodiscard]] osg::ref_ptr<osg::Group> paintedScene(const std::vector<flight::DrawnTile>& tiles) const;

    BenchViewer& _viewer;
    osg::ref_ptr<osg::Program> _flat;
};

}  // namespace osgAnalyticBin::bench
