// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PlanarSurface.h"

#include "../GlmBridge.h"
#include "HeightRange.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainTileSurface.h"

#include <glm/geometric.hpp>
#include <osgTerrain/GeometryTechnique>
#include <osgTerrain/Layer>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

// Fifty kilometres in feet: what leaves these heights is no terrain.
constexpr double kLargestHeight = 1.65e5;
// Vertices are floats: a unit in the last place of the largest number, once for the tile and once for descendants.
constexpr double kFloatRounding = 2.4e-7;
// Of a mesh's area: what may face the other way than the rest, and what at least is seen from above. A tile of a globe
// that is as low as terrain lies at the equator, on edge.
constexpr double kLargestOverhang = 0.01;
constexpr double kSmallestView = 0.1;

double largestNumber(const osg::BoundingBoxd& box) {
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(box._min[i]), std::abs(box._max[i])});
    return largest;
}

bool isLikeTerrain(const osg::BoundingBoxd& box) {
    const bool isFinite = std::isfinite(largestNumber(box));
    return isFinite && box.xMin() < box.xMax() && box.yMin() < box.yMax() && box.zMin() >= -kLargestHeight &&
           box.zMax() <= kLargestHeight && box.zMin() <= box.zMax();
}

// Gathers the meshes of a tile, and whether they lie flat.
class FlatMeshes final : public SurfaceWalk {
public:
    explicit FlatMeshes(const osg::Matrixd& localToMap) : SurfaceWalk(localToMap) {}

    [[nodiscard]] PlanarSurface result() const {
        const double seen = _faceUp + _faceDown;
        const bool isFlat = std::min(_faceUp, _faceDown) <= kLargestOverhang * seen && seen >= kSmallestView * _area;
        if (!isKnown() || !isFlat || !isLikeTerrain(_surface.box)) return {};
        PlanarSurface surface = _surface;
        surface.margin = kFloatRounding * largestNumber(surface.box);
        return surface;
    }

private:
    // its heights follow a scale that those of a mesh do not
    void visit(osgTerrain::TerrainTile&) override { giveUp(); }

    void visit(osg::Drawable& drawable) override {
        thread_local SurfaceMesh mesh;  // keeps its memory from tile to tile
        if (!readMesh(drawable, localToEcef(), mesh)) return giveUp();
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            add(mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]), mesh.vertex(mesh.triangles[i + 2]));
        }
    }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        for (const glm::dvec3& vertex : {a, b, c}) {
            // a comparison with NaN would pass it over
            if (!std::isfinite(vertex.x + vertex.y + vertex.z)) return giveUp();
            _surface.box.expandBy(toOsg(vertex));
        }
        for (const glm::dvec3& side : {b - a, c - b, a - c}) {
            if (side.x == 0.0 && side.y == 0.0) _surface.skirt = std::max(_surface.skirt, std::abs(side.z));
        }
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        (normal.z > 0.0 ? _faceUp : _faceDown) += std::abs(normal.z);
        _area += glm::length(normal);
    }

    PlanarSurface _surface;
    double _faceUp = 0.0;
    double _faceDown = 0.0;
    double _area = 0.0;
};

// Extents of a locator whose matrix is nothing but extents; empty otherwise.
osg::BoundingBoxd extentsOf(const osg::Matrixd& m) {
    osg::Matrixd extents;
    extents(0, 0) = m(0, 0);
    extents(1, 1) = m(1, 1);
    extents(3, 0) = m(3, 0);
    extents(3, 1) = m(3, 1);
    osg::BoundingBoxd box;
    if (!(m == extents)) return box;
    box.expandBy(osg::Vec3d(m(3, 0), m(3, 1), 0.0));
    box.expandBy(osg::Vec3d(m(3, 0) + m(0, 0), m(3, 1) + m(1, 1), 0.0));
    return box;
}

PlanarSurface terrainSurface(osgTerrain::TerrainTile& tile, double sampleRatio) {
    const osgTerrain::Locator* locator = masterLocator(tile);
    osgTerrain::Layer* layer = tile.getElevationLayer();
    const osg::HeightField* field = heightField(tile);
    const bool isBroken = layer && !field && dynamic_cast<const osgTerrain::HeightFieldLayer*>(layer);
    if (!locator || isBroken || !(sampleRatio >= 0.0)) return {};
    if (layer && (layer->getNumColumns() < 2 || layer->getNumRows() < 2)) return {};
    const HeightRange heights =
        layer ? (field ? heightRange(*layer, *field) : heightRange(*layer)) : HeightRange::flat();
    const double skirt = field ? static_cast<double>(field->getSkirtHeight()) : 0.0;
    if (!heights.isFinite || !std::isfinite(skirt)) return {};
    PlanarSurface surface;
    surface.box = extentsOf(locator->getTransform());
    surface.box.zMin() = heights.low;
    surface.box.zMax() = heights.high;
    if (!isLikeTerrain(surface.box)) return {};
    surface.margin = kFloatRounding * largestNumber(surface.box);
    surface.skirt = std::max(0.0, skirt);
    surface.raised = std::max(0.0, -skirt);
    surface.isScalable = true;
    return surface;
}

}  // namespace

void PlanarSurface::expandBy(const PlanarSurface& other) {
    box.expandBy(other.box);
    margin = std::max(margin, other.margin);
    skirt = std::max(skirt, other.skirt);
    raised = std::max(raised, other.raised);
    isScalable = isScalable || other.isScalable;
}

bool isPlanar(osgTerrain::TerrainTile& tile) {
    const osgTerrain::Locator* locator = masterLocator(tile);
    return locator && locator->getCoordinateSystemType() != osgTerrain::Locator::GEOCENTRIC;
}

PlanarSurface planarSurface(osg::Node& node, const osg::Matrixd& localToMap, double sampleRatio) {
    if (auto* tile = dynamic_cast<osgTerrain::TerrainTile*>(&node)) {
        // its vertices are map coordinates in the tile's own frame
        return localToMap.isIdentity() ? terrainSurface(*tile, sampleRatio) : PlanarSurface{};
    }
    FlatMeshes meshes(localToMap);
    node.accept(meshes);
    return meshes.result();
}

}  // namespace osgAnalyticBin
