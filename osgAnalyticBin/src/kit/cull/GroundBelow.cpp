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

// Goes through the triangles of a mesh, in ECEF. OSG's intersectors read no doubles, and past the end of an incomplete
// last triangle.
class TriangleWalk : public SurfaceWalk {
public:
    using SurfaceWalk::SurfaceWalk;

protected:
    virtual void look(const SurfaceMesh& mesh) = 0;

private:
    // OSG makes meshes of terrain tiles in the update traversal. It must not make them here: other threads may cull the
    // tile.
    void visit(osgTerrain::TerrainTile& tile) final {
        osgTerrain::TerrainTechnique* const technique = tile.getTerrainTechnique();
        if (!technique || tile.getDirtyMask() != 0) return giveUp();
        technique->traverse(*this);
    }

    void visit(osg::Drawable& drawable) final {
        thread_local PerThread<SurfaceMesh> kept;  // keeps its memory from mesh to mesh
        SurfaceMesh& mesh = *kept;
        if (!readMesh(drawable, localToEcef(), mesh, true)) return giveUp();
        look(mesh);
    }
};

// Searches the highest triangle of a mesh on the vertical through a point.
class VerticalSearch final : public TriangleWalk {
public:
    // `bottom`: metres, less than 0, down to which triangles are looked for.
    VerticalSearch(const osg::Matrixd& localToEcef, const glm::dvec3& point, const glm::dvec3& up, double bottom)
        : TriangleWalk(localToEcef),
          _point(point),
          _up(up),
          _right(glm::normalize(glm::cross(up, std::abs(up.z) < 0.5 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)))),
          _ahead(glm::cross(up, _right)),
          _rounding(1e-12 * glm::length(point)),
          _highest(bottom) {}

    // Whether there is one, and the point is above it.
    [[nodiscard]] bool isBelow() const { return isKnown() && _hasTriangle && _highest < 0.0; }
    // Its corners.
    [[nodiscard]] const core::TriangleCorners& triangle() const { return _triangle; }

private:
    void look(const SurfaceMesh& mesh) override {
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

// Looks whether anything of a mesh is above a triangle of it.
class OverhangSearch final : public TriangleWalk {
public:
    OverhangSearch(const osg::Matrixd& localToEcef, const core::TriangleCorners& triangle, const glm::dvec3& up)
        : TriangleWalk(localToEcef), _triangle(triangle), _up(up), _rounding(1e-11 * glm::length(triangle[0])) {
        _normal = glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
        if (glm::dot(_normal, up) < 0.0) _normal = -_normal;
    }

    [[nodiscard]] bool isOpen() const { return isKnown() && !_hasOverhang; }

private:
    void look(const SurfaceMesh& mesh) override {
        for (std::size_t i = 0; !_hasOverhang && i + 2 < mesh.triangles.size(); i += 3)
            _hasOverhang = isOver({mesh.vertex(mesh.triangles[i]), mesh.vertex(mesh.triangles[i + 1]),
                                   mesh.vertex(mesh.triangles[i + 2])});
    }

    // Skirts and what only touches the triangle are not.
    [[nodiscard]] bool isOver(const core::TriangleCorners& other) const {
        const bool isHigher = std::any_of(other.begin(), other.end(), [&](const glm::dvec3& at) {
            return glm::dot(at - _triangle[0], _normal) > _rounding;
        });
        return isHigher && !isBeside(_triangle, other) && !isBeside(other, _triangle) && !isAbove(other);
    }

    // Whether the triangle, and so all that is above it, is on the upper side of the other's plane: skirts lean.
    [[nodiscard]] bool isAbove(const core::TriangleCorners& other) const {
        glm::dvec3 normal = glm::cross(other[1] - other[0], other[2] - other[0]);
        if (glm::dot(normal, _up) < 0.0) normal = -normal;
        const double room = _rounding * glm::length(normal);
        return std::all_of(_triangle.begin(), _triangle.end(),
                           [&](const glm::dvec3& at) { return glm::dot(at - other[0], normal) >= -room; });
    }

    // Whether a vertical plane through a side of one triangle has the other beyond it.
    [[nodiscard]] bool isBeside(const core::TriangleCorners& one, const core::TriangleCorners& other) const {
        for (std::size_t i = 0; i < one.size(); ++i) {
            const glm::dvec3 &from = one[i], &to = one[(i + 1) % 3], &third = one[(i + 2) % 3];
            const glm::dvec3 across = glm::cross(to - from, _up);
            const double outward = glm::dot(third - from, across) > 0.0 ? -1.0 : 1.0;
            const double room = _rounding * glm::length(across);
            const bool isBeyond = std::all_of(other.begin(), other.end(), [&](const glm::dvec3& at) {
                return outward * glm::dot(at - from, across) >= -room;
            });
            if (isBeyond) return true;
        }
        return false;
    }

    const core::TriangleCorners _triangle;
    const glm::dvec3 _up;
    const double _rounding;  // metres
    glm::dvec3 _normal{};
    bool _hasOverhang = false;
};

}  // namespace

bool GroundBelow::isTriangleBelow(const glm::dvec3& eye, const glm::dvec3& up) const {
    const core::VerticalPassage passage(_triangle, eye, up);
    return passage.isWithin() && passage.height() < 0.0;
}

// Not before the triangle is to serve again: an eye that moves fast is above another one in each view.
bool GroundBelow::isTriangleOpen(const Ground& ground, const glm::dvec3& up) {
    if (!_isOpen) {
        OverhangSearch overhang(ground.localToEcef, _triangle, up);
        ground.mesh.accept(overhang);
        _isOpen = overhang.isOpen();
    }
    return *_isOpen;
}

bool GroundBelow::isBelow(const core::Geodetic& eye, const Ground& ground, const core::Ellipsoid& ellipsoid) {
    const glm::dvec3 point = ellipsoid.toEcef(eye);
    const glm::dvec3 up = ellipsoid.up(eye.latitude, eye.longitude);
    // an application may change a mesh without saying so: a result is used for about a second
    constexpr int kMostUses = 60;
    const bool isSame = ground.isAsRead && _tile.get() == &ground.tile && _mesh.get() == &ground.mesh &&
                        _localToEcef == ground.localToEcef;
    if (isSame && ++_uses < kMostUses && isTriangleBelow(point, up) && isTriangleOpen(ground, up)) return true;
    _mesh = nullptr;
    const double bottom = std::min(ground.low, eye.altitude) - 1.0 - eye.altitude;
    if (!std::isfinite(bottom)) return false;
    VerticalSearch search(ground.localToEcef, point, up, bottom);
    ground.mesh.accept(search);
    if (!search.isBelow()) return false;
    if (!isSame || _uses >= kMostUses || search.triangle() != _triangle) {
        _isOpen.reset();
        _uses = 0;
    }
    _triangle = search.triangle();
    _mesh = &ground.mesh;
    _tile = &ground.tile;
    _localToEcef = ground.localToEcef;
    return true;
}

}  // namespace osgAnalyticBin
