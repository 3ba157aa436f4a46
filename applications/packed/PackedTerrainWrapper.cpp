// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PackedTerrain.h"

#include <osgDB/InputStream>
#include <osgDB/ObjectWrapper>
#include <osgDB/OutputStream>

namespace {

using osgAnalyticBin::PackedTerrain;
using osgAnalyticBin::TerrainGrid;

constexpr unsigned int kMostBytes = 4U << 20;

std::string readBytes(osgDB::InputStream& is) {
    unsigned int size = 0;
    is >> size;
    if (!is.isBinary() || size > kMostBytes) return {};
    std::string bytes(size, '\0');
    is.readCharArray(bytes.data(), size);
    return bytes;
}

// What tiles of a file share is stored empty, once, and filled by the first of them.
void readShared(osgDB::InputStream& is, const TerrainGrid& grid, osg::Geometry& geometry) {
    const osg::ref_ptr<osg::DrawElementsUShort> triangles = is.readObjectOfType<osg::DrawElementsUShort>();
    if (!triangles) return is.throwException("osgAnalyticBin::PackedTerrain: no triangles");
    if (triangles->empty()) {
        const std::vector<std::uint16_t> indices = osgAnalyticBin::trianglesOf(grid.cells);
        triangles->assign(indices.begin(), indices.end());
    }
    // of other tiles of the file, with more vertices
    const std::size_t count = geometry.getVertexArray()->getNumElements();
    for (const GLushort index : *triangles)
        if (index >= count) return is.throwException("osgAnalyticBin::PackedTerrain: vertices are missing");
    geometry.addPrimitiveSet(triangles);
    if (grid.textureSize == 0) return;
    const osg::ref_ptr<osg::Vec2Array> coordinates = is.readObjectOfType<osg::Vec2Array>();
    if (!coordinates) return is.throwException("osgAnalyticBin::PackedTerrain: no texture coordinates");
    if (coordinates->empty()) osgAnalyticBin::addTextureCoordinates(grid.cells, grid.textureSize, *coordinates);
    if (coordinates->size() == count) geometry.setTexCoordArray(0, coordinates, osg::Array::BIND_PER_VERTEX);
}

}  // namespace

static bool checkGrid(const osg::Geometry& geometry) {
    return dynamic_cast<const PackedTerrain*>(&geometry) != nullptr;
}

static bool readGrid(osgDB::InputStream& is, osg::Geometry& geometry) {
    const auto grid = osgAnalyticBin::unpacked(readBytes(is));
    if (!grid) {
        is.throwException("osgAnalyticBin::PackedTerrain: broken grid");
        return false;
    }
    osgAnalyticBin::fillGeometry(*grid, geometry);
    readShared(is, *grid, geometry);
    return is.getException() == nullptr;
}

static bool writeGrid(osgDB::OutputStream& os, const osg::Geometry& geometry) {
    if (!os.isBinary()) {
        os.throwException("osgAnalyticBin::PackedTerrain: is stored in binary files only");
        return false;
    }
    const std::string& bytes = dynamic_cast<const PackedTerrain&>(geometry).bytes();
    os << static_cast<unsigned int>(bytes.size());
    os.writeCharArray(bytes.data(), static_cast<unsigned int>(bytes.size()));
    os.writeObject(geometry.getPrimitiveSet(0));
    if (geometry.getTexCoordArray(0) != nullptr) os.writeObject(geometry.getTexCoordArray(0));
    return true;
}

REGISTER_OBJECT_WRAPPER2(osgAnalyticBin_PackedTerrain, new osg::Geometry, osg::Geometry,
                         "osgAnalyticBin::PackedTerrain",
                         "osg::Object osg::Node osg::Drawable osgAnalyticBin::PackedTerrain") {
    ADD_USER_SERIALIZER(Grid);
}
