// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterLayer.h"

#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace osgbindem {

/// A height at a place.
struct FoundHeight {
    /// NaN where there is none.
    double metres = std::numeric_limits<double>::quiet_NaN();
    /// No data: what stands in a void.
    bool isFilled = false;
    /// Data of another raster that is nearly as fine.
    bool isRival = false;
    /// The layer that has it.
    std::size_t source = 0;
};

/// Fills the voids of one raster: posts without data that stand near posts with data.
///
/// Narrow voids are interpolated from the heights at their rim. In wider ones the difference between the raster and the
/// coarser rasters is interpolated from the rim and added to the coarser rasters (delta surface): full up to half of
/// kReach posts from the rim, and fading out until kReach. Beyond the raster's border the difference counts as 0.
/// Where the coarser rasters have sea the difference fades out within a few posts: the void is the sea, most likely.
/// Where another raster that is nearly as fine has data, a rival, this is data here, too, before anything is filled.
///
/// The raster is filled in blocks at fixed places, each from the posts within kReach of it, so a height depends on the
/// rasters alone and not on what was asked before. Not for use by several threads.
class VoidFill final {
public:
    /// Heights of a window of posts within the raster, row by row; NaN where they are missing.
    using Read = std::function<void(const PixelWindow& window, std::vector<double>& heights)>;
    /// What the coarser rasters have at a post.
    using Coarser = std::function<FoundHeight(int column, int row)>;

    /// Posts from the rim within which posts are filled.
    static constexpr int kReach = 128;
    /// Posts that a change of the coarser rasters may reach, no more.
    static constexpr int kMostReach = 512;
    /// Posts across a narrow void, at most.
    static constexpr int kNarrow = 16;

    /// What is in none of the layer's rasters is beyond the border; those round the globe have none in the west and
    /// east. Without coarser rasters only narrow voids are filled.
    VoidFill(const RasterLayer& layer, Read read) : _layer(layer), _read(std::move(read)) {}

    /// Before the first void is filled. `hasRivals`: whether some of them are nearly as fine.
    void setCoarser(Coarser coarser, bool hasRivals) {
        _coarser = std::move(coarser);
        _hasRivals = hasRivals;
    }

    /// Requires: the raster has no data at the post. Throws Failure.
    [[nodiscard]] FoundHeight at(int column, int row);

private:
    class Window;
    /// Of each post of a block; empty ones have nothing to fill.
    struct Block {
        std::vector<float> heights;
        std::vector<bool> isRival;
    };

    const RasterLayer& _layer;
    Read _read;
    Coarser _coarser;
    bool _hasRivals = false;
    /// By number of the block.
    std::map<int, Block> _blocks;
    std::size_t _held = 0;
};

}  // namespace osgbindem
