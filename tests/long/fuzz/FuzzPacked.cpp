// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// The bytes of a packed tile. Whatever they are: refused, or a grid that comes back whole, and a mesh that has every
// vertex its triangles name, at finite places.

#include "Fuzz.h"
#include "TerrainGrid.h"

#include <osgAnalyticBin/TileSurface.h>

#include <cmath>

using namespace osgAnalyticBin;

namespace {

osg::ref_ptr<osg::Geometry> meshOf(const TerrainGrid& grid) {
    const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    fillGeometry(grid, *geometry);
    const osg::ref_ptr<osg::DrawElementsUShort> triangles = new osg::DrawElementsUShort(GL_TRIANGLES);
    for (const std::uint16_t index : trianglesOf(grid.cells)) triangles->push_back(index);
    geometry->addPrimitiveSet(triangles);
    return geometry;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto grid = unpacked(std::string(reinterpret_cast<const char*>(data), size));
    if (!grid) return 0;
    const std::string bytes = packed(*grid);
    const auto again = unpacked(bytes);
    test::require(again && packed(*again) == bytes && again->heights == grid->heights);

    const std::vector<glm::dvec3> vertices = verticesOf(*grid);
    for (const glm::dvec3& vertex : vertices) {
        test::require(std::isfinite(vertex.x) && std::isfinite(vertex.y) && std::isfinite(vertex.z));
    }
    for (const std::uint16_t index : trianglesOf(grid->cells)) test::require(index < vertices.size());
    const osg::ref_ptr<osg::Geometry> geometry = meshOf(*grid);
    test::require(geometry->getVertexArray()->getNumElements() == vertices.size());
    const osg::EllipsoidModel ellipsoid(grid->ellipsoid.equatorialRadius(), grid->ellipsoid.polarRadius());
    (void)tileSurface(*geometry, ellipsoid, osg::Matrixd::translate(grid->origin.x, grid->origin.y, grid->origin.z));
    return 0;
}
