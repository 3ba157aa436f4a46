// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemSource.h"

#include "Failure.h"
#include "Interruption.h"

#include <algorithm>
#include <cmath>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

/// The first post of the next block.
int nextBlock(int place) {
    return (place / VoidFill::kBlock + 1) * VoidFill::kBlock;
}

}  // namespace

DemSource::DemSource(std::unique_ptr<RasterLayer> layer, double mostPosts)
    : _layer(std::move(layer)),
      _mostBlocks(static_cast<std::size_t>(std::max(8.0, mostPosts / (VoidFill::kBlock * VoidFill::kBlock)))),
      _voids(*_layer, [this](int column, int row) { return post(column, row); }) {}

DemSource::Block& DemSource::blockWith(int column, int row) {
    if (_last != nullptr && _last->window.contains(column, row)) return *_last;
    const std::pair place(nextBlock(column) - VoidFill::kBlock, nextBlock(row) - VoidFill::kBlock);
    auto found = _blocks.find(place);
    if (found == _blocks.end()) {
        osgAnalyticBin::support::throwIfStopRequested();
        _last = nullptr;
        if (_blocks.size() >= _mostBlocks) _blocks.clear();
        const int width = std::min(VoidFill::kBlock, grid().columns() - place.first);
        const int height = std::min(VoidFill::kBlock, grid().rows() - place.second);
        std::vector<double> heights(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        const CPLErr error =
            _layer->dataset().GetRasterBand(1)->RasterIO(GF_Read, place.first, place.second, width, height,
                                                         heights.data(), width, height, GDT_Float64, 0, 0, nullptr);
        if (error != CE_None) throw Failure("cannot read \"" + _layer->path() + "\": " + gdalMessage());
        const PixelWindow window{place.first, place.second, width, height};
        found = _blocks.emplace(place, Block{window, std::move(heights), {}}).first;
    }
    _last = &found->second;
    return *_last;
}

double DemSource::post(int column, int row) {
    const Block& block = blockWith(column, row);
    return block.heights[block.place(column, row)];
}

FoundHeight DemSource::filled(int column, int row) {
    if (!blockWith(column, row).fill) {
        // Other blocks may be read meanwhile in place of this one.
        VoidFill::Block fill = _voids.filled(PixelWindow(blockWith(column, row).window));
        blockWith(column, row).fill = std::move(fill);
    }
    const Block& block = *_last;
    return block.fill->at(block.place(column, row));
}

std::optional<FoundHeight> DemSource::height(const PositionDeg& position) {
    const auto cell = grid().locate(position);
    if (!cell) return std::nullopt;
    FoundHeight result;
    bool isOwn = false;
    const auto at = [&](int column, int row) {
        const double height = post(column, row);
        if (!std::isnan(height)) {
            isOwn = true;
            return height;
        }
        const FoundHeight found = filled(column, row);
        isOwn = isOwn || !found.isRival;
        result.isFilled = result.isFilled || !found.isRival;
        return found.metres;
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

template <typename Visit>
void DemSource::forPosts(const std::vector<PixelWindow>& windows, const Visit& visit) const {
    for (const PixelWindow& window : windows) {
        const int east = window.column + window.width;
        const int south = window.row + window.height;
        for (int row = window.row; row < south; row = nextBlock(row))
            for (int column = window.column; column < east; column = nextBlock(column))
                for (int v = row; v < std::min(south, nextBlock(row)); ++v)
                    for (int u = column; u < std::min(east, nextBlock(column)); ++u)
                        if (!visit(u, v)) return;
    }
}

bool DemSource::addRange(const RectDeg& rect, Interval& range) {
    bool isComplete = grid().covers(rect);
    forPosts(grid().touching(rect), [&](int column, int row) {
        double height = post(column, row);
        if (std::isnan(height)) {
            const FoundHeight found = filled(column, row);
            height = found.metres;
            isComplete = isComplete && !found.isRival && !std::isnan(height);
        }
        if (!std::isnan(height)) range.expandBy(height);
        return true;
    });
    return isComplete;
}

bool DemSource::hasData(const RectDeg& rect) {
    bool isFound = false;
    forPosts(grid().inside(rect), [&](int column, int row) {
        isFound = !std::isnan(post(column, row));
        return !isFound;
    });
    return isFound;
}

}  // namespace osgbindem
