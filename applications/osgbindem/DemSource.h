// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "RasterLayer.h"
#include "VoidFill.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::core::Interval;

/// One layer of elevation rasters. Reads windows only; keeps the last window that was prefetched.
/// Not for use by several threads: each has its own.
class DemSource final {
public:
    /// More posts than this in memory save no time.
    static constexpr double kMostPosts = 3e6;

    explicit DemSource(std::unique_ptr<RasterLayer> layer);
    DemSource(const DemSource&) = delete;
    DemSource& operator=(const DemSource&) = delete;

    [[nodiscard]] const RasterLayer& layer() const noexcept { return *_layer; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _layer->grid(); }

    /// To be told of coarser rasters before the first height is asked for.
    [[nodiscard]] VoidFill& voids() noexcept { return _voids; }

    /// Metres at a position, bilinear between posts, voids filled. Returns: nullopt where there is no data.
    [[nodiscard]] std::optional<FoundHeight> height(const PositionDeg& position);

    /// Whether any post within the rectangle has data.
    [[nodiscard]] bool hasData(const RectDeg& rect);

    /// Adds the heights of all posts that have part in the rectangle, voids filled.
    /// Returns: whether the layer has heights everywhere in the rectangle.
    bool addRange(const RectDeg& rect, Interval& range);

    /// Reads what touches the rectangle into memory, if it is not there and is not too much.
    /// Returns: the posts now in memory, at most mostPosts.
    double prefetch(const RectDeg& rect, double mostPosts = kMostPosts);

private:
    struct Page {
        PixelWindow window;
        std::vector<double> heights;

        [[nodiscard]] std::ptrdiff_t offset(int column, int row) const noexcept {
            return static_cast<std::ptrdiff_t>(row - window.row) * window.width + (column - window.column);
        }
    };

    void read(const PixelWindow& window, std::vector<double>& heights);
    /// Reads windows in parts of about so many posts, as long as `visit` says so.
    void readInParts(const std::vector<PixelWindow>& windows, double posts,
                     const std::function<bool(const PixelWindow& part, const std::vector<double>& heights)>& visit);
    [[nodiscard]] double post(int column, int row);
    [[nodiscard]] const Page* pageWith(const PixelWindow& window) const noexcept;

    std::unique_ptr<RasterLayer> _layer;
    std::vector<Page> _pages;
    std::vector<double> _single;
    VoidFill _voids;
};

}  // namespace osgbindem
