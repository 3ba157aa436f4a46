// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "StartTiles.h"

#include "Failure.h"
#include "NodeFile.h"
#include "RootNode.h"

namespace osgbindem {

using osgAnalyticBin::support::Failure;

StartTiles::StartTiles(const Site& site, const std::vector<Task>& tasks) : _site(site) {
    for (const Task& task : tasks) _tasks.insert(task.tile);
}

void StartTiles::build(TileBuilder& builder) {
    builder.setFinishedTasks([this](const TileId& tile) { return finished(tile); });
    for (std::size_t i = _next++; i < kCount; i = _next++) {
        const int place = static_cast<int>(i);
        _tiles[i] = builder.build({0, place % TileId::kStartColumns, place / TileId::kStartColumns});
    }
}

std::string StartTiles::rootBytes(TileBuilder& builder) const {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = makeRoot(_site.settings);
    std::vector<osg::Geometry*> geometries;
    for (const auto& tile : _tiles) {
        root->addChild(tile->node);
        geometries.push_back(tile->geometry);
    }
    builder.finishFile(geometries, 0);
    declareHorizon(*root);
    return nodeFileBytes(*root, _site.settings.compress);
}

std::optional<SurveyedTile> StartTiles::finished(const TileId& tile) const {
    if (_tasks.count(tile) == 0) return std::nullopt;
    auto record = _site.state.find(tile, _site.layout);
    if (!record) throw Failure("what was done of tile " + tileName(tile) + " is gone; run the same command again");
    return std::move(record->tile);
}

}  // namespace osgbindem
