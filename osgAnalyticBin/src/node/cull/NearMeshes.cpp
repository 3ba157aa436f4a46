// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "NearMeshes.h"

#include "../install/InstalledTile.h"
#include "../install/TileCallback.h"
#include "../surface/TilePlates.h"

namespace osgAnalyticBin {

const core::EcefMesh* NearMeshes::trianglesOf(const AnalyticBinCullCallback& tile, osg::Node& mesh) {
    // meshes may change: what was read is not believed for long
    constexpr int kMostUses = 16;
    Known* known = nullptr;
    for (Known& one : _known) {
        if (one.tile.get() == &tile && one.node.get() == &mesh) known = &one;
    }
    const bool isChanged = tile.getInstalledTile() && tile.getInstalledTile()->isMeshChanged();
    const bool isSame = known && !isChanged && known->localToEcef == tile.getLocalToEcef();
    if (isSame && ++known->uses < kMostUses) return &known->mesh;
    if (!known && _known.size() < kMostTiles) known = &_known.emplace_back();
    if (!known) known = &_known[_oldest++ % kMostTiles];
    *known = {nullptr, nullptr, tile.getLocalToEcef(), 0, {}};
    // the frame of a transform that is culled itself is that of what is below it
    const bool isInOwnFrame = mesh.asTransform() && installedBinOf(mesh) == &tile;
    if (isInOwnFrame || !readTileMesh(mesh, tile.getLocalToEcef(), known->mesh)) return nullptr;
    known->tile = &tile;
    known->node = &mesh;
    return &known->mesh;
}

}  // namespace osgAnalyticBin
