// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MapGround.h"

#include "../../core/PerThread.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainLimits.h"
#include "TerrainTileSurface.h"

#include <glm/geometric.hpp>
#include <osgTerrain/TerrainTile>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

// Of a mesh's area: what may face the other way than the rest, and what at least is seen from above. A tile of a globe
// that is as low as terrain lies at the equator, on edge.
constexpr double kLargestOverhang = 0.01;
constexpr double kSmallestView = 0.1;

// Looks whether the meshes of a tile lie flat, at heights that terrain has.
class FlatMeshes final : public SurfaceWalk {
public:
    explicit FlatMeshes(const osg::Matrixd& localToMap) : SurfaceWalk(localToMap) {}

    [[nodiscard]] bool areFlat() const {
        const double seen = _faceUp + _faceDown;
        return isKnown() && seen > 0.0 && std::min(_faceUp, _faceDown) <= kLargestOverhang * seen &&
               seen >= kSmallestView * _area;
    }

private:
    // it says by itself where it stands
    void visit(osgTerrain::TerrainTile&) override { giveUp(); }

    // it is no ground
    void visitUnknown(osg::Node&) override {}

    void visit(osg::Drawable& drawable) override {
        thread_local PerThread<SurfaceMesh> kept;  // keeps its memory from tile to tile
        SurfaceMesh& mesh = *kept;
        if (!readMesh(drawable, localToEcef(), mesh)) return giveUp();
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            add(mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]), mesh.vertex(mesh.triangles[i + 2]));
        }
    }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        static const double highest = highestTerrain(core::Ellipsoid::plane());
        // written so that NaN is no terrain
        for (const glm::dvec3& vertex : {a, b, c}) {
            if (!(std::abs(vertex.z) <= highest && std::isfinite(vertex.x + vertex.y))) return giveUp();
        }
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        (normal.z > 0.0 ? _faceUp : _faceDown) += std::abs(normal.z);
        _area += glm::length(normal);
    }

    double _faceUp = 0.0;
    double _faceDown = 0.0;
    double _area = 0.0;
};

bool liesFlat(osg::Node& mesh, const osg::Matrixd& localToMap) {
    FlatMeshes meshes(localToMap);
    mesh.accept(meshes);
    return meshes.areFlat();
}

// Whether osgTerrain::GeometryTechnique would draw the tile in the plane of a map.
bool isInMap(osgTerrain::TerrainTile& tile) {
    const osgTerrain::Locator* const locator = masterLocator(tile);
    return locator && locator->getCoordinateSystemType() != osgTerrain::Locator::GEOCENTRIC;
}

template <class Is>
bool areAll(const FoundTile& tile, const Is& is) {
    return std::all_of(tile.meshes.begin(), tile.meshes.end(), [&](const osg::ref_ptr<osg::Node>& mesh) {
        return is(*mesh, dynamic_cast<osgTerrain::TerrainTile*>(mesh.get()));
    });
}

}  // namespace

osg::ref_ptr<const osg::EllipsoidModel> groundOf(const FoundTile& tile) {
    const TileFrame& frame = tile.frame;
    const auto saysMap = [&](osg::Node&, osgTerrain::TerrainTile* terrain) {
        return terrain ? isInMap(*terrain) : frame.isProjected;
    };
    if (!areAll(tile, saysMap)) return frame.ellipsoid;
    const bool isTerrain = areAll(tile, [](osg::Node&, const auto* terrain) { return terrain != nullptr; });
    if (isTerrain) return mapPlane();
    const bool isFlat = areAll(
        tile, [&](osg::Node& mesh, const auto* terrain) { return terrain || liesFlat(mesh, frame.localToEcef); });
    if (frame.ellipsoid) return isFlat ? nullptr : frame.ellipsoid;
    return isFlat ? mapPlane() : nullptr;
}

}  // namespace osgAnalyticBin
