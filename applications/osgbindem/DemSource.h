// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "GdalRaster.h"
#include "VoidFill.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace osgbindem {

/// The heights found in an area, in metres; empty when lower > upper.
struct HeightRange {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool empty() const noexcept { return lower > upper; }
    void include(double height) noexcept { include({height, height}); }
    void include(const HeightRange& other) noexcept {
        lower = std::min(lower, other.lower);
        upper = std::max(upper, other.upper);
    }
};

struct DemOptions {
    RasterOptions raster;
    double metresPerUnit = 1.0;
};

/// One elevation raster. Reads windows only; keeps the last window that was prefetched.
/// Not for use by several threads: each has its own.
class DemSource final {
public:
    /// More posts than this in memory save no time.
    static constexpr double kMostPosts = 3e6;

    /// Throws Failure.
    explicit DemSource(const DemOptions& options);
    DemSource(const DemSource&) = delete;
    DemSource& operator=(const DemSource&) = delete;

    [[nodiscard]] const std::string& path() const noexcept { return _raster.path(); }
    [[nodiscard]] const GdalRaster& raster() const noexcept { return _raster; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _raster.grid(); }

    /// The height of coarser rasters; nullopt where they have none.
    using Coarser = std::function<std::optional<double>(const PositionDeg&)>;

    /// Fills large voids too, from what coarser rasters have there; before the first height is asked for.
    void setCoarser(Coarser coarser);

    /// Metres at a position, bilinear between posts, voids filled. Returns: nullopt where there is no data.
    [[nodiscard]] std::optional<double> height(const PositionDeg& position);

    /// Whether any post within the rectangle has data.
    [[nodiscard]] bool hasData(const RectDeg& rect);

    /// Adds the heights of all posts that have part in the rectangle, at the full resolution of the file, voids filled.
    /// Returns: whether the raster has heights everywhere in the rectangle.
    bool addRange(const RectDeg& rect, HeightRange& range);

    /// Reads what touches the rectangle into memory, if it is not there and is not too much.
    /// Returns: the posts now in memory, at most mostPosts.
    double prefetch(const RectDeg& rect, double mostPosts = kMostPosts);

    /// Whether the raster has any data at all.
    [[nodiscard]] bool hasAnyData();

private:
    /// How the numbers of a band become metres.
    struct Decoder {
        std::optional<double> nodata;
        bool isSingle = false;
        double scale = 1.0;
        double offset = 0.0;

        void apply(std::vector<double>& values) const noexcept;
    };
    struct Page {
        PixelWindow window;
        std::vector<double> heights;

        [[nodiscard]] std::ptrdiff_t offset(int column, int row) const noexcept {
            return static_cast<std::ptrdiff_t>(row - window.row) * window.width + (column - window.column);
        }
    };
    enum class BlockState : std::uint8_t { Unknown, Empty, HasData };

    [[nodiscard]] static Decoder decoderOf(GDALRasterBand& band, const DemOptions& options);
    void read(GDALDataset& dataset, const Decoder& decoder, const PixelWindow& window, std::vector<double>& heights);
    bool addRange(const PixelWindow& window, HeightRange& range);
    void addSourceRange(const PixelWindow& window, HeightRange& range);
    template <typename Rows>
    void readInParts(GDALDataset& dataset, const Decoder& decoder, const PixelWindow& window, const Rows& rows);
    [[nodiscard]] bool hasData(const PixelWindow& window);
    [[nodiscard]] bool windowHasData(const PixelWindow& window);
    [[nodiscard]] bool blockHasData(int blockColumn, int blockRow);
    [[nodiscard]] double post(int column, int row);
    [[nodiscard]] VoidFill voidFill(VoidFill::Coarser coarser);
    [[nodiscard]] const Page* pageWith(const PixelWindow& window) const noexcept;

    GdalRaster _raster;
    Decoder _decoder;
    Decoder _sourceDecoder;
    std::vector<Page> _pages;
    std::vector<double> _scratch;
    std::vector<BlockState> _blocks;
    int _blockColumns = 0;
    VoidFill _voids;
};

}  // namespace osgbindem
