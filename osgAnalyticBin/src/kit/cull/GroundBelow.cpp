// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "GroundBelow.h"

#include "../../core/PerThread.h"
#include "../GlmBridge.h"
#include "../surface/SurfaceMesh.h"
#include "../surface/SurfaceWalk.h"

#include <glm/geometric.hpp>
#include <osg/Drawable>
#include <osgTerrain/TerrainTechnique>

#include <algorithm>
#include <cmath>

namespace osgAnalyticBin {

// Goes through the triangles of a mesh, and adds those to a column that may reach into it. OSG's intersectors read no
// doubles, and past the end of an incomplete last triangle.
class GroundBelow::ColumnWalk final : public SurfaceWalk {
public:
    ColumnWalk(const osg::Matrixd& localToEcef, Column& column) : SurfaceWalk(localToEcef), _column(column) {}

    using SurfaceWalk::isKnown;

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
        for (std::size_t i = 0; i < _sides.size(); ++i) _sides[i] = _column.sidesBeyond(mesh.vertex(i));
        for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
            const std::uint32_t a = mesh.triangles[i], b = mesh.triangles[i + 1], c = mesh.triangles[i + 2];
            if ((_sides[a] & _sides[b] & _sides[c]) == 0)
                _column.triangles.push_back({mesh.vertex(a), mesh.vertex(b), mesh.vertex(c)});
        }
    }

    Column& _column;
    std::vector<std::uint8_t> _sides;  // of the vertices
};

bool GroundBelow::Column::isOf(const Ground& ground) const {
    return tile.get() == &ground.tile && mesh.get() == &ground.mesh;
}

std::uint8_t GroundBelow::Column::sidesBeyond(const glm::dvec3& point) const {
    const glm::dvec3 from = point - middle;
    const double x = glm::dot(from, right), y = glm::dot(from, ahead);
    return static_cast<std::uint8_t>(unsigned{!(x <= reach)} | unsigned{!(x >= -reach)} << 1U |
                                     unsigned{!(y <= reach)} << 2U | unsigned{!(y >= -reach)} << 3U);
}

// Returns: false where something in the mesh cannot be read.
bool GroundBelow::Column::read(const Ground& ground, const glm::dvec3& eye, const glm::dvec3& up) {
    constexpr std::size_t kFew = 8, kMany = 32;
    constexpr double kRoom = 1.001;  // verticals of eyes beside the middle lean, and what is above the bin is rounded
    const double size = ground.mesh.getBound().radius();
    const bool isWider = isOf(ground) && triangles.size() < kFew;
    reach = isOf(ground) ? std::min(isWider ? 2.0 * reach : reach, size) : 0.125 * size;
    mesh = nullptr;
    middle = eye;
    right = glm::normalize(glm::cross(up, std::abs(up.z) < 0.5 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    ahead = glm::cross(up, right);
    triangles.clear();
    ColumnWalk walk(ground.localToEcef, *this);
    ground.mesh.accept(walk);
    if (!walk.isKnown()) return false;
    // triangles may lie upon each other
    constexpr int kMostHalves = 16;
    for (int i = 0; i < kMostHalves && triangles.size() > kMany; ++i) {
        reach *= 0.5;
        const auto isBeside = [this](const core::TriangleCorners& triangle) {
            return (sidesBeyond(triangle[0]) & sidesBeyond(triangle[1]) & sidesBeyond(triangle[2])) != 0;
        };
        triangles.erase(std::remove_if(triangles.begin(), triangles.end(), isBeside), triangles.end());
    }
    reach /= kRoom;
    uses = 0;
    mesh = &ground.mesh;
    tile = &ground.tile;
    localToEcef = ground.localToEcef;
    return true;
}

bool GroundBelow::isBelow(const core::Geodetic& eye, const Ground& ground, const core::Ellipsoid& ellipsoid) {
    const glm::dvec3 point = ellipsoid.toEcef(eye);
    const glm::dvec3 up = ellipsoid.up(eye.latitude, eye.longitude);
    // metres above the eye, and more
    const double bottom = std::min(ground.low - eye.altitude, 0.0) - 1.0;
    const double top = std::max(ground.high - eye.altitude, 0.0) + 1.0;
    if (!std::isfinite(bottom)) return false;
    const auto own =
        std::find_if(_columns.begin(), _columns.end(), [&](const Column& known) { return known.isOf(ground); });
    Column& column = own != _columns.end() ? *own : _columns[_oldest++ % _columns.size()];
    // an application may change a mesh without saying so: what was read is used for about a second
    constexpr int kMostUses = 60;
    const bool isKnown = ground.isAsRead && column.isOf(ground) && column.localToEcef == ground.localToEcef &&
                         ++column.uses < kMostUses &&
                         (column.sidesBeyond(point + bottom * up) | column.sidesBeyond(point + top * up)) == 0;
    if (!isKnown && !column.read(ground, point, up)) return false;
    double highest = bottom;
    for (const core::TriangleCorners& triangle : column.triangles) {
        const core::VerticalPassage passage(triangle, point, up);
        const double height = passage.isWithinOrOnSide() ? passage.height() : bottom;
        // a triangle on edge has none
        if (height > highest) highest = height;
    }
    return highest > bottom && highest < 0.0;
}

}  // namespace osgAnalyticBin
