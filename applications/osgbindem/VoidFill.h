// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterGrid.h"

#include <functional>
#include <vector>

namespace osgbindem {

/// Interpolates narrow voids of a raster, posts without data between posts with data, from their rims:
/// GDALFillNodata(). A void is narrow where no disc as wide as kWidest fits in between the data; along the raster's
/// border it is wide.
///
/// The raster is filled in blocks at fixed places, each from the posts around it, so a height depends on the raster
/// alone and not on what was asked before. Not for use by several threads.
struct VoidFill {
    /// The height of a post of the raster; NaN where it is missing.
    using Post = std::function<double(int column, int row)>;

    /// Posts along the side of a block.
    static constexpr int kBlock = 256;
    /// Posts across a narrow void, at most.
    static constexpr int kWidest = 16;

    const RasterGrid& grid;
    Post post;

    /// What stands in the voids of a block, row by row; NaN in wide ones. Throws Failure.
    [[nodiscard]] std::vector<float> filled(const PixelWindow& block) const;
};

}  // namespace osgbindem
