// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../GlmBridge.h"
#include "../PerThread.h"
#include "MeshSurface.h"
#include "SurfaceWalk.h"
#include "TerrainTileSurface.h"

#include <osgAnalyticBin/TileFinder.h>

#include <algorithm>

namespace osgAnalyticBin {

namespace {

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
