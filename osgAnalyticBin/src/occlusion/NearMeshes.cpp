// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NearMeshes.h"

#include "../kit/surface/TilePlates.h"
#include "../kit/tile/InstalledTile.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace osgAnalyticBin {

namespace {

// Appends the triangles whose horizontal boxes come within `radius` metres of the eye.
void appendNear(const core::EcefMesh& mesh, const core::Frame& eye, double radius, core::EcefMesh& close) {
    std::vector<std::array<double, 2>> places;
    places.reserve(mesh.size());
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        const glm::dvec3 from = mesh.vertex(i) - eye.origin;
        places.push_back({glm::dot(from, eye.x), glm::dot(from, eye.y)});
    }
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        std::array<std::uint32_t, 3> corners;
        std::copy_n(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i), 3, corners.begin());
        const auto isNear = [&](std::size_t axis) {
            const double a = places[corners[0]][axis], b = places[corners[1]][axis], c = places[corners[2]][axis];
            return std::min({a, b, c}) <= radius && std::max({a, b, c}) >= -radius;
        };
        if (!isNear(0) || !isNear(1)) continue;
        for (const std::uint32_t corner : corners) {
            const glm::dvec3 vertex = mesh.vertex(corner);
            close.triangles.push_back(static_cast<std::uint32_t>(close.size()));
            close.x.push_back(vertex.x);
            close.y.push_back(vertex.y);
            close.z.push_back(vertex.z);
        }
    }
}

}  // namespace

const core::EcefMesh* NearMeshes::trianglesNear(const AnalyticBinCullCallback& tile, osg::Node& mesh,
                                                const core::Frame& eye, double radius) {
    Known* const known = meshOf(tile, mesh);
    if (!known) return nullptr;
    // half of the room is for the eye's motion, the other half for its vertical, which turns as it moves
    const double room = 0.5 * (known->radius - radius);
    if (glm::distance(eye.origin, known->eye) <= room) return &known->close;
    constexpr double kWider = 4.0;
    known->eye = eye.origin;
    known->radius = kWider * radius;
    known->close = {};
    appendNear(known->mesh, eye, known->radius, known->close);
    return &known->close;
}

NearMeshes::Known* NearMeshes::meshOf(const AnalyticBinCullCallback& tile, osg::Node& mesh) {
    // meshes may change: what was read is not believed for long
    constexpr int kMostUses = 16;
    Known* known = nullptr;
    for (Known& one : _known) {
        if (one.tile.get() == &tile && one.node.get() == &mesh) known = &one;
    }
    const bool isChanged = tile.getInstalledTile() && tile.getInstalledTile()->has(InstalledTile::MeshChanged);
    const bool isSame = known && !isChanged && known->localToEcef == tile.getLocalToEcef();
    if (isSame && ++known->uses < kMostUses) return known;
    if (!known && _known.size() < kMostTiles) known = &_known.emplace_back();
    if (!known) known = &_known[_oldest++ % kMostTiles];
    // what was read in one view shall not all be read again in one view
    const auto early = static_cast<int>(known - _known.data()) * kMostUses / static_cast<int>(kMostTiles);
    *known = {nullptr, nullptr, tile.getLocalToEcef(), early, {}, {}, -1.0, {}};
    // the frame of a transform that is culled itself is that of what is below it
    const bool isInOwnFrame = mesh.asTransform() && tile.getInstalledTile() && tile.getInstalledTile()->isFor(&mesh);
    if (isInOwnFrame || !tile.getInstalledTile()) return nullptr;
    const osg::EllipsoidModel* const ellipsoid = tile.getInstalledTile()->database().ellipsoid();
    const TerrainShape shape = tile.getTerrainShape().value_or(TerrainShape());
    if (!ellipsoid || !readTileMesh({{&mesh}, *ellipsoid, tile.getLocalToEcef(), shape}, known->mesh)) return nullptr;
    known->tile = &tile;
    known->node = &mesh;
    return known;
}

}  // namespace osgAnalyticBin
