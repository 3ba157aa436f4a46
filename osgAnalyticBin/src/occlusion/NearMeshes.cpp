// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NearMeshes.h"

#include "../kit/surface/TilePlates.h"
#include "../kit/tile/InstalledTile.h"

namespace osgAnalyticBin {

std::shared_ptr<const core::EcefMesh> NearMeshes::meshOf(const AnalyticBinCullCallback& tile, osg::Node& mesh) {
    // meshes may change: what was read is not believed for long
    constexpr int kMostUses = 16;
    Known* known = nullptr;
    for (Known& one : _known) {
        if (one.tile.get() == &tile && one.node.get() == &mesh) known = &one;
    }
    const bool isChanged = tile.getInstalledTile() && tile.getInstalledTile()->has(InstalledTile::MeshChanged);
    const bool isSame = known && !isChanged && known->localToEcef == tile.getLocalToEcef();
    if (isSame && ++known->uses < kMostUses) return known->mesh;
    if (_mostReads == 0) return nullptr;
    --_mostReads;
    if (!known && _known.size() < kMostTiles) known = &_known.emplace_back();
    if (!known) known = &_known[_oldest++ % kMostTiles];
    *known = {nullptr, nullptr, tile.getLocalToEcef(), 0, nullptr};
    // the frame of a transform that is culled itself is that of what is below it
    const bool isInOwnFrame = mesh.asTransform() && tile.getInstalledTile() && tile.getInstalledTile()->isFor(&mesh);
    if (isInOwnFrame || !tile.getInstalledTile()) return nullptr;
    const osg::EllipsoidModel* const ellipsoid = tile.getInstalledTile()->database().ellipsoid();
    const TerrainShape shape = tile.getTerrainShape().value_or(TerrainShape());
    const auto read = std::make_shared<core::EcefMesh>();
    if (!ellipsoid || !readTileMesh({{&mesh}, *ellipsoid, tile.getLocalToEcef(), shape}, *read)) return nullptr;
    known->tile = &tile;
    known->node = &mesh;
    known->mesh = read;
    return read;
}

}  // namespace osgAnalyticBin
