// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "StartTiles.h"

#include "NodeFile.h"
#include "RootNode.h"

namespace osgbindem {

void StartTiles::build(TileBuilder& builder) {
    for (std::size_t i = _next++; i < _tiles.size(); i = _next++) {
        if (i == 0) _shared = builder.sharedParts();  // which are the same for all builders
        _tiles[i] = builder.build(_layout.startTiles()[i]);
    }
}

std::string StartTiles::rootBytes() const {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = makeRoot(_settings);
    SharedParts shared = *_shared;
    for (const auto& tile : _tiles) {
        root->addChild(tile->node);
        tile->add(shared);
    }
    declareHorizon(*root, _layout);
    return nodeFileBytes(*root, _settings.compress);
}

}  // namespace osgbindem
