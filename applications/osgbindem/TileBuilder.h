// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "HeightGrid.h"
#include "ImageMosaic.h"
#include "Settings.h"
#include "SkirtMeasure.h"
#include "TileFiles.h"
#include "TileNode.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Geometry>
#include <osg/Node>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace osgbindem {

/// A finished tile; everything below it is in files.
struct BuiltTile {
    HeightGrid heights;
    /// The full-resolution heights under the tile.
    HeightRange range;
    Tally tally;
    /// Holds those, what the mesh draws, and the bins of all tiles below.
    osgAnalyticBin::AnalyticBin bin;
    osg::ref_ptr<osg::Node> node;
    osg::ref_ptr<osg::Geometry> geometry;
    /// 0: none.
    int textureSize = 0;

    /// Completes the geometry.
    void add(SharedParts& shared) const { shared.addTo(*geometry, textureSize); }
};

/// Finds what a task of the work plan has left of its tile; nullopt for every other tile.
using FinishedTasks = std::function<std::optional<SurveyedTile>(const TileId&)>;

/// Builds tiles bottom-up; holds no more than a path of the tree at a time. One per thread.
/// The result for a tile depends on the rasters and the layout only, not on what was built before or where.
class TileBuilder final {
public:
    /// Throws Failure.
    TileBuilder(const Settings& settings, const TileLayout& layout, const TileFiles& files);

    /// Called for each finished tile without children.
    void setLeafDone(std::function<void(const TileId&)> leafDone) { _leafDone = std::move(leafDone); }

    /// Tiles that are not surveyed again.
    void setFinishedTasks(FinishedTasks finished) { _finished = std::move(finished); }

    /// Writes all files below the tile. Throws Failure, Interrupted.
    [[nodiscard]] SurveyedTile survey(const TileId& tile);

    /// What the rasters say of a tile itself: neither what lies between its posts nor what is below it.
    [[nodiscard]] SurveyedTile surveyAlone(const TileId& tile);

    /// Surveys the tile and makes its mesh. Throws Failure, Interrupted.
    [[nodiscard]] std::unique_ptr<BuiltTile> build(const TileId& tile);

    /// The files written since the last call.
    [[nodiscard]] FileSum takeFileSum() { return std::exchange(_written, {}); }

    /// What the tiles of a file share.
    [[nodiscard]] SharedParts sharedParts() const;

    [[nodiscard]] EdgeDepths& depths() noexcept { return _depths; }
    [[nodiscard]] DemMosaic& mosaic() noexcept { return _mosaic; }

private:
    void prefetch(const TileId& tile);
    void finishSurvey(SurveyedTile& tile);
    void buildChildren(SurveyedTile& tile);
    [[nodiscard]] std::unique_ptr<BuiltTile> meshed(SurveyedTile tile);

    const Settings& _settings;
    const TileLayout& _layout;
    const TileFiles& _files;
    DemMosaic _mosaic;
    EdgeDepths _depths;
    SkirtMeasure _skirts;
    ImageMosaic _images;
    std::vector<std::uint16_t> _triangles;
    std::function<void(const TileId&)> _leafDone;
    FinishedTasks _finished;
    FileSum _written;
};

/// The start tiles, made of what the tasks have left of the tiles below them.
class StartTiles final {
public:
    StartTiles(const Settings& settings, const TileLayout& layout)
        : _settings(settings), _layout(layout), _tiles(layout.startTiles().size()) {}

    /// Requires: all tasks are finished, and the builder finds what they have left. May be called by several threads;
    /// they share the tiles.
    void build(TileBuilder& builder);

    /// Requires: all are built. The bytes of the root file.
    [[nodiscard]] std::string rootBytes() const;

    /// Requires: all are built.
    [[nodiscard]] Tally tally() const;

private:
    const Settings& _settings;
    const TileLayout& _layout;
    std::vector<std::unique_ptr<BuiltTile>> _tiles;
    std::optional<SharedParts> _shared;
    std::atomic<std::size_t> _next{0};
};

}  // namespace osgbindem
