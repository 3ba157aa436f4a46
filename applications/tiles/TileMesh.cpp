// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileMesh.h"

#include "ImageBlocks.h"
#include "PackedTerrain.h"
#include "Relief.h"

#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <glm/vec3.hpp>
#include <osg/Texture2D>

#include <algorithm>
#include <cstdint>

namespace osgAnalyticBin::tiles {

namespace {

void drape(osg::Geometry& geometry, osg::Image& image) {
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(&image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
    geometry.getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
}

}  // namespace

void colour(TerrainGrid& grid, int textureSize) {
    grid.textureSize = textureSize;
    if (textureSize > 0) return;
    grid.colours = hypsometricStops();
    grid.relief = true;
}

osg::ref_ptr<const osg::Vec4ubArray> reliefColours(TerrainGrid grid) {
    colour(grid, 0);
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    fillGeometry(grid, *geometry);
    return dynamic_cast<const osg::Vec4ubArray*>(geometry->getColorArray());
}

osg::ref_ptr<osg::Geometry> makeGeometry(const TerrainGrid& grid, osg::Image* image, bool isPacked) {
    const osg::ref_ptr<osg::Geometry> geometry = isPacked ? new PackedTerrain(grid) : new osg::Geometry;
    if (!isPacked) fillGeometry(grid, *geometry);
    if (image != nullptr) drape(*geometry, isPacked ? *inBlocks(*image) : *image);
    return geometry;
}

SharedParts::SharedParts(int cells, bool arePacked)
    : _triangles(new osg::DrawElementsUShort(GL_TRIANGLES)), _cells(cells) {
    if (!arePacked) _triangles->asVector() = trianglesOf(cells);
}

void SharedParts::addTo(osg::Geometry& geometry, int textureSize) {
    geometry.addPrimitiveSet(_triangles);
    if (textureSize == 0) return;
    osg::ref_ptr<osg::Vec2Array>& coordinates = _texCoords[textureSize];
    if (!coordinates) {
        coordinates = new osg::Vec2Array(osg::Array::BIND_PER_VERTEX);
        if (!_triangles->empty()) addTextureCoordinates(_cells, textureSize, *coordinates);
    }
    geometry.setTexCoordArray(0, coordinates);
}

MeshExtent extentOf(const TerrainGrid& grid, const std::vector<std::uint16_t>& triangles) {
    core::EcefMesh mesh;
    for (const glm::dvec3& vertex : verticesOf(grid)) {
        const glm::dvec3 drawn = grid.origin + glm::dvec3(glm::vec3(vertex - grid.origin));
        mesh.x.push_back(drawn.x);
        mesh.y.push_back(drawn.y);
        mesh.z.push_back(drawn.z);
    }
    mesh.triangles.assign(triangles.begin(), triangles.end());
    const core::MeshBounds bounds(grid.ellipsoid, mesh);
    const auto firstPost = bounds.altitudes().begin();  // vertices of skirts come after the posts
    const double lowestPost = *std::min_element(firstPost, firstPost + (grid.cells + 1) * (grid.cells + 1));
    return {AnalyticBin(bounds.bin(), bounds.axisError()), lowestPost - bounds.sag() - bounds.altitudeError()};
}

}  // namespace osgAnalyticBin::tiles
