// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterLayer.h"
#include "VoidFill.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::core::Interval;

/// What is added to heights of a raster so that they are above the ellipsoid: the height of the geoid, found by PROJ.
/// Not for use by several threads: each has its own.
class VerticalShift final {
public:
    /// No shift.
    VerticalShift() = default;
    /// `vertical`: the vertical part of the reference system of the raster at `path`, empty when it has none.
    /// `geoid`: "none" for no shift, "egm96", or a file with a grid that PROJ reads; empty for what `vertical` says.
    /// Throws Failure when PROJ has no grid for it.
    VerticalShift(const std::string& vertical, const std::string& geoid, const std::string& path);

    [[nodiscard]] bool isNone() const noexcept { return !_transformation; }

    /// For the user: what heights are above.
    [[nodiscard]] const std::string& what() const noexcept { return _what; }

    /// Metres. Throws Failure where the grid has none.
    [[nodiscard]] double at(const PositionDeg& position) const;

    /// Holds those of all positions of the raster within the rectangle.
    [[nodiscard]] Interval range(const RectDeg& rect, const RasterGrid& grid) const;

private:
    std::string _what;
    std::unique_ptr<OGRCoordinateTransformation> _transformation;
};

class DemSource;

/// Blocks of elevation at fixed places, of one layer or of several, as they were read last; once there are too many,
/// all are forgotten. Not for use by several threads: each has its own.
struct DemBlocks {
    struct Block {
        [[nodiscard]] std::size_t place(int column, int row) const noexcept {
            return static_cast<std::size_t>((row - window.row) * window.width + column - window.column);
        }

        PixelWindow window;
        /// NaN where they are missing.
        std::vector<double> heights;
        /// Where one of those was asked for.
        std::optional<VoidFill::Block> fill;
    };

    /// More save no time.
    std::size_t most = 45;
    /// By layer, first column and first row.
    std::map<std::tuple<const DemSource*, int, int>, Block> blocks;
    /// How often they were forgotten.
    std::size_t age = 0;
};

/// One layer of elevation rasters. Not for use by several threads: each has its own.
class DemSource final {
public:
    /// `blocks`: the memory that it shares with other layers.
    explicit DemSource(std::unique_ptr<RasterLayer> layer, VerticalShift shift = {},
                       std::shared_ptr<DemBlocks> blocks = std::make_shared<DemBlocks>());
    DemSource(const DemSource&) = delete;
    DemSource& operator=(const DemSource&) = delete;

    [[nodiscard]] const RasterLayer& layer() const noexcept { return *_layer; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _layer->grid(); }
    [[nodiscard]] const VerticalShift& shift() const noexcept { return _shift; }

    /// To be told of coarser rasters before the first height is asked for.
    [[nodiscard]] VoidFill& voids() noexcept { return _voids; }

    /// Above the ellipsoid at a position, bilinear between posts, voids filled. Returns: nullopt where there is no
    /// data.
    [[nodiscard]] std::optional<FoundHeight> height(const PositionDeg& position);

    /// Whether any post within the rectangle has data.
    [[nodiscard]] bool hasData(const RectDeg& rect);

    /// Adds the heights of all posts that have part in the rectangle, above the ellipsoid, voids filled.
    /// Returns: whether the layer has heights everywhere in the rectangle.
    bool addRange(const RectDeg& rect, Interval& range);

private:
    [[nodiscard]] DemBlocks::Block& blockWith(int column, int row);
    [[nodiscard]] double post(int column, int row);
    [[nodiscard]] FoundHeight filled(int column, int row);
    /// Calls `visit(column, row, height)` for each post, block by block, as long as it returns true.
    template <typename Visit>
    void forPosts(const std::vector<PixelWindow>& windows, const Visit& visit);

    std::unique_ptr<RasterLayer> _layer;
    VerticalShift _shift;
    std::shared_ptr<DemBlocks> _blocks;
    DemBlocks::Block* _last = nullptr;
    std::size_t _age = 0;
    VoidFill _voids;
};

}  // namespace osgbindem
