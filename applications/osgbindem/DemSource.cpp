// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemSource.h"

#include "Failure.h"
#include "Interruption.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

constexpr int kBlock = 256;
constexpr double kMostAtOnce = 1e6;

// No terrain is this high: a number beyond is a mark for missing data that the file does not declare.
constexpr double kHighest = 1e5;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void DemSource::Decoder::apply(std::vector<double>& values) const noexcept {
    for (double& value : values) {
        const bool missing =
            nodata && (value == *nodata || (isSingle && static_cast<float>(value) == static_cast<float>(*nodata)));
        const double metres = value * scale + offset;
        value = missing || !(std::abs(metres) <= kHighest) ? kNaN : metres;
    }
}

DemSource::Decoder DemSource::decoderOf(GDALRasterBand& band, const DemOptions& options) {
    Decoder decoder;
    int hasNodata = 0;
    const double nodata = band.GetNoDataValue(&hasNodata);
    if (hasNodata != 0) decoder.nodata = nodata;
    if (options.raster.nodata) decoder.nodata = options.raster.nodata;
    decoder.isSingle = band.GetRasterDataType() == GDT_Float32;
    decoder.scale = band.GetScale() * options.metresPerUnit;
    decoder.offset = band.GetOffset() * options.metresPerUnit;
    return decoder;
}

DemSource::DemSource(const DemOptions& options)
    : _raster(options.raster), _decoder(decoderOf(*_raster.dataset().GetRasterBand(1), options)), _voids(voidFill({})) {
    if (_raster.warpSource() != nullptr) {
        _sourceDecoder = decoderOf(*_raster.warpSource()->GetRasterBand(1), options);
        _decoder.scale = _sourceDecoder.scale;
        _decoder.offset = _sourceDecoder.offset;
    }
    _blockColumns = (_raster.width() + kBlock - 1) / kBlock;
    const int blockRows = (_raster.height() + kBlock - 1) / kBlock;
    _blocks.resize(static_cast<std::size_t>(_blockColumns) * static_cast<std::size_t>(blockRows), BlockState::Unknown);
}

VoidFill DemSource::voidFill(VoidFill::Coarser coarser) {
    const auto readPosts = [this](const PixelWindow& window, std::vector<double>& heights) {
        read(_raster.dataset(), _decoder, window, heights);
    };
    return {{grid().columns(), grid().rows(), grid().isGlobal()}, readPosts, std::move(coarser)};
}

void DemSource::setCoarser(Coarser coarser) {
    _voids = voidFill([this, coarser = std::move(coarser)](int column, int row) {
        return coarser(grid().position(column, row)).value_or(kNaN);
    });
}

void DemSource::read(GDALDataset& dataset, const Decoder& decoder, const PixelWindow& window,
                     std::vector<double>& heights) {
    heights.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
    if (const Page* page = &dataset == &_raster.dataset() ? pageWith(window) : nullptr) {
        auto target = heights.begin();
        for (int row = window.row; row < window.row + window.height; ++row) {
            const auto from = page->heights.begin() + page->offset(window.column, row);
            target = std::copy(from, from + window.width, target);
        }
        return;
    }
    const CPLErr error =
        dataset.GetRasterBand(1)->RasterIO(GF_Read, window.column, window.row, window.width, window.height,
                                           heights.data(), window.width, window.height, GDT_Float64, 0, 0, nullptr);
    if (error != CE_None) throw Failure("cannot read \"" + path() + "\": " + gdalMessage());
    decoder.apply(heights);
}

const DemSource::Page* DemSource::pageWith(const PixelWindow& window) const noexcept {
    for (const Page& page : _pages) {
        if (page.window.contains(window)) return &page;
    }
    return nullptr;
}

double DemSource::post(int column, int row) {
    const Page* page = pageWith({column, row, 1, 1});
    if (page == nullptr) read(_raster.dataset(), _decoder, {column, row, 1, 1}, _scratch);
    const double height =
        page == nullptr ? _scratch.front() : page->heights[static_cast<std::size_t>(page->offset(column, row))];
    return std::isnan(height) ? _voids.at(column, row) : height;
}

std::optional<double> DemSource::height(const PositionDeg& position) {
    const auto cell = grid().locate(position);
    if (!cell) return std::nullopt;
    // Nearly always one page has all four posts.
    const Page* page = nullptr;
    for (const Page& candidate : _pages) {
        if (candidate.window.contains(cell->west, cell->first) && candidate.window.contains(cell->east, cell->second)) {
            page = &candidate;
            break;
        }
    }
    const auto at = [&](int column, int row) {
        if (page == nullptr) return post(column, row);
        const double height = page->heights[static_cast<std::size_t>(page->offset(column, row))];
        return std::isnan(height) ? _voids.at(column, row) : height;
    };
    const double u = cell->eastWeight;
    const double v = cell->secondWeight;
    const double first = u > 0.0 ? (1.0 - u) * at(cell->west, cell->first) + u * at(cell->east, cell->first)
                                 : at(cell->west, cell->first);
    double height = first;
    if (v > 0.0) {
        const double second = u > 0.0 ? (1.0 - u) * at(cell->west, cell->second) + u * at(cell->east, cell->second)
                                      : at(cell->west, cell->second);
        height = (1.0 - v) * first + v * second;
    }
    if (std::isnan(height)) return std::nullopt;
    return height;
}

double DemSource::prefetch(const RectDeg& rect, double mostPosts) {
    const std::vector<PixelWindow> windows = grid().touching(rect);
    double wanted = 0.0;
    for (const PixelWindow& window : windows) wanted += window.area();
    const bool isThere =
        std::all_of(windows.begin(), windows.end(), [&](const PixelWindow& w) { return pageWith(w) != nullptr; });
    double held = 0.0;
    for (const Page& page : _pages) held += page.window.area();
    if (isThere && !windows.empty() && held <= mostPosts) return held;
    _pages.clear();
    if (windows.empty() || wanted > mostPosts) return 0.0;
    std::vector<Page> pages;
    for (const PixelWindow& window : windows) {
        pages.push_back({window, {}});
        read(_raster.dataset(), _decoder, window, pages.back().heights);
    }
    _pages = std::move(pages);
    return wanted;
}

/// Calls `rows(part, heights)` for parts of the window that are small enough to be in memory.
template <typename Rows>
void DemSource::readInParts(GDALDataset& dataset, const Decoder& decoder, const PixelWindow& window, const Rows& rows) {
    const int most = std::max(1, static_cast<int>(kMostAtOnce / window.width));
    for (int row = window.row; row < window.row + window.height; row += most) {
        throwIfStopRequested();
        const PixelWindow part{window.column, row, window.width, std::min(most, window.row + window.height - row)};
        read(dataset, decoder, part, _scratch);
        rows(part);
    }
}

bool DemSource::addRange(const PixelWindow& window, HeightRange& range) {
    bool isComplete = true;
    readInParts(_raster.dataset(), _decoder, window, [&](const PixelWindow& part) {
        std::vector<double> heights = std::move(_scratch);  // filling voids may read
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const int place = static_cast<int>(i);
            const double height = std::isnan(heights[i])
                                      ? _voids.at(part.column + place % part.width, part.row + place / part.width)
                                      : heights[i];
            if (std::isnan(height)) {
                isComplete = false;
            } else {
                range.include(height);
            }
        }
        _scratch = std::move(heights);
    });
    return isComplete;
}

void DemSource::addSourceRange(const PixelWindow& window, HeightRange& range) {
    readInParts(*_raster.warpSource(), _sourceDecoder, window, [&](const PixelWindow&) {
        for (const double height : _scratch) {
            if (!std::isnan(height)) range.include(height);
        }
    });
}

bool DemSource::addRange(const RectDeg& rect, HeightRange& range) {
    bool isComplete = grid().covers(rect);
    for (const PixelWindow& window : grid().touching(rect)) {
        isComplete = addRange(window, range) && isComplete;
        if (_raster.warpSource() == nullptr) continue;
        // The warped posts are averages; the file has the peaks.
        for (const PixelWindow& source : _raster.sourceWindows(window)) addSourceRange(source, range);
    }
    return isComplete;
}

bool DemSource::windowHasData(const PixelWindow& window) {
    read(_raster.dataset(), _decoder, window, _scratch);
    return std::any_of(_scratch.begin(), _scratch.end(), [](double height) { return !std::isnan(height); });
}

bool DemSource::blockHasData(int blockColumn, int blockRow) {
    BlockState& state = _blocks[static_cast<std::size_t>(blockRow * _blockColumns + blockColumn)];
    if (state == BlockState::Unknown) {
        throwIfStopRequested();
        const int column = blockColumn * kBlock;
        const int row = blockRow * kBlock;
        const PixelWindow window{column, row, std::min(kBlock, _raster.width() - column),
                                 std::min(kBlock, _raster.height() - row)};
        state = windowHasData(window) ? BlockState::HasData : BlockState::Empty;
    }
    return state == BlockState::HasData;
}

bool DemSource::hasData(const PixelWindow& window) {
    const int endColumn = window.column + window.width;
    const int endRow = window.row + window.height;
    for (int blockRow = window.row / kBlock; blockRow * kBlock < endRow; ++blockRow) {
        for (int blockColumn = window.column / kBlock; blockColumn * kBlock < endColumn; ++blockColumn) {
            if (!blockHasData(blockColumn, blockRow)) continue;
            const int column = std::max(window.column, blockColumn * kBlock);
            const int row = std::max(window.row, blockRow * kBlock);
            const PixelWindow part{column, row, std::min(endColumn, (blockColumn + 1) * kBlock) - column,
                                   std::min(endRow, (blockRow + 1) * kBlock) - row};
            if (windowHasData(part)) return true;
        }
    }
    return false;
}

bool DemSource::hasData(const RectDeg& rect) {
    for (const PixelWindow& window : grid().inside(rect)) {
        if (hasData(window)) return true;
    }
    return false;
}

bool DemSource::hasAnyData() {
    // A look at every n-th post finds most data at once; only an almost empty raster is read as a whole.
    constexpr int kLook = 256;
    const int width = std::min(kLook, _raster.width());
    const int height = std::min(kLook, _raster.height());
    _scratch.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const CPLErr error = _raster.dataset().GetRasterBand(1)->RasterIO(
        GF_Read, 0, 0, _raster.width(), _raster.height(), _scratch.data(), width, height, GDT_Float64, 0, 0, nullptr);
    if (error != CE_None) throw Failure("cannot read \"" + path() + "\": " + gdalMessage());
    _decoder.apply(_scratch);
    if (std::any_of(_scratch.begin(), _scratch.end(), [](double h) { return !std::isnan(h); })) return true;
    return hasData(PixelWindow{0, 0, _raster.width(), _raster.height()});
}

}  // namespace osgbindem
