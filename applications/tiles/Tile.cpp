// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Tile.h"

#include "PackedTerrain.h"

#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/core/mesh/MeshBounds.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>

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

namespace {

/// Half the diagonal of the tile at sea level, in metres.
double halfDiagonal(const TileId& tile, const TileLayout& layout) {
    const auto point = [&](int column, int row) {
        PostId post = layout.firstPost(tile, tile.level);
        post.column += column;
        post.row += row;
        return layout.ellipsoid().toEcef(layout.geodetic(post, 0.0));
    };
    const int end = layout.cells();
    const glm::dvec3 middle = point(end / 2, end / 2);
    return std::max(glm::distance(middle, point(0, 0)), glm::distance(middle, point(0, end)));
}

}  // namespace

TerrainGrid gridWithoutHeights(const TileLayout& layout, const TileId& tile) {
    TerrainGrid grid;
    grid.ellipsoid = layout.ellipsoid();
    grid.cells = layout.cells();
    grid.columns = static_cast<std::int64_t>(TileId::kStartColumns * grid.cells) << tile.level;
    const PostId first = layout.firstPost(tile, tile.level);
    grid.firstColumn = first.column;
    grid.firstRow = first.row;
    grid.quantum = layout.quantum(tile.level);
    return grid;
}

core::Interval heightsOf(const TerrainGrid& grid) {
    auto heights = core::Interval::none();
    for (int row = 0; row <= grid.cells; ++row)
        for (int column = 0; column <= grid.cells; ++column) heights.expandBy(grid.height(column, row));
    return heights;
}

void placeOrigin(TerrainGrid& grid, const TileLayout& layout, int level) {
    const int half = grid.cells / 2;
    const PostId middle{level, grid.firstColumn + half, grid.firstRow + half};
    const glm::dvec3 point = grid.ellipsoid.toEcef(layout.geodetic(middle, heightsOf(grid).middle()));
    for (int axis = 0; axis < 3; ++axis) grid.origin[axis] = std::nearbyint(point[axis] / grid.quantum) * grid.quantum;
}

osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const core::Ellipsoid& ellipsoid, const std::string& wkt) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode(wkt.empty() ? "" : "WKT", wkt);
    root->setEllipsoidModel(new osg::EllipsoidModel(ellipsoid.equatorialRadius(), ellipsoid.polarRadius()));
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    root->getOrCreateStateSet()->setAttributeAndModes(material);
    // With OSG's light, which stands with the eye: bright enough at grazing angles, and no land too bright from above.
    constexpr float kAmbient = 0.5F;
    const osg::ref_ptr<osg::LightModel> light = new osg::LightModel;
    light->setAmbientIntensity(osg::Vec4(kAmbient, kAmbient, kAmbient, 1.0F));
    root->getOrCreateStateSet()->setAttribute(light);
    return root;
}

void declareHorizon(osg::Group& root) {
    double lowest = 0.0;
    for (unsigned int i = 0; i < root.getNumChildren(); ++i) {
        const AnalyticBin bin = storedBin(*root.getChild(i));
        lowest = std::min(lowest, bin.bin().altitude().lower - bin.margin());
    }
    CullOptions options;
    options.horizonUse = HorizonUse::Given;
    options.horizon = std::floor(lowest);
    root.setUpdateCallback(new InstallBinsCallback(options));
}

osg::ref_ptr<osg::Node> makePlaced(osg::Geometry& geometry, const glm::dvec3& originEcef) {
    const osg::ref_ptr<osg::MatrixTransform> transform =
        new osg::MatrixTransform(osg::Matrixd::translate(originEcef.x, originEcef.y, originEcef.z));
    transform->setDataVariance(osg::Object::STATIC);
    transform->addChild(&geometry);
    return transform;
}

osg::ref_ptr<osg::Node> makeTileNode(const TileId& tile, osg::Node& placed, const TileFacts& facts) {
    osg::ref_ptr<osg::Group> node;
    if (facts.childrenFile.empty()) {
        node = new osg::Group;
        node->addChild(&placed);
    } else {
        constexpr float kFarthest = 1e10F;
        const auto& ellipsoid = facts.layout.ellipsoid();
        const osg::ref_ptr<osg::EllipsoidModel> model =
            new osg::EllipsoidModel(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
        const osg::BoundingSphere sphere = facts.bin.boundingSphere(*model);
        const osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
        const float range = static_cast<float>(facts.lodFactor * halfDiagonal(tile, facts.layout));
        lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        lod->setCenter(sphere.center());
        lod->setRadius(sphere.radius());
        lod->addChild(&placed, range, kFarthest);
        lod->setFileName(1, facts.childrenFile);
        lod->setRange(1, 0.0F, range);
        node = lod;
    }
    setStoredBin(*node, facts.bin);
    setStoredSurfaceLow(*node, facts.surfaceLow);
    return node;
}

}  // namespace osgAnalyticBin::tiles
