// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"

#include <osg/Image>

#include <string>

namespace osgAnalyticBin {

/// Replaces the mesh of a tile in a scene that is about to be written, and is stored as the tile's grid. Reading the
/// file gives an osg::Geometry with the mesh; no object of this class is in a loaded scene. Besides the grid, only the
/// properties of osg::Node and osg::Drawable are stored, such as the state set. For binary files only.
class PackedTerrain final : public osg::Geometry {
public:
    /// Without a grid. What it writes cannot be read back.
    PackedTerrain() = default;
    /// Packs the grid immediately.
    explicit PackedTerrain(const TerrainGrid& grid) : _bytes(packed(grid)) {
        setUseDisplayList(false);
        setUseVertexBufferObjects(true);
    }
    /// Copies as osg::Geometry does, and the packed bytes too.
    PackedTerrain(const PackedTerrain& other, const osg::CopyOp& copy)
        : osg::Geometry(other, copy), _bytes(other._bytes) {}

    META_Object(osgAnalyticBin, PackedTerrain)

        /// The bytes of the grid.
        [[nodiscard]] const std::string& bytes() const noexcept {
        return _bytes;
    }

protected:
    ~PackedTerrain() override = default;

private:
    std::string _bytes;
};

/// The image in blocks of 4 x 4 texels with two colours and two between them each (S3TC, DXT1): a sixth of the bytes,
/// drawn as it is stored. The same bytes on every machine.
/// Requires: three bytes a texel, rows without padding, sides that are multiples of 4.
[[nodiscard]] osg::ref_ptr<osg::Image> inBlocks(const osg::Image& image);

}  // namespace osgAnalyticBin
