// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemSource.h"

#include "Failure.h"
#include "Interruption.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

constexpr int kBlock = 256;
constexpr double kMostAtOnce = 1e6;

}  // namespace

DemSource::DemSource(std::unique_ptr<RasterLayer> layer)
    : _layer(std::move(layer)), _voids(*_layer, [this](const PixelWindow& window, std::vector<double>& heights) {
          read(_layer->dataset(), window, heights);
      }) {}

void DemSource::read(GDALDataset& dataset, const PixelWindow& window, std::vector<double>& heights) {
    heights.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
    if (const Page* page = &dataset == &_layer->dataset() ? pageWith(window) : nullptr) {
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
    if (error != CE_None) throw Failure("cannot read \"" + _layer->path() + "\": " + gdalMessage());
}

const DemSource::Page* DemSource::pageWith(const PixelWindow& window) const noexcept {
    for (const Page& page : _pages) {
        if (page.window.contains(window)) return &page;
    }
    return nullptr;
}

double DemSource::ownPost(int column, int row) {
    const Page* page = pageWith({column, row, 1, 1});
    if (page != nullptr) return page->heights[static_cast<std::size_t>(page->offset(column, row))];
    read(_layer->dataset(), {column, row, 1, 1}, _scratch);
    return _scratch.front();
}

std::optional<SourceHeight> DemSource::height(const PositionDeg& position) {
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
    SourceHeight result;
    bool isOwn = false;
    const auto at = [&](int column, int row) {
        const double height =
            page == nullptr ? ownPost(column, row) : page->heights[static_cast<std::size_t>(page->offset(column, row))];
        if (!std::isnan(height)) {
            isOwn = true;
            return height;
        }
        const VoidFill::Below filled = _voids.at(column, row);
        isOwn = isOwn || !filled.isRival;
        result.isFilled = result.isFilled || !filled.isRival;
        return filled.height;
    };
    const double u = cell->eastWeight;
    const double v = cell->secondWeight;
    const double first = u > 0.0 ? (1.0 - u) * at(cell->west, cell->first) + u * at(cell->east, cell->first)
                                 : at(cell->west, cell->first);
    result.metres = first;
    if (v > 0.0) {
        const double second = u > 0.0 ? (1.0 - u) * at(cell->west, cell->second) + u * at(cell->east, cell->second)
                                      : at(cell->west, cell->second);
        result.metres = (1.0 - v) * first + v * second;
    }
    // Where all posts around are a rival's, the rival itself is asked.
    if (std::isnan(result.metres) || !isOwn) return std::nullopt;
    return result;
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
        read(_layer->dataset(), window, pages.back().heights);
    }
    _pages = std::move(pages);
    return wanted;
}

/// Calls `rows(part, heights)` for parts of the window that are small enough to be in memory.
template <typename Rows>
void DemSource::readInParts(GDALDataset& dataset, const PixelWindow& window, const Rows& rows) {
    const int most = std::max(1, static_cast<int>(kMostAtOnce / window.width));
    for (int row = window.row; row < window.row + window.height; row += most) {
        throwIfStopRequested();
        const PixelWindow part{window.column, row, window.width, std::min(most, window.row + window.height - row)};
        read(dataset, part, _scratch);
        rows(part);
    }
}

bool DemSource::addRange(const PixelWindow& window, HeightRange& range) {
    bool isComplete = true;
    readInParts(_layer->dataset(), window, [&](const PixelWindow& part) {
        std::vector<double> heights = std::move(_scratch);  // filling voids may read
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const int place = static_cast<int>(i);
            double height = heights[i];
            if (std::isnan(height)) {
                const VoidFill::Below filled =
                    _voids.at(part.column + place % part.width, part.row + place / part.width);
                height = filled.height;
                isComplete = isComplete && !filled.isRival;
            }
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

bool DemSource::addRange(const RectDeg& rect, HeightRange& range) {
    bool isComplete = grid().covers(rect);
    for (const PixelWindow& window : grid().touching(rect)) {
        isComplete = addRange(window, range) && isComplete;
        // The warped posts are averages; the files have the peaks.
        _layer->forSources(window, [&](GDALDataset& source, const PixelWindow& sourceWindow) {
            readInParts(source, sourceWindow, [&](const PixelWindow&) {
                for (const double height : _scratch) {
                    if (!std::isnan(height)) range.include(height);
                }
            });
        });
    }
    return isComplete;
}

bool DemSource::hasData(const PixelWindow& window) {
    const int endColumn = window.column + window.width;
    const int endRow = window.row + window.height;
    for (int row = window.row; row < endRow; row += kBlock) {
        for (int column = window.column; column < endColumn; column += kBlock) {
            throwIfStopRequested();
            read(_layer->dataset(), {column, row, std::min(kBlock, endColumn - column), std::min(kBlock, endRow - row)},
                 _scratch);
            if (std::any_of(_scratch.begin(), _scratch.end(), [](double height) { return !std::isnan(height); }))
                return true;
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

}  // namespace osgbindem
