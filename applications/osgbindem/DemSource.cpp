// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemSource.h"

#include "Failure.h"
#include "Interruption.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

constexpr const char* kAdvice = "; install the package proj-data, or see --geoid (none takes heights as they are)";

/// The first post of the next block.
int nextBlock(int place) {
    return (place / VoidFill::kBlock + 1) * VoidFill::kBlock;
}

}  // namespace

VerticalShift::VerticalShift(const std::string& vertical, const std::string& geoid, const std::string& path) {
    if (geoid == "none" || (geoid.empty() && vertical.empty())) return;
    OGRSpatialReference source;
    if (geoid.empty()) {
        OGRSpatialReference positions;
        OGRSpatialReference heights;
        positions.importFromEPSG(4326);
        heights.importFromWkt(vertical.c_str());
        source.SetCompoundCS("positions and heights", &positions, &heights);
        _what = std::string("the vertical reference \"") + heights.GetName() + "\" of \"" + path + "\"";
    } else {
        const bool isFile = geoid != "egm96";
        _what = isFile ? "the geoid \"" + geoid + "\"" : "the geoid EGM96";
        const std::string grid = isFile ? std::filesystem::absolute(geoid).string() : "egm96_15.gtx";
        const std::string text = "+proj=longlat +datum=WGS84 +geoidgrids=" + grid + " +vunits=m +no_defs";
        if (source.importFromProj4(text.c_str()) != OGRERR_NONE) {
            throw Failure("PROJ does not take \"" + grid + "\" for a grid of the geoid; see --geoid");
        }
    }
    OGRSpatialReference target;
    target.importFromEPSG(4979);
    source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRCoordinateTransformationOptions options;
    options.SetBallparkAllowed(false);
    _transformation.reset(OGRCreateCoordinateTransformation(&source, &target, options));
    if (!_transformation) throw Failure("PROJ has no grid for " + _what + kAdvice);
}

double VerticalShift::at(const PositionDeg& position) const {
    if (!_transformation) return 0.0;
    double x = std::remainder(position.longitudeDeg, 360.0);
    double y = position.latitudeDeg;
    double z = 0.0;
    if (_transformation->Transform(1, &x, &y, &z) == 0 || !std::isfinite(z)) {
        throw Failure("PROJ finds no height of " + _what + " at latitude " + std::to_string(position.latitudeDeg) +
                      ", longitude " + std::to_string(position.longitudeDeg) + kAdvice);
    }
    return z;
}

Interval VerticalShift::range(const RectDeg& rect, const RasterGrid& grid) const {
    if (isNone()) return {0.0, 0.0};
    // Between these places the geoid differs by no more than its steepest slope allows.
    constexpr int kPlaces = 16;
    constexpr double kSteepest = 25.0;  // metres a degree
    const double margin = kSteepest * std::max(rect.north - rect.south, rect.east - rect.west) / kPlaces;
    Interval range = Interval::none();
    for (int row = 0; row <= kPlaces; ++row) {
        for (int column = 0; column <= kPlaces; ++column) {
            const PositionDeg position{rect.south + (rect.north - rect.south) * row / kPlaces,
                                       rect.west + (rect.east - rect.west) * column / kPlaces};
            if (!grid.locate(position)) continue;
            const double metres = at(position);
            range.expandBy(metres - margin);
            range.expandBy(metres + margin);
        }
    }
    return range;
}

DemSource::DemSource(std::unique_ptr<RasterLayer> layer, VerticalShift shift, std::shared_ptr<DemBlocks> blocks)
    : _layer(std::move(layer)),
      _shift(std::move(shift)),
      _blocks(std::move(blocks)),
      _voids(*_layer, [this](int column, int row) { return post(column, row); }) {}

DemBlocks::Block& DemSource::blockWith(int column, int row) {
    if (_last != nullptr && _age == _blocks->age && _last->window.contains(column, row)) return *_last;
    const PixelWindow window{nextBlock(column) - VoidFill::kBlock, nextBlock(row) - VoidFill::kBlock,
                             std::min(nextBlock(column), grid().columns()) - nextBlock(column) + VoidFill::kBlock,
                             std::min(nextBlock(row), grid().rows()) - nextBlock(row) + VoidFill::kBlock};
    const std::tuple place(this, window.column, window.row);
    auto found = _blocks->blocks.find(place);
    if (found == _blocks->blocks.end()) {
        osgAnalyticBin::support::throwIfStopRequested();
        if (_blocks->blocks.size() >= _blocks->most) {
            _blocks->blocks.clear();
            ++_blocks->age;
        }
        std::vector<double> heights(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
        const CPLErr error = _layer->dataset().GetRasterBand(1)->RasterIO(
            GF_Read, window.column, window.row, window.width, window.height, heights.data(), window.width,
            window.height, GDT_Float64, 0, 0, nullptr);
        if (error != CE_None) throw Failure("cannot read \"" + _layer->path() + "\": " + gdalMessage());
        found = _blocks->blocks.emplace(place, DemBlocks::Block{window, std::move(heights), {}}).first;
    }
    _last = &found->second;
    _age = _blocks->age;
    return *_last;
}

double DemSource::post(int column, int row) {
    const DemBlocks::Block& block = blockWith(column, row);
    return block.heights[block.place(column, row)];
}

FoundHeight DemSource::filled(int column, int row) {
    if (!blockWith(column, row).fill) {
        // Other blocks may be read meanwhile in place of this one.
        VoidFill::Block fill = _voids.filled(PixelWindow(blockWith(column, row).window));
        blockWith(column, row).fill = std::move(fill);
    }
    const DemBlocks::Block& block = blockWith(column, row);
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
    result.metres += _shift.at(position);
    return result;
}

template <typename Visit>
void DemSource::forPosts(const std::vector<PixelWindow>& windows, const Visit& visit) {
    for (const PixelWindow& window : windows) {
        const int east = window.column + window.width;
        const int south = window.row + window.height;
        for (int row = window.row; row < south; row = nextBlock(row)) {
            for (int column = window.column; column < east; column = nextBlock(column)) {
                const DemBlocks::Block* block = &blockWith(column, row);
                std::size_t age = _blocks->age;
                for (int v = row; v < std::min(south, nextBlock(row)); ++v) {
                    for (int u = column; u < std::min(east, nextBlock(column)); ++u) {
                        if (age != _blocks->age) block = &blockWith(column, row);
                        age = _blocks->age;
                        if (!visit(u, v, block->heights[block->place(u, v)])) return;
                    }
                }
            }
        }
    }
}

bool DemSource::addRange(const RectDeg& rect, Interval& range) {
    bool isComplete = grid().covers(rect);
    Interval own = Interval::none();
    forPosts(grid().touching(rect), [&](int column, int row, double height) {
        if (std::isnan(height)) {
            const FoundHeight found = filled(column, row);
            height = found.metres;
            isComplete = isComplete && !found.isRival && !std::isnan(height);
        }
        if (!std::isnan(height)) own.expandBy(height);
        return true;
    });
    const Interval shift = _shift.range(rect, grid());
    if (own.width() < 0.0 || shift.width() < 0.0) return isComplete;
    range.expandBy(own.lower + shift.lower);
    range.expandBy(own.upper + shift.upper);
    return isComplete;
}

bool DemSource::hasData(const RectDeg& rect) {
    bool isFound = false;
    forPosts(grid().inside(rect), [&](int, int, double height) {
        isFound = !std::isnan(height);
        return !isFound;
    });
    return isFound;
}

}  // namespace osgbindem
