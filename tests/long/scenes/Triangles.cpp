// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Triangles.h"

#include <osg/Geometry>
#include <osg/TriangleIndexFunctor>

#include <algorithm>

namespace osgAnalyticBin::test {

namespace {

// Triangles are taken a little larger than they are: neighbours that are rounded to float leave no cracks.
constexpr double kEnlarged = 2e-3;
// A point is not behind what it touches.
constexpr double kNearlyThere = 1.0 - 1e-6;

struct IndexCollector {
    std::vector<unsigned int> indices;
    void operator()(unsigned int a, unsigned int b, unsigned int c) { indices.insert(indices.end(), {a, b, c}); }
};

// Source: Moeller and Trumbore 1997.
bool meets(const Triangle& t, const osg::Vec3d& from, const osg::Vec3d& along) {
    const osg::Vec3d e1 = t[1] - t[0];
    const osg::Vec3d e2 = t[2] - t[0];
    const osg::Vec3d p = along ^ e2;
    const double determinant = e1 * p;
    if (determinant == 0.0) return false;
    const osg::Vec3d s = from - t[0];
    const double u = (s * p) / determinant;
    if (!(u >= -kEnlarged && u <= 1.0 + kEnlarged)) return false;
    const osg::Vec3d q = s ^ e1;
    const double v = (along * q) / determinant;
    if (!(v >= -kEnlarged && u + v <= 1.0 + kEnlarged)) return false;
    const double at = (e2 * q) / determinant;
    return at > 0.0 && at < kNearlyThere;
}

}  // namespace

Triangles::Triangles(const osg::Drawable& drawable, const osg::Matrixd& matrix) {
    const osg::Geometry* geometry = drawable.asGeometry();
    const auto* vertices = geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
    if (!vertices) return;
    std::vector<osg::Vec3d> points;
    points.reserve(vertices->size());
    for (const osg::Vec3& vertex : *vertices) points.push_back(osg::Vec3d(vertex) * matrix);
    for (const osg::Vec3d& point : points) center += point / static_cast<double>(points.size());
    for (const osg::Vec3d& point : points) radius = std::max(radius, (point - center).length());
    radius *= 1.0 + kEnlarged;
    for (const auto& primitives : geometry->getPrimitiveSetList()) {
        osg::TriangleIndexFunctor<IndexCollector> collector;
        primitives->accept(collector);
        std::vector<Triangle>& target = primitives->getMode() == GL_TRIANGLES ? surface : skirts;
        for (std::size_t i = 0; i + 2 < collector.indices.size(); i += 3)
            target.push_back(
                {points[collector.indices[i]], points[collector.indices[i + 1]], points[collector.indices[i + 2]]});
    }
}

bool Triangles::block(const osg::Vec3d& from, const osg::Vec3d& to) const {
    const osg::Vec3d along = to - from;
    const double square = along.length2();
    const double t = square > 0.0 ? std::clamp(((center - from) * along) / square, 0.0, 1.0) : 0.0;
    if ((from + along * t - center).length2() > radius * radius) return false;
    const auto meetsOne = [&](const Triangle& triangle) { return meets(triangle, from, along); };
    return std::any_of(surface.begin(), surface.end(), meetsOne) || std::any_of(skirts.begin(), skirts.end(), meetsOne);
}

}  // namespace osgAnalyticBin::test
