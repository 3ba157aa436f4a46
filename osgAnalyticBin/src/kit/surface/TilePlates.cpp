// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TilePlates.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "../PerThread.h"
#include "Skirts.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainLimits.h"
#include "TerrainTileSurface.h"

#include <osgAnalyticBin/TileFrame.h>

#include <glm/geometric.hpp>
#include <osg/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace osgAnalyticBin {

namespace {

// What a mesh is read for.
enum class Reading {
    Triangles,       // all of them, skirts included
    WithoutSkirts,   // with skirts folded up
    WithAnyDiagonal  // the graphics driver chooses the diagonals of quads
};

bool isReadable(const osg::Drawable& drawable, Reading reading) {
    const osg::Geometry* const geometry = drawable.asGeometry();
    if (!geometry) return false;
    const osg::Geometry::PrimitiveSetList& sets = geometry->getPrimitiveSetList();
    return std::none_of(sets.begin(), sets.end(), [reading](const osg::ref_ptr<osg::PrimitiveSet>& set) {
        const bool isOfQuads = set->getMode() == GL_QUADS || set->getMode() == GL_QUAD_STRIP;
        return set->getMode() == GL_POLYGON || (isOfQuads && reading != Reading::WithAnyDiagonal);
    });
}

// Whether a triangle still has an area after skirts were folded up: then it does not belong to a skirt.
bool hasFoldedSurface(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& marks) {
    for (std::size_t i = 0; i + 2 < mesh.triangles.size() && !marks.empty(); i += 3) {
        const auto [a, b, c] =
            std::array<std::uint32_t, 3>{mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]};
        const bool isFolded = ((marks[a] | marks[b] | marks[c]) & kSkirtVertex) != 0;
        const glm::dvec3 p = mesh.vertex(a), q = mesh.vertex(b), r = mesh.vertex(c);
        if (isFolded && p != q && q != r && r != p) return true;
    }
    return false;
}

// Half a unit in the last place, in three directions.
constexpr double kFloatRounding = 1.1e-7;

// Puts the meshes of all parts of a tile together. An osgTerrain tile has to be the only part.
class MeshUnion final : public SurfaceWalk {
public:
    MeshUnion(const TileMeshes& meshes, osg::Node& node, const core::Ellipsoid& globe, Reading reading,
              core::EcefMesh& mesh)
        : SurfaceWalk(meshes.localToEcef), _meshes(meshes), _globe(globe), _reading(reading), _mesh(mesh) {
        node.accept(*this);
        if (_posts && !_mesh.triangles.empty()) giveUp();
    }

    [[nodiscard]] bool isMesh() const { return isKnown() && !_mesh.triangles.empty(); }
    // By how much float vertices are rounded.
    [[nodiscard]] double rounding() const { return kFloatRounding * _farthest; }
    // How far from its place the mesh may be drawn.
    [[nodiscard]] double drawingError(const core::Ellipsoid& globe) const {
        const double error = drawingErrorOf(_farthest);
        return globe.isPlane() ? error : std::max(error, osgAnalyticBin::drawingError(globe));
    }
    // Metres that skirts hang down, which are not in the mesh.
    [[nodiscard]] double skirt() const { return _skirt; }
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
        if (!isReadable(drawable, _reading) || !readMesh(drawable, localToEcef(), part)) return giveUp();
        if (part.triangles.empty()) return;
        if (_reading == Reading::WithoutSkirts) {
            const MeshSkirts skirts = foldSkirts(part, _globe);
            if (hasFoldedSurface(part, skirts.marks)) return giveUp();
            _skirt = std::max(_skirt, skirts.depth);
        }
        dropUnusedVertices(part);
        _farthest = std::max(_farthest, farthestVertex(part, localToEcef()));
        const auto first = static_cast<std::uint32_t>(_mesh.size());
        _mesh.x.insert(_mesh.x.end(), part.x.begin(), part.x.end());
        _mesh.y.insert(_mesh.y.end(), part.y.begin(), part.y.end());
        _mesh.z.insert(_mesh.z.end(), part.z.begin(), part.z.end());
        for (const std::uint32_t vertex : part.triangles) _mesh.triangles.push_back(first + vertex);
    }

    const TileMeshes& _meshes;
    const core::Ellipsoid& _globe;
    const Reading _reading;
    core::EcefMesh& _mesh;
    std::optional<TerrainPosts> _posts;
    double _farthest = 0.0;  // of a vertex from the origin of its frame
    double _skirt = 0.0;
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

core::MeshCover coverOf(const TileMeshes& meshes, osg::Node& node) {
    if (auto* const terrain = dynamic_cast<osgTerrain::TerrainTile*>(&node)) {
        const bool isInFrame = meshes.localToEcef.isIdentity();
        const auto extents = isInFrame ? terrainExtents(*terrain, meshes.ellipsoid) : std::nullopt;
        return extents ? core::MeshCover{*extents, meshes.shape.isKnown()} : core::MeshCover();
    }
    const core::Ellipsoid globe = toCore(meshes.ellipsoid);
    core::EcefMesh mesh;
    const MeshUnion parts(meshes, node, globe, Reading::WithAnyDiagonal, mesh);
    return parts.isMesh() ? core::MeshCover::of(globe, mesh, parts.rounding()) : core::MeshCover();
}

}  // namespace

std::unique_ptr<const core::GroundPlates> tilePlates(const TileMeshes& meshes) {
    if (meshes.nodes.size() != 1 || !hasGround(meshes)) return nullptr;
    const core::Ellipsoid globe = toCore(meshes.ellipsoid);
    core::EcefMesh mesh;
    const MeshUnion parts(meshes, *meshes.nodes.front(), globe, Reading::WithoutSkirts, mesh);
    const double error = parts.drawingError(globe);
    std::unique_ptr<const core::GroundPlates> plates;
    if (const TerrainPosts* const posts = parts.posts()) {
        plates = std::make_unique<const core::GroundPlates>(globe, posts->grid, posts->altitudes, posts->margin + error,
                                                            posts->skirt);
    } else if (parts.isMesh()) {
        const core::MeshBounds bounds(globe, mesh);
        if (bounds.bin().empty() || bounds.touchesAxis()) return nullptr;
        plates = std::make_unique<const core::GroundPlates>(globe, mesh, bounds.bin(), error, parts.skirt());
    }
    return plates && plates->isKnown() ? std::move(plates) : nullptr;
}

core::MeshCover coverOf(const TileMeshes& meshes) {
    core::MeshCover cover;
    if (!hasGround(meshes)) return cover;
    for (const osg::ref_ptr<osg::Node>& node : meshes.nodes) {
        const core::MeshCover own = coverOf(meshes, *node);
        const bool isFilled =
            own.isFilled && (cover.place.empty() || (cover.isFilled && isSamePlace(cover.place, own.place)));
        cover = {own.place, isFilled};
        if (!isFilled) break;
    }
    return cover;
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
    const MeshUnion parts(meshes, *meshes.nodes.front(), globe, Reading::Triangles, mesh);
    if (const TerrainPosts* const posts = parts.posts()) appendTriangles(*posts, globe, mesh);
    return parts.posts() || parts.isMesh();
}

}  // namespace osgAnalyticBin
