// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SurfaceMesh.h"

#include "../Classes.h"
#include "../GlmBridge.h"

#include <glm/geometric.hpp>
#include <osg/ShapeDrawable>
#include <osg/TriangleFunctor>
#include <osg/TriangleIndexFunctor>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

namespace {

struct TriangleSink {
    SurfaceMesh* mesh = nullptr;
    const osg::Matrixd* toEcef = nullptr;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) const {
        for (const osg::Vec3& local : {a, b, c}) {
            const osg::Vec3d v = osg::Vec3d(local) * *toEcef;
            mesh->triangles.push_back(static_cast<std::uint32_t>(mesh->size()));
            mesh->x.push_back(v.x());
            mesh->y.push_back(v.y());
            mesh->z.push_back(v.z());
        }
    }
};

// Numbers of one vertex, and its own type, by the array's type.
template <class Vertices>
void place(const Vertices& vertices, const osg::Matrixd& m, SurfaceMesh& mesh) {
    const std::size_t count = vertices.size();
    mesh.x.resize(count);
    mesh.y.resize(count);
    mesh.z.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(vertices[i].x());
        const double y = static_cast<double>(vertices[i].y());
        const double z = static_cast<double>(vertices[i].z());
        mesh.x[i] = x * m(0, 0) + y * m(1, 0) + z * m(2, 0) + m(3, 0);
        mesh.y[i] = x * m(0, 1) + y * m(1, 1) + z * m(2, 1) + m(3, 1);
        mesh.z[i] = x * m(0, 2) + y * m(1, 2) + z * m(2, 2) + m(3, 2);
    }
}

bool readVertices(const osg::Array& array, const osg::Matrixd& localToEcef, SurfaceMesh& mesh) {
    if (const auto* floats = dynamic_cast<const osg::Vec3Array*>(&array)) {
        place(*floats, localToEcef, mesh);
        return true;
    }
    if (const auto* doubles = dynamic_cast<const osg::Vec3dArray*>(&array)) {
        place(*doubles, localToEcef, mesh);
        return true;
    }
    return false;
}

struct IndexSink {
    std::vector<std::uint32_t>* triangles = nullptr;

    void operator()(unsigned int a, unsigned int b, unsigned int c) const {
        triangles->push_back(a);
        triangles->push_back(b);
        triangles->push_back(c);
    }
};

// Lines and points, as pairs and single vertices.
void addPoints(const osg::PrimitiveSet& primitives, std::vector<std::uint32_t>& triangles) {
    const unsigned int count = primitives.getNumIndices();
    for (unsigned int i = 0; i < count; ++i) {
        const unsigned int next = i + 1 < count ? i + 1 : 0;
        triangles.insert(triangles.end(), {primitives.index(i), primitives.index(next), primitives.index(i)});
    }
}

// Whether ranges of vertices end where the vertices do. A few bytes of a file may claim billions; indices take as much
// room in a file as they do here.
bool isWithinVertices(const osg::PrimitiveSet& primitives, std::int64_t vertices) {
    std::int64_t first = 0;
    std::int64_t count = 0;
    if (const auto* arrays = dynamic_cast<const osg::DrawArrays*>(&primitives)) {
        first = arrays->getFirst();
        count = arrays->getCount();
    } else if (const auto* lengths = dynamic_cast<const osg::DrawArrayLengths*>(&primitives)) {
        first = lengths->getFirst();
        for (const GLsizei length : *lengths) {
            if (length < 0) return false;
            count += length;
        }
    }
    return count == 0 || (first >= 0 && count > 0 && first + count <= vertices);
}

// Others may draw a part of their indices, by commands, or several strips one after the other.
bool drawsAllIndices(const osg::PrimitiveSet& primitives) {
    return primitives.getType() >= osg::PrimitiveSet::DrawArraysPrimitiveType &&
           primitives.getType() <= osg::PrimitiveSet::DrawElementsUIntPrimitiveType &&
           primitives.getNumInstances() == 0;
}

// Adds the triangles on both sides of the other diagonal of each quad, from the first index on. OSG's are, by corners,
// 0 1 2, 0 2 3 for quads and 0 1 3, 1 2 3 for strips of them.
void addOtherDiagonals(bool isStrip, std::size_t first, std::vector<std::uint32_t>& triangles) {
    const std::size_t end = triangles.size();
    for (std::size_t i = first; i + 5 < end; i += 6) {
        const std::uint32_t a = triangles[i], b = triangles[i + 1], c = triangles[i + 4], d = triangles[i + 5];
        if (isStrip)
            triangles.insert(triangles.end(), {a, b, c, a, c, d});
        else
            triangles.insert(triangles.end(), {a, b, d, b, c, d});
    }
}

bool readPrimitives(const osg::PrimitiveSet& primitives, std::int64_t vertices, bool withBothDiagonals,
                    std::vector<std::uint32_t>& triangles) {
    if (!drawsAllIndices(primitives) || !isWithinVertices(primitives, vertices)) return false;
    const GLenum mode = primitives.getMode();
    if (mode > GL_POLYGON) return false;
    if (mode <= GL_LINE_STRIP) {
        addPoints(primitives, triangles);
        return true;
    }
    const unsigned int count = primitives.getNumIndices();
    const std::size_t first = triangles.size();
    osg::TriangleIndexFunctor<IndexSink> functor;
    functor.triangles = &triangles;
    // OSG reads past the indices of an incomplete last triangle
    const bool isCutOff = mode == GL_TRIANGLES && count % 3 != 0 && primitives.getDrawElements();
    if (!isCutOff) primitives.accept(functor);
    for (unsigned int i = 2; isCutOff && i < count; i += 3)
        functor(primitives.index(i - 2), primitives.index(i - 1), primitives.index(i));
    const bool isOfQuads = mode == GL_QUADS || mode == GL_QUAD_STRIP;
    if (isOfQuads && withBothDiagonals) addOtherDiagonals(mode == GL_QUAD_STRIP, first, triangles);
    return true;
}

bool readGeometry(const osg::Geometry& geometry, const osg::Matrixd& localToEcef, SurfaceMesh& mesh,
                  bool withBothDiagonals) {
    const std::int64_t vertices = geometry.getVertexArray() ? geometry.getVertexArray()->getNumElements() : 0;
    for (const auto& primitives : geometry.getPrimitiveSetList())
        if (primitives && !readPrimitives(*primitives, vertices, withBothDiagonals, mesh.triangles)) return false;
    if (mesh.triangles.empty()) return true;
    if (!geometry.getVertexArray() || !readVertices(*geometry.getVertexArray(), localToEcef, mesh)) return false;
    const auto* texCoords = dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(0));
    if (texCoords && texCoords->size() == mesh.size()) mesh.texCoords = texCoords->asVector().data();
    return *std::max_element(mesh.triangles.begin(), mesh.triangles.end()) < mesh.size();
}

}  // namespace

bool isDrawnByItsVertices(const osg::Drawable& drawable) {
    return isOneOf<osg::Geometry, osg::ShapeDrawable>(drawable) && !drawable.getComputeBoundingBoxCallback() &&
           !drawable.getDrawCallback();
}

bool readMesh(const osg::Drawable& drawable, const osg::Matrixd& localToEcef, SurfaceMesh& mesh,
              bool withBothDiagonals) {
    mesh.triangles.clear();
    mesh.texCoords = nullptr;
    if (const osg::Geometry* geometry = drawable.asGeometry())
        return readGeometry(*geometry, localToEcef, mesh, withBothDiagonals);
    mesh.x.clear();
    mesh.y.clear();
    mesh.z.clear();
    osg::TriangleFunctor<TriangleSink> functor;
    if (!drawable.supports(functor)) return false;
    functor.mesh = &mesh;
    functor.toEcef = &localToEcef;
    drawable.accept(functor);
    return true;
}

double farthestVertex(const SurfaceMesh& mesh, const osg::Matrixd& localToEcef) {
    const glm::dvec3 origin = toGlm(localToEcef.getTrans());
    double farthest2 = 0.0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        const glm::dvec3 from = mesh.vertex(i) - origin;
        farthest2 = std::max(farthest2, glm::dot(from, from));
    }
    return std::sqrt(farthest2);
}

void dropUnusedVertices(SurfaceMesh& mesh) {
    std::vector<std::uint8_t> isUsed(mesh.size(), 0);
    for (const std::uint32_t i : mesh.triangles) isUsed[i] = 1;
    const glm::dvec3 any = mesh.vertex(mesh.triangles.front());
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        mesh.x[i] = isUsed[i] ? mesh.x[i] : any.x;
        mesh.y[i] = isUsed[i] ? mesh.y[i] : any.y;
        mesh.z[i] = isUsed[i] ? mesh.z[i] : any.z;
    }
}

}  // namespace osgAnalyticBin
