// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "FrameCapture.h"
#include "TileCensus.h"

#include <osg/Camera>
#include <osg/Program>
#include <osgViewer/Viewer>

#include <cstdint>
#include <map>
#include <string>

namespace osgAnalyticBin::bench {

/// Finds out which tiles can be seen: draws every mesh in a flat colour of its tile's own, without light, texture or
/// culling, and counts the pixels of each colour. Skirts are drawn and count like any other part of a mesh; what is
/// smaller than a pixel may be missed.
class TilePainter {
public:
    /// Throws: Failure when there is nothing to draw on.
    TilePainter(int width, int height);
    ~TilePainter();

    TilePainter(const TilePainter&) = delete;
    TilePainter& operator=(const TilePainter&) = delete;

    /// Returns: the pixels of every tile that has one, by key. The meshes are only borrowed; nobody else may draw them
    /// meanwhile. Throws: Failure when the picture does not come.
    [[nodiscard]] std::map<std::string, std::uint64_t> visiblePixels(const std::vector<DrawnTile>& tiles,
                                                                     const osg::Camera& view);

private:
    [[nodiscard]] osg::ref_ptr<osg::Group> paintedScene(const std::vector<DrawnTile>& tiles) const;

    osgViewer::Viewer _viewer;
    osg::ref_ptr<flight::FrameCapture> _capture;
    osg::ref_ptr<osg::Program> _flat;
};

}  // namespace osgAnalyticBin::bench
