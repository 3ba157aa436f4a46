// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileLayout.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/Group>

#include <cstdint>
#include <string>
#include <vector>

namespace osgbindem {

/// Puts the geometry at its place on the globe.
[[nodiscard]] osg::ref_ptr<osg::Node> makePlaced(osg::Geometry& geometry, const glm::dvec3& originEcef);

/// What the node of a tile needs to know.
struct TileFacts {
    osgAnalyticBin::AnalyticBin bin;
    /// Metres: the mesh draws nothing lower, skirts left out.
    double surfaceLow;
    const TileLayout& layout;
    double lodFactor;
    /// Of the children, seen from the file that has the tile; empty for a tile without children.
    std::string childrenFile;
};

/// A PagedLOD, or a Group for a tile without children, that carries the bin.
[[nodiscard]] osg::ref_ptr<osg::Node> makeTileNode(const TileId& tile, osg::Node& placed, const TileFacts& facts);

/// Triangles and texture coordinates are the same for all tiles; the tiles of one file share them.
class SharedParts final {
public:
    /// Texture coordinates need the size of the texture, 0 without one.
    SharedParts(const std::vector<std::uint16_t>& triangles, int cells, int textureSize);

    /// Empty, for packed tiles: they are filled when they are read.
    explicit SharedParts(bool hasTexture);

    /// Completes the geometry.
    void addTo(osg::Geometry& geometry) const;

private:
    osg::ref_ptr<osg::DrawElementsUShort> _triangles;
    osg::ref_ptr<osg::Vec2Array> _texCoords;
};

}  // namespace osgbindem
