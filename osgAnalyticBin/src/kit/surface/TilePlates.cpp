// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TilePlates.h"

#include "../../core/EarthScale.h"
#include "../../core/PerThread.h"
#include "../GlmBridge.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainLimits.h"
#include "TerrainTileSurface.h"

#include <osgAnalyticBin/TileFrame.h>

#include <glm/geometric.hpp>
#include <osg/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>

namespace osgAnalyticBin {

namespace {

bool hasPrimitives(const osg::Geometry& geometry, std::initializer_list<GLenum> modes) {
    const osg::Geometry::PrimitiveSetList& sets = geometry.getPrimitiveSetList();
    return std::any_of(sets.begin(), sets.end(), [&modes](const osg::ref_ptr<osg::PrimitiveSet>& set) {
        return std::find(modes.begin(), modes.end(), set->getMode()) != modes.end();
    });
}

// Half a unit in the last place, in three directions.
constexpr double kFloatRounding = 1.1e-7;

// Puts the meshes of all parts of a tile together. An osgTerrain tile has to be the only part.
class MeshUnion final : public SurfaceWalk {
public:
    MeshUnion(const TileMeshes& meshes, osg::Node& node, core::EcefMesh& mesh)
        : SurfaceWalk(meshes.localToEcef), _meshes(meshes), _mesh(mesh) {
        node.accept(*this);
        if (_posts && !_mesh.triangles.empty()) giveUp();
    }

    [[nodiscard]] bool isMesh() const { return isKnown() && !_mesh.triangles.empty(); }
    // Whether no triangle is half of a quad, whose diagonal the graphics driver chooses.
    [[nodiscard]] bool hasGivenTriangles() const { return isMesh() && !_hasQuads; }
    // By how much float vertices are rounded.
    [[nodiscard]] double rounding() const { return kFloatRounding * _farthest; }
    // How far from its place the mesh may be drawn.
    [[nodiscard]] double drawingError(const core::Ellipsoid& globe) const {
        const double error = drawingErrorOf(_farthest);
        return globe.isPlane() ? error : std::max(error, osgAnalyticBin::drawingError(globe));
    }
    [[nodiscard]] const TerrainPosts* posts() const { return isKnown() && _posts ? &*_posts : nullptr; }

private:
    void visit(osgTerrain::TerrainTile& tile) override {
        // its vertices are ECEF in the tile's own frame
        const bool isPlaced = localToEcef().isIdentity() && !_posts;
        if (isPlaced) _posts = terrainPosts(tile, _meshes.ellipsoid, _meshes.shape);
        if (!isPlaced || !_posts) giveUp();
    }

    void visit(osg::Drawable& drawable) override {
        thread_local PerThread<SurfaceMesh> kept;  // keeps its memory from tile to tile
        SurfaceMesh& part = *kept;
        const osg::Geometry* const geometry = drawable.asGeometry();
        if (!geometry || hasPrimitives(*geometry, {GL_POLYGON}) || !readMesh(drawable, localToEcef(), part))
            return giveUp();
        if (part.triangles.empty()) return;
        _hasQuads = _hasQuads || hasPrimitives(*geometry, {GL_QUADS, GL_QUAD_STRIP});
        dropUnusedVertices(part);
        _farthest = std::max(_farthest, farthestVertex(part, localToEcef()));
        const auto first = static_cast<std::uint32_t>(_mesh.size());
        _mesh.x.insert(_mesh.x.end(), part.x.begin(), part.x.end());
        _mesh.y.insert(_mesh.y.end(), part.y.begin(), part.y.end());
        _mesh.z.insert(_mesh.z.end(), part.z.begin(), part.z.end());
        for (const std::uint32_t vertex : part.triangles) _mesh.triangles.push_back(first + vertex);
    }

    const TileMeshes& _meshes;
    core::EcefMesh& _mesh;
    bool _hasQuads = false;
    std::optional<TerrainPosts> _posts;
    double _farthest = 0.0;  // of a vertex from the origin of its frame
};

double along(const core::Interval& interval, std::size_t i, std::size_t posts) {
    return interval.lower + interval.width() * static_cast<double>(i) / static_cast<double>(posts - 1);
}

// The triangles between posts, with either diagonal.
void appendTriangles(const TerrainPosts& posts, const core::Ellipsoid& ellipsoid, core::EcefMesh& mesh) {
    const core::GeodeticGrid& grid = posts.grid;
    for (std::size_t i = 0; i < posts.altitudes.size(); ++i) {
        const glm::dvec3 v =
            ellipsoid.toEcef({along(grid.latitude, i / grid.columns, grid.rows),
                              along(grid.longitude, i % grid.columns, grid.columns), posts.altitudes[i]});
        mesh.x.push_back(v.x);
        mesh.y.push_back(v.y);
        mesh.z.push_back(v.z);
    }
    for (std::size_t row = 0; row + 1 < grid.rows; ++row) {
        for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
            const auto a = static_cast<std::uint32_t>(row * grid.columns + column), b = a + 1;
            const auto c = static_cast<std::uint32_t>(a + grid.columns), d = c + 1;
            mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c, a, b, c, b, d, c});
        }
    }
}

bool hasGround(const TileMeshes& meshes) {
    return hasValidRadii(meshes.ellipsoid) || isMapPlane(meshes.ellipsoid);
}

std::unique_ptr<const core::GroundPlates> platesOf(const MeshUnion& parts, const core::Ellipsoid& globe,
                                                   const core::EcefMesh& mesh, const core::MeshCover& cover) {
    const double error = parts.drawingError(globe);
    std::unique_ptr<const core::GroundPlates> plates;
    if (const TerrainPosts* const posts = parts.posts()) {
        plates = std::make_unique<const core::GroundPlates>(globe, posts->grid, posts->altitudes, posts->margin + error,
                                                            posts->skirt);
    } else if (parts.hasGivenTriangles() && cover.isFilled) {
        const core::MeshBounds bounds(globe, mesh);
        if (bounds.bin().empty() || bounds.touchesAxis()) return nullptr;
        plates = std::make_unique<const core::GroundPlates>(globe, mesh, cover, bounds.bin(), error);
    }
    return plates && plates->isKnown() ? std::move(plates) : nullptr;
}

TileGround groundOf(const TileMeshes& meshes, osg::Node& node, bool withPlates) {
    TileGround ground;
    auto* const terrain = dynamic_cast<osgTerrain::TerrainTile*>(&node);
    if (terrain) {
        const bool isInFrame = meshes.localToEcef.isIdentity();
        const auto extents = isInFrame ? terrainExtents(*terrain, meshes.ellipsoid) : std::nullopt;
        if (extents) ground.cover = {*extents, meshes.shape.isKnown()};
        if (!withPlates) return ground;
    }
    const core::Ellipsoid globe = toCore(meshes.ellipsoid);
    core::EcefMesh mesh;
    const MeshUnion parts(meshes, node, mesh);
    if (!terrain && parts.isMesh()) ground.cover = core::MeshCover::of(globe, mesh, parts.rounding());
    if (withPlates) ground.plates = platesOf(parts, globe, mesh, ground.cover);
    return ground;
}

}  // namespace

TileGround groundOf(const TileMeshes& meshes, bool withPlates) {
    TileGround ground;
    if (!hasGround(meshes)) return ground;
    for (const osg::ref_ptr<osg::Node>& node : meshes.nodes) {
        TileGround own = groundOf(meshes, *node, withPlates && meshes.nodes.size() == 1);
        const core::GeodeticBin above = ground.cover.place;
        const bool isFilled =
            own.cover.isFilled && (above.empty() || (ground.cover.isFilled && isSamePlace(above, own.cover.place)));
        ground = std::move(own);
        ground.cover.isFilled = isFilled;
        if (!isFilled) break;
    }
    return ground;
}

bool isSamePlace(const core::GeodeticBin& a, const core::GeodeticBin& b, double share) {
    if (a.empty() || b.empty()) return false;
    const double along = share * b.latitude().width(), across = share * b.longitude().width();
    const double turn = std::remainder(a.longitude().lower - b.longitude().lower, 2.0 * osg::PI);
    return (a.isFullCircle() || std::abs(turn) <= across) &&
           std::abs(a.longitude().width() - b.longitude().width()) <= across &&
           std::abs(a.latitude().lower - b.latitude().lower) <= along &&
           std::abs(a.latitude().upper - b.latitude().upper) <= along;
}

bool areVouchedFor(const CullOptions& options, const osg::EllipsoidModel& ellipsoid) {
    return options.horizonUse == HorizonUse::Given && !isMapPlane(ellipsoid);
}

bool readTileMesh(const TileMeshes& meshes, core::EcefMesh& mesh) {
    if (meshes.nodes.size() != 1) return false;
    const core::Ellipsoid globe = toCore(meshes.ellipsoid);
    const MeshUnion parts(meshes, *meshes.nodes.front(), mesh);
    if (const TerrainPosts* const posts = parts.posts()) appendTriangles(*posts, globe, mesh);
    return parts.posts() || parts.hasGivenTriangles();
}

}  // namespace osgAnalyticBin
