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

#include <osgAnalyticBin/TileFinder.h>

#include <glm/geometric.hpp>
#include <osg/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace osgAnalyticBin {

namespace {

// The graphics driver chooses the diagonals of polygons.
bool isOfTriangles(const osg::Drawable& drawable) {
    const osg::Geometry* const geometry = drawable.asGeometry();
    if (!geometry) return false;
    const osg::Geometry::PrimitiveSetList& sets = geometry->getPrimitiveSetList();
    return std::none_of(sets.begin(), sets.end(), [](const osg::ref_ptr<osg::PrimitiveSet>& set) {
        return set->getMode() == GL_QUADS || set->getMode() == GL_QUAD_STRIP || set->getMode() == GL_POLYGON;
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

// Puts the meshes of all parts of a tile together. An osgTerrain tile has to be the only part.
class MeshUnion final : public SurfaceWalk {
public:
    MeshUnion(const TileMeshes& meshes, const core::Ellipsoid* withoutSkirts, core::EcefMesh& mesh)
        : SurfaceWalk(meshes.localToEcef), _meshes(meshes), _withoutSkirts(withoutSkirts), _mesh(mesh) {
        meshes.nodes.front()->accept(*this);
        if (_posts && !_mesh.triangles.empty()) giveUp();
    }

    [[nodiscard]] bool isMesh() const { return isKnown() && !_mesh.triangles.empty(); }
    // How far from its place the mesh may be drawn.
    [[nodiscard]] double drawingError(const core::Ellipsoid& globe) const {
        return globe.isPlane() ? drawingErrorInMap(_farthest) : osgAnalyticBin::drawingError(globe);
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
        if (!isOfTriangles(drawable) || !readMesh(drawable, localToEcef(), part)) return giveUp();
        if (part.triangles.empty()) return;
        if (_withoutSkirts) {
            const MeshSkirts skirts = foldSkirts(part, *_withoutSkirts);
            if (hasFoldedSurface(part, skirts.marks)) return giveUp();
            _skirt = std::max(_skirt, skirts.depth);
        }
        dropUnusedVertices(part);
        const glm::dvec3 origin = toGlm(localToEcef().getTrans());
        for (std::size_t i = 0; i < part.size(); ++i)
            _farthest = std::max(_farthest, glm::distance(origin, part.vertex(i)));
        const auto first = static_cast<std::uint32_t>(_mesh.size());
        _mesh.x.insert(_mesh.x.end(), part.x.begin(), part.x.end());
        _mesh.y.insert(_mesh.y.end(), part.y.begin(), part.y.end());
        _mesh.z.insert(_mesh.z.end(), part.z.begin(), part.z.end());
        for (const std::uint32_t vertex : part.triangles) _mesh.triangles.push_back(first + vertex);
    }

    const TileMeshes& _meshes;
    const core::Ellipsoid* const _withoutSkirts;
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

struct PlatesAndExtents {
    std::unique_ptr<const core::GroundPlates> plates;
    core::GeodeticBin extents;
};

PlatesAndExtents platesAndExtents(const TileMeshes& meshes) {
    const bool hasGround = hasValidRadii(meshes.ellipsoid) || isMapPlane(meshes.ellipsoid);
    if (meshes.nodes.size() != 1 || !hasGround) return {};
    const core::Ellipsoid globe = toCore(meshes.ellipsoid);
    core::EcefMesh mesh;
    const MeshUnion parts(meshes, &globe, mesh);
    const double error = parts.drawingError(globe);
    if (const TerrainPosts* const posts = parts.posts()) {
        return {std::make_unique<const core::GroundPlates>(globe, posts->grid, posts->altitudes, posts->margin + error,
                                                           posts->skirt),
                {posts->grid.latitude, posts->grid.longitude, {0.0, 0.0}}};
    }
    if (!parts.isMesh()) return {};
    const core::MeshBounds bounds(globe, mesh);
    if (bounds.bin().empty() || bounds.touchesAxis()) return {};
    return {std::make_unique<const core::GroundPlates>(globe, mesh, bounds.bin(), error, parts.skirt()), bounds.bin()};
}

}  // namespace

std::unique_ptr<const core::GroundPlates> tilePlates(const TileMeshes& meshes) {
    auto [plates, extents] = platesAndExtents(meshes);
    return plates && plates->isKnown() ? std::move(plates) : nullptr;
}

core::GeodeticBin rectangleFilledBy(const TileMeshes& meshes) {
    const auto [plates, extents] = platesAndExtents(meshes);
    return plates && std::isfinite(plates->least(1, 0, 0)) ? extents : core::GeodeticBin();
}

bool readTileMesh(const TileMeshes& meshes, core::EcefMesh& mesh) {
    if (meshes.nodes.size() != 1) return false;
    const MeshUnion parts(meshes, nullptr, mesh);
    if (const TerrainPosts* const posts = parts.posts()) appendTriangles(*posts, toCore(meshes.ellipsoid), mesh);
    return parts.posts() || parts.isMesh();
}

}  // namespace osgAnalyticBin
