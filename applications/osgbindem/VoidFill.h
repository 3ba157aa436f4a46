// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterLayer.h"

#include <cstddef>
#include <functional>
#include <limits>
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
/// coarser rasters is interpolated from the rim and added to the coarser rasters (delta surface): full up to 64
/// posts from the rim, and fading out until 128. Beyond the raster's border the difference counts as 0.
/// Where the coarser rasters have sea the difference fades out within a few posts: the void is the sea, most likely.
/// Where another raster that is nearly as fine has data, a rival, this is data here, too, before anything is filled.
///
/// The raster is filled in blocks at fixed places, each from the posts around it, so a height depends on the
/// rasters alone and not on what was asked before. Not for use by several threads.
struct VoidFill {
    /// The height of a post of the raster; NaN where it is missing.
    using Post = std::function<double(int column, int row)>;
    /// What the coarser rasters have at a post.
    using Coarser = std::function<FoundHeight(int column, int row)>;

    /// Of each post of a block; empty where nothing is to be filled.
    struct Block {
        /// Requires: the raster has no data at the post.
        [[nodiscard]] FoundHeight at(std::size_t place) const {
            if (heights.empty()) return {};
            return {heights[place], !isRival[place], isRival[place]};
        }

        std::vector<float> heights;
        std::vector<bool> isRival;
    };

    /// Posts along the side of a block.
    static constexpr int kBlock = 256;
    /// Posts that a change of the coarser rasters may reach, no more.
    static constexpr int kMostReach = 512;

    /// What is in none of the layer's rasters is beyond the border; those round the globe have none in the west and
    /// east.
    const RasterLayer& layer;
    Post post;
    /// Without it only narrow voids are filled.
    Coarser coarser;
    /// Whether some of the coarser rasters are nearly as fine.
    bool hasRivals;

    /// What stands at the posts of a block, row by row. Throws Failure.
    [[nodiscard]] Block filled(const PixelWindow& block) const;
};

}  // namespace osgbindem
