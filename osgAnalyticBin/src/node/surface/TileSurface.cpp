// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../GlmBridge.h"
#include "../PerThread.h"
#include "MeshSurface.h"
#include "SurfaceWalk.h"
#include "TerrainTileSurface.h"

#include <osgAnalyticBin/TileFrame.h>

#include <osg/Billboard>

#include <algorithm>
#include <cmath>
#include <optional>

namespace osgAnalyticBin {

namespace {

// A billboard rotates each drawable about its position, so the drawable stays in a ball. This share of the radius is
// added for the rounding of rotations in single precision.
constexpr double kRoomOfTurning = 1e-5;

// The radius of the ball about the origin that holds a drawable; nullopt if its vertices cannot be read.
std::optional<double> reachOf(const osg::Node* node, SurfaceMesh& mesh) {
    const osg::Drawable* const drawable = node ? node->asDrawable() : nullptr;
    if (!drawable || !readMesh(*drawable, osg::Matrixd(), mesh)) return std::nullopt;
    double reach = 0.0;
    for (const std::uint32_t i : mesh.triangles) reach = std::max(reach, glm::length(mesh.vertex(i)));
    return std::isfinite(reach) ? std::optional(reach * (1.0 + kRoomOfTurning)) : std::nullopt;
}

// Adds the cube that holds a ball.
void addCube(const osg::Vec3d& middle, double radius, const osg::Matrixd& localToEcef, SurfaceMesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.size());
    for (unsigned int corner = 0; corner < 8; ++corner) {
        const auto side = [&](unsigned int axis) { return ((corner >> axis) & 1u) == 0 ? -radius : radius; };
        const osg::Vec3d v = (middle + osg::Vec3d(side(0), side(1), side(2))) * localToEcef;
        mesh.x.push_back(v.x());
        mesh.y.push_back(v.y());
        mesh.z.push_back(v.z());
    }
    // two triangles a face
    constexpr unsigned int kFaces[] = {0, 2, 3, 0, 3, 1, 4, 6, 7, 4, 7, 5, 0, 1, 5, 0, 5, 4,
                                       2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 3, 7, 1, 7, 5};
    for (const unsigned int corner : kFaces) mesh.triangles.push_back(first + corner);
}

// Unites the surfaces of the parts of a tile. A part that cannot be told makes the whole so.
class SurfaceUnion final : public SurfaceWalk {
public:
    SurfaceUnion(const osg::EllipsoidModel& ellipsoid, const osg::Matrixd& localToEcef, double sampleRatio,
                 bool withAnyTechnique)
        : SurfaceWalk(localToEcef),
          _model(ellipsoid),
          _ellipsoid(toCore(ellipsoid)),
          _sampleRatio(sampleRatio),
          _withAnyTechnique(withAnyTechnique) {}

    [[nodiscard]] TileSurface result() const {
        if (!isKnown()) return {};
        TileSurface surface = _result;
        surface.isEmpty = !surface.bin.valid();
        surface.isInMap = _ellipsoid.isPlane();
        return surface;
    }

private:
    void visit(osgTerrain::TerrainTile& tile) override {
        // its vertices are ECEF in the tile's own frame
        if (!localToEcef().isIdentity() || !(_withAnyTechnique || isDrawnByOsg(tile))) return giveUp();
        unite(terrainTileSurface(tile, _model, _sampleRatio));
    }

    void visit(osg::Drawable& drawable) override {
        thread_local PerThread<SurfaceMesh> kept;  // keeps its memory from tile to tile
        SurfaceMesh& mesh = *kept;
        if (!readMesh(drawable, localToEcef(), mesh)) return giveUp();
        if (!mesh.triangles.empty()) unite(meshSurface(mesh, _ellipsoid));
    }

    void visitBillboard(osg::Billboard& node) override {
        SurfaceMesh cubes, turned;
        const osg::Billboard::PositionList& positions = node.getPositionList();
        if (positions.size() != node.getNumChildren()) return giveUp();
        for (unsigned int i = 0; i < node.getNumChildren(); ++i) {
            const std::optional<double> reach = reachOf(node.getChild(i), turned);
            if (!reach) return giveUp();
            addCube(positions[i], *reach, localToEcef(), cubes);
        }
        if (!cubes.triangles.empty()) unite(meshSurface(cubes, _ellipsoid));
    }

    void unite(const TileSurface& part) {
        if (!part.bin.valid()) return giveUp();
        if (!_result.bin.valid()) {
            _result = part;
            return;
        }
        // heights that follow the vertical scale and such that do not have no bin in common
        if (part.isScalable != _result.isScalable) return giveUp();
        _result.bin.expandBy(part.bin);
        _result.skirt = std::max(_result.skirt, part.skirt);
        for (std::size_t i = 0; i < part.edgeLow.size(); ++i)
            _result.edgeLow[i] = std::min(_result.edgeLow[i], part.edgeLow[i]);
    }

    const osg::EllipsoidModel& _model;
    core::Ellipsoid _ellipsoid;
    double _sampleRatio;
    bool _withAnyTechnique;
    TileSurface _result;
};

}  // namespace

TileSurface tileSurface(osg::Node& node, const osg::EllipsoidModel& ellipsoid, const osg::Matrixd& localToEcef,
                        double sampleRatio, bool withAnyTechnique) {
    if (!hasValidRadii(ellipsoid) && !isMapPlane(ellipsoid)) return {};
    SurfaceUnion surface(ellipsoid, localToEcef, sampleRatio, withAnyTechnique);
    node.accept(surface);
    return surface.result();
}

}  // namespace osgAnalyticBin
