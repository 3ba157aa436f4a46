// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

#include <glm/geometric.hpp>
#include <osg/Geometry>
#include <osg/Transform>
#include <osg/TriangleFunctor>
#include <osgTerrain/Layer>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>

#include <cmath>
#include <functional>
#include <vector>

namespace osgAnalyticBin::test {

using EcefTriangle = std::array<glm::dvec3, 3>;

/// What a subgraph draws, in ECEF.
struct DrawnTriangles {
    std::vector<EcefTriangle> surface;
    std::vector<EcefTriangle> skirts;  // of quad strips, as osgTerrain makes them
};

struct TriangleSink {
    std::vector<EcefTriangle>* triangles = nullptr;
    const osg::Matrixd* toEcef = nullptr;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) const {
        const auto moved = [this](const osg::Vec3& v) {
            const osg::Vec3d w = osg::Vec3d(v) * *toEcef;
            return glm::dvec3(w.x(), w.y(), w.z());
        };
        triangles->push_back({moved(a), moved(b), moved(c)});
    }
};

class TriangleCollector : public osg::NodeVisitor {
public:
    explicit TriangleCollector(const osg::Matrixd& frame) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _frame(frame) {}

    void apply(osg::Transform& node) override {
        const osg::Matrixd outer = _frame;
        node.computeLocalToWorldMatrix(_frame, this);
        traverse(node);
        _frame = outer;
    }

    void apply(osg::Geometry& geometry) override {
        for (unsigned int i = 0; i < geometry.getNumPrimitiveSets(); ++i) {
            const osg::PrimitiveSet& primitives = *geometry.getPrimitiveSet(i);
            const bool isStrip = primitives.getMode() == GL_QUAD_STRIP;
            osg::TriangleFunctor<TriangleSink> functor;
            functor.triangles = isStrip ? &drawn.skirts : &drawn.surface;
            functor.toEcef = &_frame;
            const auto* vertices = static_cast<const osg::Vec3Array*>(geometry.getVertexArray());
            functor.setVertexArray(vertices->getNumElements(), vertices->asVector().data());
            primitives.accept(functor);
        }
    }

    DrawnTriangles drawn;

private:
    osg::Matrixd _frame;
};

[[nodiscard]] inline DrawnTriangles drawnTriangles(osg::Node& node, const osg::Matrixd& localToEcef = osg::Matrixd()) {
    TriangleCollector collector(localToEcef);
    node.accept(collector);
    return collector.drawn;
}

/// The triangles that osgTerrain::GeometryTechnique makes of a copy of the tile.
[[nodiscard]] inline DrawnTriangles drawnTriangles(const osgTerrain::TerrainTile& tile, float verticalScale,
                                                   float sampleRatio = 1.0f) {
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    terrain->setVerticalScale(verticalScale);
    terrain->setSampleRatio(sampleRatio);
    terrain->addChild(static_cast<osg::Node*>(tile.clone(osg::CopyOp::SHALLOW_COPY)));
    return drawnTriangles(*terrain);
}

/// A terrain tile with heights by column and row. `locator`: of the heights.
[[nodiscard]] inline osg::ref_ptr<osgTerrain::TerrainTile> makeTerrainTile(
    osgTerrain::Locator& locator, unsigned int columns, unsigned int rows,
    const std::function<float(unsigned int, unsigned int)>& height) {
    const osg::ref_ptr<osg::HeightField> field = new osg::HeightField;
    field->allocate(columns, rows);
    for (unsigned int row = 0; row < rows; ++row)
        for (unsigned int column = 0; column < columns; ++column) field->setHeight(column, row, height(column, row));
    const osg::ref_ptr<osgTerrain::HeightFieldLayer> layer = new osgTerrain::HeightFieldLayer(field);
    layer->setLocator(&locator);
    osg::ref_ptr<osgTerrain::TerrainTile> tile = new osgTerrain::TerrainTile;
    tile->setElevationLayer(layer);
    return tile;
}

/// The same on a globe, with these extents.
[[nodiscard]] inline osg::ref_ptr<osgTerrain::TerrainTile> makeTerrainTile(
    const core::GeodeticBin& extents, unsigned int columns, unsigned int rows,
    const std::function<float(unsigned int, unsigned int)>& height) {
    const osg::ref_ptr<osgTerrain::Locator> locator = new osgTerrain::Locator;
    locator->setCoordinateSystemType(osgTerrain::Locator::GEOCENTRIC);
    locator->setTransformAsExtents(extents.longitude().lower, extents.latitude().lower, extents.longitude().upper,
                                   extents.latitude().upper);
    return makeTerrainTile(*locator, columns, rows, height);
}

/// Of a tile of makeTerrainTile().
[[nodiscard]] inline osg::HeightField& heightsOf(osgTerrain::TerrainTile& tile) {
    return *static_cast<osgTerrain::HeightFieldLayer*>(tile.getElevationLayer())->getHeightField();
}

/// Points all over the triangles, corners and edges included.
[[nodiscard]] inline std::vector<glm::dvec3> samplesOf(const std::vector<EcefTriangle>& triangles, int steps = 6) {
    std::vector<glm::dvec3> samples;
    for (const EcefTriangle& t : triangles) {
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const double u = static_cast<double>(i) / steps;
                const double v = static_cast<double>(j) / steps;
                samples.push_back((1.0 - u - v) * t[0] + u * t[1] + v * t[2]);
            }
        }
    }
    return samples;
}

/// Where a graphics driver draws a vertex, in the vertex's frame: it rounds the matrix and all sums to float.
[[nodiscard]] inline osg::Vec3d drawnByFloats(const osg::Vec3& vertex, const osg::Matrixd& modelView) {
    const osg::Matrixf rounded(modelView);
    osg::Vec3d drawn;
    for (int axis = 0; axis < 3; ++axis) {
        const float sum = vertex.x() * rounded(0, axis) + vertex.y() * rounded(1, axis);
        drawn[axis] = static_cast<double>(sum + vertex.z() * rounded(2, axis) + rounded(3, axis));
    }
    return drawn * osg::Matrixd::inverse(modelView);
}

// Metres that a value leaves an interval.
inline double excess(double value, const core::Interval& interval) {
    return std::max({0.0, interval.lower - value, value - interval.upper});
}

/// Metres by which a point is outside of a bin, its margin left out; 0 inside.
[[nodiscard]] inline double metresOutside(const AnalyticBin& bin, const glm::dvec3& ecef,
                                          const core::Ellipsoid& ellipsoid) {
    const core::Geodetic position = ellipsoid.toGeodetic(ecef);
    const double north = excess(position.latitude, bin.bin().latitude()) * ellipsoid.equatorialRadius();
    const double up = excess(position.altitude, bin.bin().altitude());
    double east = 0.0;
    if (!bin.bin().isFullCircle()) {
        const core::Interval& longitude = bin.bin().longitude();
        const double offset = std::remainder(position.longitude - longitude.middle(), 2.0 * 3.14159265358979323846);
        const double half = 0.5 * longitude.width();
        const double beyond = std::max(0.0, std::abs(offset) - half);
        const double fromAxis = std::hypot(ecef.x, ecef.y);
        east = beyond < 1.5 ? fromAxis * std::sin(beyond) : fromAxis;
    }
    return std::max({north, up, east});
}

/// The largest of all.
[[nodiscard]] inline double metresOutside(const AnalyticBin& bin, const std::vector<glm::dvec3>& points,
                                          const core::Ellipsoid& ellipsoid) {
    double most = 0.0;
    for (const glm::dvec3& point : points) most = std::max(most, metresOutside(bin, point, ellipsoid));
    return most;
}

}  // namespace osgAnalyticBin::test
