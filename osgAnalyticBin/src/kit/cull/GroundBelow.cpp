// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GroundBelow.h"

#include "../../core/PerThread.h"
#include "../../core/mesh/VerticalPassage.h"
#include "../GlmBridge.h"
#include "../surface/SurfaceMesh.h"
#include "../surface/SurfaceWalk.h"

#include <glm/geometric.hpp>
#include <osg/Drawable>
#include <osgTerrain/TerrainTechnique>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

namespace {

// Searches the highest triangle of a mesh on the vertical through a point. OSG's intersectors read no doubles, and past
// the end of an incomplete last triangle.
class VerticalSearch final : public SurfaceWalk {
public:
    // `bottom`: metres, less than 0, down to which triangles are looked for.
    VerticalSearch(const osg::Matrixd& localToEcef, const glm::dvec3& point, const glm::dvec3& up, double bottom)
        : SurfaceWalk(localToEcef),
          _point(point),
          _up(up),
          _right(glm::normalize(glm::cross(up, std::abs(up.z) < 0.5 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)))),
          _ahead(glm::cross(up, _right)),
          _rounding(1e-12 * glm::length(point)),
          _highest(bottom) {}

    // Whether there is one, and the point is above it.
    [[nodiscard]] bool isBelow() const { return isKnown() && _hasTriangle && _highest < 0.0; }
    // Its corners, in ECEF.
    [[nodiscard]] const core::TriangleCorners& triangle() const { return _triangle; }

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
        _sides.resize(mesh.x.size());
        for (std::size_t i = 0; i < _sides.size(); ++i) _sides[i] = sidesOf(mesh.vertex(i) - _point);
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
            if ((_sides[a] & _sides[b] & _sides[c]) == 0) add({mesh.vertex(a), mesh.vertex(b), mesh.vertex(c)});
        }
    }

    // The sides of the vertical that what is `from` its point is surely on, one bit for each.
    [[nodiscard]] std::uint8_t sidesOf(const glm::dvec3& from) const {
        const double right = glm::dot(from, _right), ahead = glm::dot(from, _ahead);
        return static_cast<std::uint8_t>(unsigned{right > _rounding} | unsigned{right < -_rounding} << 1U |
                                         unsigned{ahead > _rounding} << 2U | unsigned{ahead < -_rounding} << 3U);
    }

    void add(const core::TriangleCorners& triangle) {
        const core::VerticalPassage passage(triangle, _point, _up);
        const double height = passage.isWithinOrOnSide() ? passage.height() : _highest;
        // a triangle on edge has none
        if (!(height > _highest)) return;
        _hasTriangle = true;
        _highest = height;
        _triangle = triangle;
    }

    const glm::dvec3 _point, _up, _right, _ahead;
    const double _rounding;  // metres, of vertices' distances from planes through the vertical
    std::vector<std::uint8_t> _sides;
    double _highest;  // metres above the point
    bool _hasTriangle = false;
    core::TriangleCorners _triangle{};
};

}  // namespace

bool GroundBelow::isTriangleBelow(const glm::dvec3& eye, const glm::dvec3& up) const {
    const core::VerticalPassage passage(_triangle, eye, up);
    return passage.isWithin() && passage.height() < 0.0;
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
