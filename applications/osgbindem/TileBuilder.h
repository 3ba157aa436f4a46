// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "DatabaseFolder.h"
#include "DemMosaic.h"
#include "EdgeDepths.h"
#include "HeightGrid.h"
#include "ImageSource.h"
#include "Settings.h"
#include "SkirtMeasure.h"

#include <osgAnalyticBin/AnalyticBin.h>

#include <osg/Geometry>
#include <osg/Node>

#include <array>
#include <functional>
#include <map>
#include <memory>

namespace osgbindem {

/// A finished tile; everything below it is in files.
struct BuiltTile {
    HeightGrid heights;
    osg::ref_ptr<osg::Node> node;
    osg::ref_ptr<osg::Geometry> geometry;
    /// Holds the full-resolution heights under the tile, what its mesh draws, and the bins of all tiles below.
    osgAnalyticBin::AnalyticBin bin;
    HeightRange range;
};

/// Tiles that were built ahead, by the tasks of the work plan.
using BuiltTiles = std::map<TileId, std::unique_ptr<BuiltTile>>;

/// Builds tiles bottom-up; holds no more than a path of the tree at a time. One per thread.
/// The result for a tile depends on the rasters and the layout only, not on what was built before or where.
class TileBuilder final {
public:
    /// Throws Failure.
    TileBuilder(const Settings& settings, const TileLayout& layout, const DatabaseFolder& folder);

    /// Called for each finished tile without children.
    void setLeafDone(std::function<void(const TileId&)> leafDone) { _leafDone = std::move(leafDone); }

    /// Writes all files below the tile. Takes tiles that are there already from `ahead`.
    /// Throws Failure, Interrupted.
    [[nodiscard]] std::unique_ptr<BuiltTile> build(const TileId& tile, BuiltTiles& ahead);

    /// Adds what the tiles of one file share. Requires: tiles of one level.
    void finishFile(const std::vector<osg::Geometry*>& geometries, int level);

    [[nodiscard]] EdgeDepths& depths() noexcept { return _depths; }
    [[nodiscard]] DemMosaic& mosaic() noexcept { return _mosaic; }

private:
    void buildChildren(BuiltTile& tile, BuiltTiles& ahead);
    void finish(BuiltTile& tile, bool hasChildren);
    [[nodiscard]] osgAnalyticBin::AnalyticBin sourceBin(const TileId& tile, const HeightRange& range) const;

    const Settings& _settings;
    const TileLayout& _layout;
    const DatabaseFolder& _folder;
    DemMosaic _mosaic;
    EdgeDepths _depths;
    SkirtMeasure _skirts;
    std::unique_ptr<ImageSource> _image;
    std::vector<std::uint16_t> _triangles;
    std::function<void(const TileId&)> _leafDone;
};

}  // namespace osgbindem
