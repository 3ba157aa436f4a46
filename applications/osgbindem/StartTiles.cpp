// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "StartTiles.h"

#include "NodeFile.h"
#include "RootNode.h"

namespace osgbindem {

void StartTiles::build(TileBuilder& builder) {
    for (std::size_t i = _next++; i < kCount; i = _next++) {
        const int place = static_cast<int>(i);
        _tiles[i] = builder.build({0, place % TileId::kStartColumns, place / TileId::kStartColumns});
    }
}

std::string StartTiles::rootBytes(TileBuilder& builder) const {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = makeRoot(_settings);
    std::vector<osg::Geometry*> geometries;
    for (const auto& tile : _tiles) {
        root->addChild(tile->node);
        geometries.push_back(tile->geometry);
    }
    builder.finishFile(geometries, 0);
    declareHorizon(*root);
    return nodeFileBytes(*root, _settings.compress);
}

}  // namespace osgbindem
