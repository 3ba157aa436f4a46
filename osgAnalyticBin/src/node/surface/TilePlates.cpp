// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TilePlates.h"

#include "../../core/EarthScale.h"
#include "../GlmBridge.h"
#include "Skirts.h"
#include "SurfaceMesh.h"
#include "SurfaceWalk.h"
#include "TerrainLimits.h"

#include <osgAnalyticBin/TileFinder.h>

#include <osg/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

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

// Whether a triangle that was folded up with a skirt still has an area: then it is none of a skirt.
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

// Puts the meshes of all parts of a tile together.
class MeshUnion final : public SurfaceWalk {
public:
    MeshUnion(const osg::Matrixd& localToEcef, const core::Ellipsoid* withoutSkirts, core::EcefMesh& mesh)
        : SurfaceWalk(localToEcef), _withoutSkirts(withoutSkirts), _mesh(mesh) {}

    [[nodiscard]] bool isMesh() const { return isKnown() && !_mesh.triangles.empty(); }

private:
    void visit(osgTerrain::TerrainTile&) override { giveUp(); }

    void visit(osg::Drawable& drawable) override {
        thread_local SurfaceMesh part;  // keeps its memory from tile to tile
        if (!isOfTriangles(drawable) || !readMesh(drawable, localToEcef(), part)) return giveUp();
        if (part.triangles.empty()) return;
        if (_withoutSkirts && hasFoldedSurface(part, foldSkirts(part, *_withoutSkirts).marks)) return giveUp();
        dropUnusedVertices(part);
        const auto first = static_cast<std::uint32_t>(_mesh.size());
        _mesh.x.insert(_mesh.x.end(), part.x.begin(), part.x.end());
        _mesh.y.insert(_mesh.y.end(), part.y.begin(), part.y.end());
        _mesh.z.insert(_mesh.z.end(), part.z.begin(), part.z.end());
        for (const std::uint32_t vertex : part.triangles) _mesh.triangles.push_back(first + vertex);
    }

    const core::Ellipsoid* const _withoutSkirts;
    core::EcefMesh& _mesh;
};

}  // namespace

bool readTileMesh(osg::Node& node, const osg::Matrixd& localToEcef, core::EcefMesh& mesh) {
    MeshUnion parts(localToEcef, nullptr, mesh);
    node.accept(parts);
    return parts.isMesh();
}

namespace {

struct PlatesAndExtents {
    std::unique_ptr<const core::GroundPlates> plates;
    core::GeodeticBin extents;
};

PlatesAndExtents platesAndExtents(const std::vector<osg::ref_ptr<osg::Node>>& meshes,
                                  const osg::EllipsoidModel& ellipsoid, const osg::Matrixd& localToEcef) {
    if (meshes.size() != 1 || !hasValidRadii(ellipsoid)) return {};
    const core::Ellipsoid globe = toCore(ellipsoid);
    core::EcefMesh mesh;
    MeshUnion parts(localToEcef, &globe, mesh);
    meshes.front()->accept(parts);
    if (!parts.isMesh()) return {};
    const core::MeshBounds bounds(globe, mesh);
    if (bounds.bin().empty() || bounds.touchesAxis()) return {};
    return {std::make_unique<const core::GroundPlates>(globe, mesh, bounds.bin(), drawingError(globe)), bounds.bin()};
}

}  // namespace

std::unique_ptr<const core::GroundPlates> tilePlates(const std::vector<osg::ref_ptr<osg::Node>>& meshes,
                                                     const osg::EllipsoidModel& ellipsoid,
                                                     const osg::Matrixd& localToEcef) {
    auto [plates, extents] = platesAndExtents(meshes, ellipsoid, localToEcef);
    return plates && plates->isKnown() ? std::move(plates) : nullptr;
}

core::GeodeticBin rectangleFilledBy(const std::vector<osg::ref_ptr<osg::Node>>& meshes,
                                    const osg::EllipsoidModel& ellipsoid, const osg::Matrixd& localToEcef) {
    const auto [plates, extents] = platesAndExtents(meshes, ellipsoid, localToEcef);
    return plates && std::isfinite(plates->least(1, 0, 0)) ? extents : core::GeodeticBin();
}

}  // namespace osgAnalyticBin
