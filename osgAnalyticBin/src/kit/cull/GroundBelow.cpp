// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GroundBelow.h"

#include "../../core/PerThread.h"
#include "../GlmBridge.h"
#include "../surface/SurfaceMesh.h"
#include "../surface/SurfaceWalk.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <osg/Drawable>
#include <osgTerrain/TerrainTechnique>

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgAnalyticBin {

namespace {

// Searches the highest triangle of a mesh on the vertical through a point. OSG's intersectors read no doubles, and past
// the end of an incomplete last triangle.
class VerticalSearch final : public SurfaceWalk {
public:
    // `bottom`: metres, less than 0, down to which triangles are looked for.
    VerticalSearch(const osg::Matrixd& localToEcef, const glm::dvec3& point, const glm::dvec3& up, double bottom)
        : SurfaceWalk(localToEcef), _point(point), _highest(bottom) {
        const glm::dvec3 least = std::abs(up.z) < 0.5 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
        const glm::dvec3 east = glm::normalize(glm::cross(least, up));
        _axes = {east, glm::cross(up, east), up};
    }

    // Whether there is one, and the point is above it.
    [[nodiscard]] bool isBelow() const { return isKnown() && _hasTriangle && _highest < 0.0; }
    // Its corners, in ECEF.
    [[nodiscard]] const std::array<glm::dvec3, 3>& triangle() const { return _triangle; }

private:
    // OSG makes meshes of terrain tiles in the update traversal. It must not make them here: other threads may cull the
    // tile.
    void visit(osgTerrain::TerrainTile& tile) override {
        osgTerrain::TerrainTechnique* const technique = tile.getTerrainTechnique();
        if (!technique || tile.getDirtyMask() != 0) return giveUp();
        technique->traverse(*this);
    }

    void visit(osg::Drawable& drawable) override {
        thread_local PerThread<SurfaceMesh> kept;  // keeps its memory from mesh to mesh
        SurfaceMesh& mesh = *kept;
        if (!readMesh(drawable, localToEcef(), mesh, true)) return giveUp();
        // from the point, along the axes
        for (std::size_t i = 0; i < mesh.size(); ++i) {
            const glm::dvec3 at = (mesh.vertex(i) - _point) * _axes;
            mesh.x[i] = at.x;
            mesh.y[i] = at.y;
            mesh.z[i] = at.z;
        }
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
            add(mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]), mesh.vertex(mesh.triangles[i + 2]));
    }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        const double ab = a.x * b.y - a.y * b.x, bc = b.x * c.y - b.y * c.x, ca = c.x * a.y - c.y * a.x;
        const bool isMet = (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
        const double height = isMet ? (ab * c.z + bc * a.z + ca * b.z) / (ab + bc + ca) : 0.0;
        // one on edge has no height
        if (!isMet || !(height > _highest)) return;
        _hasTriangle = true;
        _highest = height;
        for (const auto& [corner, i] : {std::pair(a, 0U), std::pair(b, 1U), std::pair(c, 2U)})
            _triangle[i] = _point + _axes * corner;
    }

    const glm::dvec3 _point;
    glm::dmat3 _axes;
    double _highest;  // metres above the point
    bool _hasTriangle = false;
    std::array<glm::dvec3, 3> _triangle{};
};

}  // namespace

bool GroundBelow::isTriangleBelow(const glm::dvec3& eye, const glm::dvec3& up) const {
    const auto& [a, b, c] = _triangle;
    const double ab = glm::dot(up, glm::cross(a - eye, b - eye));
    const double bc = glm::dot(up, glm::cross(b - eye, c - eye));
    const double ca = glm::dot(up, glm::cross(c - eye, a - eye));
    const bool isWithin = (ab > 0.0 && bc > 0.0 && ca > 0.0) || (ab < 0.0 && bc < 0.0 && ca < 0.0);
    return isWithin &&
           (ab * glm::dot(up, c - eye) + bc * glm::dot(up, a - eye) + ca * glm::dot(up, b - eye)) / (ab + bc + ca) <
               0.0;
}

bool GroundBelow::isBelow(const core::Geodetic& eye, const Ground& ground, const core::Ellipsoid& ellipsoid) {
    const glm::dvec3 point = ellipsoid.toEcef(eye);
    const glm::dvec3 up = ellipsoid.up(eye.latitude, eye.longitude);
    // an application may change a mesh without saying so: a result is used for about a second
    constexpr int kMostUses = 60;
    const bool isSame = ground.isAsRead && _mesh.get() == &ground.mesh && _localToEcef == ground.localToEcef;
    if (isSame && ++_uses < kMostUses && isTriangleBelow(point, up)) return true;
    _mesh = nullptr;
    const double bottom = std::min(ground.low, eye.altitude) - 1.0 - eye.altitude;
    if (!std::isfinite(bottom)) return false;
    VerticalSearch search(ground.localToEcef, point, up, bottom);
    ground.mesh.accept(search);
    if (!search.isBelow()) return false;
    _triangle = search.triangle();
    _mesh = &ground.mesh;
    _localToEcef = ground.localToEcef;
    _uses = 0;
    return true;
}

}  // namespace osgAnalyticBin
