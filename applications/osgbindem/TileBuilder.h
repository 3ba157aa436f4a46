// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DemMosaic.h"
#include "ImageMosaic.h"
#include "Settings.h"
#include "SkirtMeasure.h"
#include "SurveyedTile.h"
#include "TileFiles.h"
#include "TileMesh.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Geometry>
#include <osg/Node>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace osgbindem {

/// A finished tile; everything below it is in files.
struct BuiltTile {
    SurveyedTile survey;
    /// Holds the heights under the tile, what the mesh draws, and the bins of all tiles below.
    osgAnalyticBin::AnalyticBin bin;
    osg::ref_ptr<osg::Node> node;
    /// Without what the tiles of a file share.
    osg::ref_ptr<osg::Geometry> geometry;
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
    [[nodiscard]] BuiltTile build(const TileId& tile);

    [[nodiscard]] SkirtMeasure& skirts() noexcept { return _skirts; }
    [[nodiscard]] DemMosaic& mosaic() noexcept { return _mosaic; }

private:
    [[nodiscard]] SurveyedTile begun(const TileId& tile) const;
    /// Takes a post from the rasters, in whole steps; columns and rows of the ring around the tile are -1 and cells
    /// + 1.
    std::optional<FoundHeight> samplePost(SurveyedTile& tile, int column, int row);
    void buildChildren(SurveyedTile& tile);
    /// Adds the ring of posts around the tile, which the normals need, and the skirts.
    void finishSurvey(SurveyedTile& tile);

    const Settings& _settings;
    const TileLayout& _layout;
    const TileFiles& _files;
    DemMosaic _mosaic;
    SkirtMeasure _skirts;
    ImageMosaic _images;
    std::vector<std::uint16_t> _triangles;
    /// Of the meshes that are stored; none where tiles are packed.
    std::vector<std::uint16_t> _storedTriangles;
    std::function<void(const TileId&)> _leafDone;
    FinishedTasks _finished;
};

/// The bytes of the root file. Throws Failure.
[[nodiscard]] std::string rootFileBytes(const std::vector<BuiltTile>& startTiles, const Settings& settings,
                                        const TileLayout& layout);

}  // namespace osgbindem
