// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MeshEvidence.h"

#include "../CallbackChain.h"
#include "../cull/DrawnNode.h"
#include "../cull/TileFamily.h"
#include "../surface/TilePlates.h"
#include "../tile/InstalledTile.h"

namespace osgAnalyticBin {

namespace {

// Of a mesh that has changed.
void renewEvidence(osg::Node& mesh, const AnalyticBinCullCallback& tile, InstalledTile& installed) {
    const osg::ref_ptr<osg::Node> kept(&mesh);
    const TerrainShape shape = tile.getTerrainShape().value_or(TerrainShape());
    core::MeshCover cover = coverOf({{kept}, *installed.database().ellipsoid(), tile.getLocalToEcef(), shape});
    if (!isSamePlace(cover.place, installed.place())) cover.isFilled = false;
    cover.place = installed.place();
    installed.setCover(cover);
    const DrawnState drawn = drawnStateBelow(mesh, {tile.getCullOptions().plainShaders});
    if (!drawn.hides) installed.setSeeThrough();
    if (!drawn.obeysDepth) installed.ignoreDepth();
}

}  // namespace

void trustMeshes(osg::Node& group) {
    const TileFamily* const family = findCallback<TileFamily>(group.getCullCallback());
    for (unsigned int i = 0; family && i < family->size(); ++i) {
        const TileFamily::Member& member = family->member(i);
        if (!member.tile || !member.meshParts.front()) continue;
        InstalledTile& installed = *member.tile->getInstalledTile();
        if (installed.isMeshDoubted()) renewEvidence(*member.meshParts.front(), *member.tile, installed);
        installed.trustMesh();
    }
}

}  // namespace osgAnalyticBin
