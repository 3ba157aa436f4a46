// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"

#include <functional>
#include <map>
#include <vector>

namespace osgbindem {

/// Fills the voids of one raster: posts without data that stand near posts with data.
///
/// Small voids are interpolated from the heights at their rim. In larger ones the difference between the raster and the
/// coarser rasters is interpolated from the rim and added to the coarser rasters (delta surface): full up to half of
/// kReach posts from the rim, and fading out until kReach. Beyond the raster's border the difference counts as 0.
/// Where the coarser rasters have sea the difference fades out within a few posts: the void is the sea, most likely.
///
/// The raster is filled in blocks at fixed places, each from the posts within kReach of it, so a height depends on the
/// rasters alone and not on what was asked before. Not for use by several threads.
class VoidFill final {
public:
    /// Heights of a window of posts within the raster, row by row; NaN where they are missing.
    using Read = std::function<void(const PixelWindow& window, std::vector<double>& heights)>;
    /// The height of the coarser rasters at a post; NaN where they have none.
    using Coarser = std::function<double(int column, int row)>;

    /// Posts from the rim within which posts are filled.
    static constexpr int kReach = 128;
    /// Posts that a change of the coarser rasters may reach, no more.
    static constexpr int kMostReach = 512;
    /// Posts along either side of the rectangle around a small void, at most.
    static constexpr int kSmall = 16;

    /// The raster's posts. A raster round the globe has no border in the west and east.
    struct Shape {
        int width = 0;
        int height = 0;
        bool isGlobal = false;
    };

    /// `coarser`: empty when there are no coarser rasters; then only small voids are filled.
    VoidFill(const Shape& shape, Read read, Coarser coarser)
        : _shape(shape), _read(std::move(read)), _coarser(std::move(coarser)) {}

    /// Requires: the raster has no data at the post. Returns: metres; NaN where it stays missing. Throws Failure.
    [[nodiscard]] double at(int column, int row);

private:
    struct Window;

    [[nodiscard]] std::vector<float> filled(const PixelWindow& block) const;
    void read(Window& window) const;
    void interpolateSmall(const Window& window, std::vector<float>& result) const;
    void addDifferences(const Window& window, std::vector<float>& result) const;
    /// The column of a raster round the globe that stands for one beyond its ends.
    [[nodiscard]] int inRaster(int column) const {
        return _shape.isGlobal ? ((column % _shape.width) + _shape.width) % _shape.width : column;
    }
    [[nodiscard]] double coarserAt(const Window& window, int x, int y) const;

    Shape _shape;
    Read _read;
    Coarser _coarser;
    /// By number of the block; an empty one has nothing to fill.
    std::map<int, std::vector<float>> _blocks;
    std::size_t _held = 0;
};

}  // namespace osgbindem
