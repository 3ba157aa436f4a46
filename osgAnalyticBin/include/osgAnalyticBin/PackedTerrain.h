// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/TerrainGrid.h>

#include <string>

namespace osgAnalyticBin {

/// Stands in a scene that is about to be written for the mesh of a tile, and is stored as the tile's grid.
/// Reading a file gives osg::Geometry with the mesh in it, which is written as such again: nothing of this class is
/// left in a scene that was loaded. Only what osg::Node and osg::Drawable hold, the state set among it, is stored
/// besides the grid.
class PackedTerrain final : public osg::Geometry {
public:
    /// Of no grid: it cannot be read again.
    PackedTerrain() = default;
    /// Packs the grid at once.
    explicit PackedTerrain(const TerrainGrid& grid) : _bytes(packed(grid)) {
        setUseDisplayList(false);
        setUseVertexBufferObjects(true);
    }
    /// As osg::Geometry, with the bytes.
    PackedTerrain(const PackedTerrain& other, const osg::CopyOp& copy)
        : osg::Geometry(other, copy), _bytes(other._bytes) {}

    /// @{
    /// As every osg::Object.
    osg::Object* cloneType() const override { return new PackedTerrain; }
    osg::Object* clone(const osg::CopyOp& copy) const override { return new PackedTerrain(*this, copy); }
    const char* libraryName() const override { return "osgAnalyticBin"; }
    const char* className() const override { return "PackedTerrain"; }
    /// @}

    /// The bytes of the grid.
    [[nodiscard]] const std::string& bytes() const noexcept { return _bytes; }

protected:
    ~PackedTerrain() override = default;

private:
    std::string _bytes;
};

}  // namespace osgAnalyticBin
