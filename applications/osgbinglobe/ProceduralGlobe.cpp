// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ProceduralGlobe.h"

#include "Angles.h"
#include "TerrainGrid.h"

#include <osgAnalyticBin/InstallBinsCallback.h>
#include <osgAnalyticBin/core/mesh/GeodeticGridBounds.h>

#include <glm/geometric.hpp>
#include <osg/CoordinateSystemNode>
#include <osg/Material>

#include <Relief.h>
#include <TileNode.h>
#include <algorithm>
#include <cmath>

namespace osgAnalyticBin::globe {

using osgbindem::PostId;
using osgbindem::TileId;

namespace {

using support::kPi;
using support::kRadiansPerDegree;

// Of the relief, how much is coloured as the bottom of a sea.
constexpr double kSea = 0.45;

core::Ellipsoid wgs84() {
    const osg::ref_ptr<osg::EllipsoidModel> model = new osg::EllipsoidModel;
    return {model->getRadiusEquator(), model->getRadiusPolar()};
}

glm::dvec3 rounded(const glm::dvec3& point, double quantum) {
    return {std::nearbyint(point.x / quantum) * quantum, std::nearbyint(point.y / quantum) * quantum,
            std::nearbyint(point.z / quantum) * quantum};
}

osg::Vec3 toOsg(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

osg::ref_ptr<osg::CoordinateSystemNode> emptyRoot() {
    osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    root->setFormat("WKT");
    root->setCoordinateSystem(
        "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
        "UNIT[\"degree\",0.0174532925199433]]");
    // The only StateSet of the globe: lit, with the vertices' own colours.
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    root->getOrCreateStateSet()->setAttributeAndModes(material);
    return root;
}

}  // namespace

/// The posts of a tile, and one ring around them, which the normals need.
class ProceduralGlobe::Posts {
public:
    Posts(const ProceduralGlobe& globe, const TileId& tile)
        : _layout(globe._layout), _tile(tile), _cells(globe._layout.cells()) {
        for (int row = -1; row <= _cells + 1; ++row)
            for (int column = -1; column <= _cells + 1; ++column) add(globe, column, row);
    }

    [[nodiscard]] const TileId& tile() const { return _tile; }
    [[nodiscard]] double height(int column, int row) const { return _heights[index(column, row)]; }
    [[nodiscard]] const glm::dvec3& ecef(int column, int row) const { return _ecef[index(column, row)]; }
    [[nodiscard]] const core::Interval& range() const { return _range; }

    [[nodiscard]] core::Geodetic geodetic(int column, int row, double altitude) const {
        return _layout.geodetic(postOf(column, row), altitude);
    }

    [[nodiscard]] glm::vec3 normal(int column, int row) const {
        const bool isSouthPole = _tile.y == 0 && row == 0;
        const bool isNorthPole = _tile.y == _tile.rows() - 1 && row == _cells;
        if (isSouthPole || isNorthPole) return {0.0F, 0.0F, isSouthPole ? -1.0F : 1.0F};
        return glm::vec3(glm::normalize(
            glm::cross(ecef(column + 1, row) - ecef(column - 1, row), ecef(column, row + 1) - ecef(column, row - 1))));
    }

private:
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>((row + 1) * (_cells + 3) + column + 1);
    }
    [[nodiscard]] PostId postOf(int column, int row) const {
        PostId post = _layout.firstPost(_tile, _tile.level);
        post.column += column;
        post.row += row;
        return post;
    }
    void add(const ProceduralGlobe& globe, int column, int row) {
        const double height = globe._terrain.height(_layout.position(postOf(column, row)));
        _heights.push_back(height);
        _ecef.push_back(_layout.ellipsoid().toEcef(geodetic(column, row, height)));
        if (column < 0 || row < 0 || column > _cells || row > _cells) return;
        _range.lower = std::min(_range.lower, height);
        _range.upper = std::max(_range.upper, height);
    }

    const osgbindem::TileLayout& _layout;
    TileId _tile;
    int _cells;
    std::vector<double> _heights;
    std::vector<glm::dvec3> _ecef;
    core::Interval _range{1e9, -1e9};
};

ProceduralGlobe::ProceduralGlobe(const GlobeOptions& options)
    : _options(options),
      _layout(options.cells, options.levels, wgs84()),
      _terrain(options.relief),
      _triangles(osgAnalyticBin::trianglesOf(options.cells)) {}

// How far the edge of a mesh may be above or below the terrain: heights between posts, and the sag of the chords.
double ProceduralGlobe::edgeError(int level) const noexcept {
    constexpr double kHigherOrders = 1.1;
    const double spacing = _layout.spacingDeg(level) * kRadiansPerDegree;
    const double radius = _layout.ellipsoid().equatorialRadius() + GlobeOptions::kMostRelief;
    return _terrain.interpolationError(spacing) + kHigherOrders * 0.125 * radius * spacing * spacing;
}

double ProceduralGlobe::skirtDepth(int level) const noexcept {
    return edgeError(level) + edgeError(std::max(0, level - 1));
}

// Radians. A chord between posts of a parallel runs poleward of it, by up to a sixteenth of the square of the spacing;
// seen from above that opens a strip, over which the skirts lean.
double ProceduralGlobe::skirtLean(int level) const noexcept {
    constexpr double kHigherOrders = 1.1;
    const double spacing = _layout.spacingDeg(std::max(0, level - 1)) * kRadiansPerDegree;
    return kHigherOrders * 0.0625 * spacing * spacing;
}

// The box of all meshes of one level in a tile's rectangle, the tile's own or those of its descendants.
core::GeodeticBin ProceduralGlobe::meshBox(const TileId& tile, int level, const core::Interval& heights) const {
    const osgbindem::RectDeg rect = tile.rect();
    const double leanDeg = skirtLean(tile.level) / kRadiansPerDegree;
    const core::GeodeticBin grown =
        core::GeodeticBin::fromDegrees({rect.south - leanDeg, rect.north + leanDeg}, {rect.west, rect.east}, heights);
    const auto posts = (static_cast<std::size_t>(_layout.cells()) << (level - tile.level)) + 1;
    const double depth = skirtDepth(level);
    const core::GeodeticGridBounds bounds(_layout.ellipsoid(), {grown.latitude(), grown.longitude(), posts, posts},
                                          GlobeOptions::kMostRelief + depth);
    return {bounds.latitude(), grown.longitude(), {heights.lower - bounds.sag() - depth, heights.upper}};
}

AnalyticBin ProceduralGlobe::binOf(const TileId& tile, const core::Interval& own) const {
    core::GeodeticBin box = meshBox(tile, tile.level, own);
    // Deeper levels sag less, and hang less.
    if (hasChildren(tile)) box.expandBy(meshBox(tile, tile.level + 1, _terrain.heightsIn(tile.rect())));
    // Of vertices that are rounded to whole quanta, and to floats where these run out.
    return AnalyticBin(box, 2.0 * _layout.quantum(tile.level));
}

AnalyticBin ProceduralGlobe::binOf(const TileId& tile) const {
    return binOf(tile, Posts(*this, tile).range());
}

osg::ref_ptr<osg::Geometry> ProceduralGlobe::mesh(const Posts& posts, const glm::dvec3& originEcef) const {
    const int cells = _layout.cells();
    const double quantum = _layout.quantum(posts.tile().level);
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    const osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    const osg::ref_ptr<osg::Vec4ubArray> colours = new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX);
    colours->setNormalize(true);
    for (osg::Array* array : {static_cast<osg::Array*>(vertices.get()), static_cast<osg::Array*>(normals.get()),
                              static_cast<osg::Array*>(colours.get())})
        array->reserveArray(static_cast<unsigned int>(osgbindem::tileVertexCount(cells)));
    const auto add = [&](const glm::dvec3& ecef, int column, int row) {
        vertices->push_back(toOsg(glm::vec3(rounded(ecef, quantum) - originEcef)));
        normals->push_back(toOsg(posts.normal(column, row)));
        colours->push_back(colourAt(hypsometricStops(), posts.height(column, row) - kSea * _options.relief));
    };
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) add(posts.ecef(column, row), column, row);

    const double depth = skirtDepth(posts.tile().level);
    const double lean = skirtLean(posts.tile().level);
    for (const osgbindem::Edge edge : osgbindem::kEdges) {
        const double outward = edge == osgbindem::Edge::North ? lean : edge == osgbindem::Edge::South ? -lean : 0.0;
        for (int along = 0; along <= cells; ++along) {
            const int top = static_cast<int>(osgbindem::edgeVertex(cells, edge, along));
            const int column = top % (cells + 1);
            const int row = top / (cells + 1);
            core::Geodetic foot = posts.geodetic(column, row, posts.height(column, row) - depth);
            foot.latitude = std::clamp(foot.latitude + outward, -0.5 * kPi, 0.5 * kPi);
            add(_layout.ellipsoid().toEcef(foot), column, row);
        }
    }
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals);
    geometry->setColorArray(colours);
    return geometry;
}

osg::ref_ptr<osg::Node> ProceduralGlobe::tileNode(const TileId& tile, osg::DrawElements& triangles) const {
    const Posts posts(*this, tile);
    const int half = _layout.cells() / 2;
    const glm::dvec3 middle = _layout.ellipsoid().toEcef(posts.geodetic(half, half, posts.range().middle()));
    const glm::dvec3 originEcef = rounded(middle, _layout.quantum(tile.level));
    const osg::ref_ptr<osg::Geometry> geometry = mesh(posts, originEcef);
    geometry->addPrimitiveSet(&triangles);
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    const osg::ref_ptr<osg::Node> placed = osgbindem::makePlaced(*geometry, originEcef);
    const double surfaceLow = meshBox(tile, tile.level, posts.range()).altitude().lower + skirtDepth(tile.level);
    const osgbindem::TileFacts facts{binOf(tile, posts.range()), surfaceLow, _layout, _options.lod,
                                     hasChildren(tile) ? childrenFileOf(tile, _options) : ""};
    osg::ref_ptr<osg::Node> node = osgbindem::makeTileNode(tile, *placed, facts);
    if (!_options.bins) node->setUserDataContainer(nullptr);
    return node;
}

// One for the tiles of a file, which one thread makes.
osg::ref_ptr<osg::DrawElements> ProceduralGlobe::triangles() const {
    return new osg::DrawElementsUShort(GL_TRIANGLES, _triangles.begin(), _triangles.end());
}

osg::ref_ptr<osg::Node> ProceduralGlobe::children(const TileId& tile) const {
    const osg::ref_ptr<osg::DrawElements> shared = triangles();
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    for (const TileId& child : tile.children()) group->addChild(tileNode(child, *shared));
    return group;
}

osg::ref_ptr<osg::Node> ProceduralGlobe::root() const {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = emptyRoot();
    const osg::ref_ptr<osg::DrawElements> shared = triangles();
    double lowest = 0.0;
    for (int y = 0; y < TileId::kStartRows; ++y) {
        for (int x = 0; x < TileId::kStartColumns; ++x) {
            root->addChild(tileNode({0, x, y}, *shared));
            const AnalyticBin bin = binOf({0, x, y});
            lowest = std::min(lowest, bin.bin().altitude().lower - bin.margin());
        }
    }
    if (!_options.bins) return root;
    CullOptions options;
    options.horizonUse = HorizonUse::Given;
    options.horizon = std::floor(lowest);
    root->setUpdateCallback(new InstallBinsCallback(options));
    return root;
}

}  // namespace osgAnalyticBin::globe
