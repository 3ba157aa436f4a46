// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileNode.h"

#include <osgAnalyticBin/InstallBinsCallback.h>

#include <glm/geometric.hpp>
#include <osg/LightModel>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PagedLOD>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::tiles {

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

osgAnalyticBin::TerrainGrid gridWithoutHeights(const TileLayout& layout, const TileId& tile) {
    osgAnalyticBin::TerrainGrid grid;
    grid.ellipsoid = layout.ellipsoid();
    grid.cells = layout.cells();
    grid.columns = static_cast<std::int64_t>(TileId::kStartColumns * grid.cells) << tile.level;
    const PostId first = layout.firstPost(tile, tile.level);
    grid.firstColumn = first.column;
    grid.firstRow = first.row;
    grid.quantum = layout.quantum(tile.level);
    return grid;
}

osgAnalyticBin::core::Interval heightsOf(const osgAnalyticBin::TerrainGrid& grid) {
    auto heights = osgAnalyticBin::core::Interval::none();
    for (int row = 0; row <= grid.cells; ++row)
        for (int column = 0; column <= grid.cells; ++column) heights.expandBy(grid.height(column, row));
    return heights;
}

void placeOrigin(osgAnalyticBin::TerrainGrid& grid, const TileLayout& layout, int level) {
    const int half = grid.cells / 2;
    const PostId middle{level, grid.firstColumn + half, grid.firstRow + half};
    const glm::dvec3 point = grid.ellipsoid.toEcef(layout.geodetic(middle, heightsOf(grid).middle()));
    for (int axis = 0; axis < 3; ++axis) grid.origin[axis] = std::nearbyint(point[axis] / grid.quantum) * grid.quantum;
}

osg::ref_ptr<osg::CoordinateSystemNode> makeRoot(const osgAnalyticBin::core::Ellipsoid& ellipsoid,
                                                 const std::string& wkt) {
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
        const osgAnalyticBin::AnalyticBin bin = osgAnalyticBin::storedBin(*root.getChild(i));
        lowest = std::min(lowest, bin.bin().altitude().lower - bin.margin());
    }
    osgAnalyticBin::CullOptions options;
    options.horizonUse = osgAnalyticBin::HorizonUse::Given;
    options.horizon = std::floor(lowest);
    root.setUpdateCallback(new osgAnalyticBin::InstallBinsCallback(options));
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
    osgAnalyticBin::setStoredBin(*node, facts.bin);
    osgAnalyticBin::setStoredSurfaceLow(*node, facts.surfaceLow);
    return node;
}

}  // namespace osgAnalyticBin::tiles
