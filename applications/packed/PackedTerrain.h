// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TerrainGrid.h"

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

}  // namespace osgAnalyticBin
