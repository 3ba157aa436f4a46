// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseFolder.h"
#include "DemMosaic.h"
#include "ImageMosaic.h"
#include "Settings.h"
#include "SkirtMeasure.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Geometry>
#include <osg/Node>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace osgbindem {

/// What a database is made of, in numbers; of the finest posts each counts once, edges aside.
struct Tally {
    double tiles = 0.0;
    double deepest = 0.0;
    double files = 0.0;
    double bytes = 0.0;
    double posts = 0.0;
    /// Posts in voids, and those at 0 m because no raster has data there.
    double filled = 0.0;
    double missing = 0.0;

    void add(const Tally& other) noexcept {
        tiles += other.tiles;
        deepest = std::max(deepest, other.deepest);
        files += other.files;
        bytes += other.bytes;
        posts += other.posts;
        filled += other.filled;
        missing += other.missing;
    }
};

/// What the tiles above need to know of a tile with everything below it in files.
struct TileFigures {
    /// The full-resolution heights under the tile.
    Interval range = Interval::none();
    /// Of the tile and everything below it.
    Tally tally;
    /// Holds the bins of all tiles below; not valid for a tile without children.
    osgAnalyticBin::AnalyticBin below;
    /// What the files below the tile add up to, in whatever order they were written or read back.
    std::uint64_t checksum = 0;
};

/// And what its mesh is made of.
struct SurveyedTile : TileFigures {
    TileId id;
    /// The tile as it is stored, but for its colours.
    osgAnalyticBin::TerrainGrid grid;
};

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

    /// Surveys the tile and makes its mesh. Throws Failure, Interrupted.
    [[nodiscard]] BuiltTile build(const TileId& tile);

private:
    [[nodiscard]] SurveyedTile begun(const TileId& tile) const;
    [[nodiscard]] SurveyedTile surveyLeaf(const TileId& tile);
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
    std::function<void(const TileId&)> _leafDone;
    FinishedTasks _finished;
};

/// Makes ready what OpenSceneGraph loads on first use, so that threads find everything loaded.
/// Throws Failure when the classes of a database cannot be stored.
void prepareNodeFiles();

/// The bytes of the root file. Throws Failure.
[[nodiscard]] std::string rootFileBytes(const std::vector<BuiltTile>& startTiles, const Settings& settings,
                                        const TileLayout& layout);

}  // namespace osgbindem
