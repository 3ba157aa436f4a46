// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PlanarMap.h"

#include <osg/PagedLOD>
#include <osgDB/WriteFile>
#include <osgTerrain/Layer>
#include <osgTerrain/Locator>
#include <osgTerrain/TerrainTile>

#include <cmath>
#include <stdexcept>
#include <support/GridMesh.h>

namespace osgAnalyticBin::test {

namespace {

constexpr int kLevels = 4;
constexpr unsigned int kPosts = 9;
// of the finest level
constexpr double kPostsAcross = (kPosts - 1) * (1 << (kLevels - 1));
constexpr double kSkirtRatio = 0.02;

struct Square {
    double x, y, width;

    [[nodiscard]] double postX(unsigned int i) const { return x + width * i / (kPosts - 1); }
    [[nodiscard]] double postY(unsigned int j) const { return y + width * j / (kPosts - 1); }
    [[nodiscard]] double skirt() const { return kSkirtRatio * width * std::sqrt(0.5); }
};

Square squareOf(const PlanarMap& map, int level, int x, int y) {
    const double width = map.size / (1 << level);
    return {map.origin.x() + width * x, map.origin.y() + width * y, width};
}

osg::ref_ptr<osg::Node> terrainTile(const PlanarMap& map, const Square& square) {
    const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
    locator->setEllipsoidModel(new osg::EllipsoidModel);  // as the builder does
    locator->setCoordinateSystemType(osgTerrain::Locator::PROJECTED);
    locator->setTransformAsExtents(square.x, square.y, square.x + square.width, square.y + square.width);
    const osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    field->allocate(kPosts, kPosts);
    field->setSkirtHeight(static_cast<float>(square.skirt()));
    for (unsigned int j = 0; j < kPosts; ++j)
        for (unsigned int i = 0; i < kPosts; ++i)
            field->setHeight(i, j, static_cast<float>(map.height(square.postX(i), square.postY(j), square.width)));
    const osg::ref_ptr<osgTerrain::HeightFieldLayer> layer = new osgTerrain::HeightFieldLayer(field);
    layer->setLocator(locator);
    const osg::ref_ptr<osgTerrain::TerrainTile> tile = new osgTerrain::TerrainTile;
    tile->setLocator(locator);
    tile->setElevationLayer(layer);
    return tile;
}

osg::ref_ptr<osg::Node> polygonalTile(const PlanarMap& map, const Square& square) {
    const osg::Vec3d middle(square.x + 0.5 * square.width, square.y + 0.5 * square.width, 0.0);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (unsigned int j = 0; j < kPosts; ++j) {
        for (unsigned int i = 0; i < kPosts; ++i) {
            const double x = square.postX(i);
            const double y = square.postY(j);
            vertices->push_back(osg::Vec3d(x, y, map.height(x, y, square.width)) - middle);
        }
    }
    const osg::ref_ptr<osg::DrawElementsUInt> skirt = new osg::DrawElementsUInt(GL_QUAD_STRIP);
    std::vector<unsigned int> border = gridBorder(kPosts);
    border.push_back(border.front());
    for (const unsigned int at : border) {
        skirt->push_back(at);
        skirt->push_back(static_cast<unsigned int>(vertices->size()));
        vertices->push_back((*vertices)[at] - osg::Vec3(0.0f, 0.0f, static_cast<float>(square.skirt())));
    }
    const osg::ref_ptr<osg::Geometry> geometry = makeGeometry(vertices, gridTriangles(kPosts));
    geometry->addPrimitiveSet(skirt);
    const osg::ref_ptr<osg::MatrixTransform> transform = placed(geometry, osg::Matrixd::translate(middle));
    transform->setDataVariance(osg::Object::STATIC);
    return transform;
}

}  // namespace

double PlanarMap::height(double x, double y, double width) const {
    const double u = (x - origin.x()) / size;
    const double v = (y - origin.y()) / size;
    // peaks and pits that no coarser tile has a post on
    const long number = std::lround((u + 3.0 * v) * kPostsAcross);
    const bool isFinest = width < 1.5 * size / (1 << (kLevels - 1));
    const double metres = isFinest && number % 2 != 0 ? (number % 4 == 1 ? 2600.0 : 0.0)
                                                      : 1300.0 + 300.0 * std::sin(9.0 * u) * std::cos(7.0 * v);
    return metres / heightUnit;
}

osg::ref_ptr<osg::Node> PlanarMap::mesh(int level, int x, int y) const {
    const Square square = squareOf(*this, level, x, y);
    return isTerrain ? terrainTile(*this, square) : polygonalTile(*this, square);
}

osg::ref_ptr<osg::Node> PlanarMap::tile(const std::string& folder, int level, int x, int y) const {
    const osg::ref_ptr<osg::Node> own = mesh(level, x, y);
    if (level == kLevels - 1) return own;
    const osg::ref_ptr<osg::Group> parts = new osg::Group;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) parts->addChild(tile(folder, level + 1, 2 * x + i, 2 * y + j));
    const std::string name =
        "L" + std::to_string(level) + "_X" + std::to_string(x) + "_Y" + std::to_string(y) + ".osgb";
    if (!osgDB::writeNodeFile(*parts, folder + "/" + name)) throw std::runtime_error("cannot write " + name);

    const Square square = squareOf(*this, level, x, y);
    const auto cutOff = static_cast<float>(2.0 * square.width);
    const osg::ref_ptr<osg::PagedLOD> paged = new osg::PagedLOD;
    // the tightest sphere about all heights
    const double middle = 1300.0 / heightUnit;
    paged->setCenter(osg::Vec3d(square.x + 0.5 * square.width, square.y + 0.5 * square.width, middle));
    paged->setRadius(static_cast<float>(std::hypot(std::sqrt(0.5) * square.width, middle)));
    paged->addChild(own, cutOff, 1e10f);
    paged->setFileName(1, name);
    paged->setRange(1, 0.0f, cutOff);
    paged->setDatabasePath(folder + "/");
    return paged;
}

osg::ref_ptr<osg::CoordinateSystemNode> PlanarMap::build(const std::string& folder) const {
    osg::ref_ptr<osg::CoordinateSystemNode> root = isTerrain ? new osgTerrain::Terrain : new osg::CoordinateSystemNode;
    root->setFormat("WKT");
    root->setCoordinateSystem(kUtm);
    root->addChild(tile(folder, 0, 0, 0));
    return root;
}

CullOptions optionsOf(const std::string& text) {
    std::string error;
    const auto options = cullOptionsFromText(text, error);
    if (!options) throw std::invalid_argument(error);
    return *options;
}

}  // namespace osgAnalyticBin::test
