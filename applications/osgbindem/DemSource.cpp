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

DemSource::DemSource(std::unique_ptr<RasterLayer> layer)
    : _layer(std::move(layer)),
      _voids(*_layer, [this](const PixelWindow& window, std::vector<double>& heights) { read(window, heights); }) {}

void DemSource::read(const PixelWindow& window, std::vector<double>& heights) {
    heights.resize(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
    if (const Page* page = pageWith(window)) {
        auto target = heights.begin();
        for (int row = window.row; row < window.row + window.height; ++row) {
            const auto from = page->heights.begin() + page->offset(window.column, row);
            target = std::copy(from, from + window.width, target);
        }
        return;
    }
    const CPLErr error = _layer->dataset().GetRasterBand(1)->RasterIO(GF_Read, window.column, window.row, window.width,
                                                                      window.height, heights.data(), window.width,
                                                                      window.height, GDT_Float64, 0, 0, nullptr);
    if (error != CE_None) throw Failure("cannot read \"" + _layer->path() + "\": " + gdalMessage());
}

const DemSource::Page* DemSource::pageWith(const PixelWindow& window) const noexcept {
    const auto found =
        std::find_if(_pages.begin(), _pages.end(), [&](const Page& page) { return page.window.contains(window); });
    return found == _pages.end() ? nullptr : &*found;
}

double DemSource::post(int column, int row) {
    read({column, row, 1, 1}, _single);
    return _single.front();
}

std::optional<FoundHeight> DemSource::height(const PositionDeg& position) {
    const auto cell = grid().locate(position);
    if (!cell) return std::nullopt;
    // Nearly always one page has all four posts.
    const Page* page = pageWith({cell->west, cell->first, cell->east - cell->west + 1, cell->second - cell->first + 1});
    FoundHeight result;
    bool isOwn = false;
    const auto at = [&](int column, int row) {
        const double height =
            page ? page->heights[static_cast<std::size_t>(page->offset(column, row))] : post(column, row);
        if (!std::isnan(height)) {
            isOwn = true;
            return height;
        }
        const FoundHeight filled = _voids.at(column, row);
        isOwn = isOwn || !filled.isRival;
        result.isFilled = result.isFilled || !filled.isRival;
        return filled.metres;
    };
    const double u = cell->eastWeight;
    const double v = cell->secondWeight;
    // A post without a weight is not asked for: it may be missing.
    const auto between = [&](int row) {
        return u > 0.0 ? (1.0 - u) * at(cell->west, row) + u * at(cell->east, row) : at(cell->west, row);
    };
    result.metres = between(cell->first);
    if (v > 0.0) result.metres = (1.0 - v) * result.metres + v * between(cell->second);
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
        read(window, pages.back().heights);
    }
    _pages = std::move(pages);
    return wanted;
}

void DemSource::readInParts(
    const std::vector<PixelWindow>& windows, double posts,
    const std::function<bool(const PixelWindow& part, const std::vector<double>& heights)>& visit) {
    std::vector<double> heights;
    for (const PixelWindow& window : windows) {
        const int most = std::max(1, static_cast<int>(posts / window.width));
        for (int row = window.row; row < window.row + window.height; row += most) {
            osgAnalyticBin::support::throwIfStopRequested();
            const PixelWindow part{window.column, row, window.width, std::min(most, window.row + window.height - row)};
            read(part, heights);
            if (!visit(part, heights)) return;
        }
    }
}

bool DemSource::addRange(const RectDeg& rect, Interval& range) {
    bool isComplete = grid().covers(rect);
    readInParts(grid().touching(rect), 1e6, [&](const PixelWindow& part, const std::vector<double>& heights) {
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const int place = static_cast<int>(i);
            double height = heights[i];
            if (std::isnan(height)) {
                const FoundHeight filled = _voids.at(part.column + place % part.width, part.row + place / part.width);
                height = filled.metres;
                isComplete = isComplete && !filled.isRival && !std::isnan(height);
            }
            if (!std::isnan(height)) range.expandBy(height);
        }
        return true;
    });
    return isComplete;
}

bool DemSource::hasData(const RectDeg& rect) {
    bool isFound = false;
    readInParts(grid().inside(rect), 65536.0, [&](const PixelWindow&, const std::vector<double>& heights) {
        isFound = std::any_of(heights.begin(), heights.end(), [](double height) { return !std::isnan(height); });
        return !isFound;
    });
    return isFound;
}

}  // namespace osgbindem
