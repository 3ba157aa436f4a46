// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SurfaceBin.h"

#include "GlmBridge.h"

#include <osgAnalyticBin/core/mesh/GeodeticMeshBounds.h>

#include <osg/Geometry>
#include <osg/TriangleFunctor>
#include <osg/TriangleIndexFunctor>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace osgAnalyticBin::bench {

namespace {

// Vertices of one texture coordinate that are closer together than this, in metres, are both of the surface.
constexpr double kThinnestSkirt = 0.5;

struct Mesh {
    std::vector<glm::dvec3> vertices;  // ECEF
    std::vector<std::array<unsigned int, 3>> triangles;
};

struct IndexSink {
    std::vector<std::array<unsigned int, 3>>* triangles = nullptr;
    void operator()(unsigned int a, unsigned int b, unsigned int c) const { triangles->push_back({a, b, c}); }
};

struct VertexSink {
    Mesh* mesh = nullptr;
    const osg::Matrixd* toEcef = nullptr;
    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) const {
        const auto first = static_cast<unsigned int>(mesh->vertices.size());
        for (const osg::Vec3& v : {a, b, c}) mesh->vertices.push_back(toGlm(osg::Vec3d(v) * *toEcef));
        mesh->triangles.push_back({first, first + 1, first + 2});
    }
};

// The vertices that hang below another one of the same texture coordinate.
std::vector<bool> skirtVertices(const Mesh& mesh, const osg::Vec2Array& texCoords) {
    std::map<std::pair<float, float>, double> highest;
    const auto distance = [&](std::size_t i) { return glm::length(mesh.vertices[i]); };
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const auto [place, isNew] = highest.try_emplace({texCoords[i].x(), texCoords[i].y()}, distance(i));
        if (!isNew) place->second = std::max(place->second, distance(i));
    }
    std::vector<bool> skirt(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        skirt[i] = distance(i) < highest.at({texCoords[i].x(), texCoords[i].y()}) - kThinnestSkirt;
    return skirt;
}

void removeSkirt(Mesh& mesh, const osg::Geometry& geometry) {
    const auto* const texCoords = dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(0));
    if (!texCoords || texCoords->size() != mesh.vertices.size()) return;
    const std::vector<bool> skirt = skirtVertices(mesh, *texCoords);
    std::vector<std::array<unsigned int, 3>> surface;
    for (const auto& t : mesh.triangles)
        if (!skirt[t[0]] && !skirt[t[1]] && !skirt[t[2]]) surface.push_back(t);
    // A tile of which nothing else is left is not what the rule was made for.
    if (!surface.empty()) mesh.triangles = std::move(surface);
}

Mesh meshOf(const flight::DrawnMesh& drawn, const osg::Matrixd& toEcef) {
    Mesh mesh;
    const osg::Geometry* const geometry = drawn.drawable->asGeometry();
    const auto* const vertices = geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
    if (!vertices) {
        osg::TriangleFunctor<VertexSink> functor;
        functor.mesh = &mesh;
        functor.toEcef = &toEcef;
        drawn.drawable->accept(functor);
        return mesh;
    }
    for (const osg::Vec3& v : *vertices) mesh.vertices.push_back(toGlm(osg::Vec3d(v) * toEcef));
    osg::TriangleIndexFunctor<IndexSink> functor;
    functor.triangles = &mesh.triangles;
    drawn.drawable->accept(functor);
    removeSkirt(mesh, *geometry);
    return mesh;
}

}  // namespace

core::GeodeticBin surfaceBin(const flight::DrawnTile& tile, const core::Ellipsoid& ellipsoid,
                             const osg::Matrixd& worldToEcef) {
    std::vector<Mesh> meshes;
    glm::dvec3 middle(0.0);
    for (const flight::DrawnMesh& drawn : tile.meshes) {
        meshes.push_back(meshOf(drawn, drawn.localToWorld * worldToEcef));
        for (const auto& t : meshes.back().triangles) middle += meshes.back().vertices[t[0]];
    }
    core::GeodeticMeshBounds bounds(ellipsoid, std::atan2(middle.y, middle.x), kSurfaceMargin);
    for (const Mesh& mesh : meshes) {
        std::vector<bool> used(mesh.vertices.size());
        for (const auto& t : mesh.triangles)
            for (const unsigned int i : t) used[i] = true;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i]) bounds.expandByVertex(mesh.vertices[i]);
    }
    for (const Mesh& mesh : meshes)
        for (const auto& t : mesh.triangles)
            bounds.expandByTriangle(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
    return bounds.bin();
}

}  // namespace osgAnalyticBin::bench
