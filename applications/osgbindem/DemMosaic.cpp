// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DemMosaic.h"

#include "Failure.h"
#include "RasterLayer.h"

#include <gdal_alg.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace osgbindem {

/// What is added to heights of a raster so that they are above the ellipsoid: the height of the geoid, found by PROJ.
class VerticalShift final {
public:
    /// `vertical`: the vertical part of the reference system of the raster at `path`, empty when it has none.
    /// `geoid`: "none" for no shift, "egm96", or a file with a grid that PROJ reads; empty for what `vertical` says.
    /// Throws Failure when PROJ has no grid for it.
    VerticalShift(const std::string& vertical, const std::string& geoid, const std::string& path) {
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
            if (source.importFromProj4(text.c_str()) != OGRERR_NONE)
                throw Failure("PROJ does not take \"" + grid + "\" for a grid of the geoid; see --geoid");
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

    [[nodiscard]] bool isNone() const noexcept { return !_transformation; }

    /// For the user: what heights are above.
    [[nodiscard]] const std::string& what() const noexcept { return _what; }

    /// Metres. Throws Failure where the grid has none.
    [[nodiscard]] double at(const PositionDeg& position) const {
        if (!_transformation) return 0.0;
        double x = std::remainder(position.longitudeDeg, 360.0);
        double y = std::clamp(position.latitudeDeg, -90.0, 90.0);
        double z = 0.0;
        if (_transformation->Transform(1, &x, &y, &z) == 0 || !std::isfinite(z))
            throw Failure("PROJ finds no height of " + _what + " at latitude " + std::to_string(position.latitudeDeg) +
                          ", longitude " + std::to_string(position.longitudeDeg) + kAdvice);
        return z;
    }

private:
    static constexpr const char* kAdvice =
        "; install the package proj-data, or see --geoid (none takes heights as they are)";

    std::string _what;
    std::unique_ptr<OGRCoordinateTransformation> _transformation;
};

namespace {

/// Posts along the side of a block of a layer.
constexpr int kBlock = 256;
// Posts across a narrow void, at most.
constexpr int kWidest = 16;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr GByte kYes = 255;
// Passes of GDAL's 3 x 3 mean over interpolated posts; each widens by one post what a height depends on.
constexpr int kSmoothing = 4;
// What is read around a block: all that the posts at its edge depend on.
constexpr int kBorder = kWidest + kSmoothing + 1;

void require(CPLErr error) {
    if (error != CE_None) throw Failure("cannot fill missing heights: " + gdalMessage());
}

/// A square of posts as a raster of GDAL's, which works in their memory.
template <class Number>
GdalDataset planeOf(std::vector<Number>& numbers, int width, GDALDataType type) {
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
    const int height = static_cast<int>(numbers.size()) / width;
    GdalDataset plane(driver == nullptr ? nullptr : driver->Create("", width, height, 0, type, nullptr));
    CPLStringList words;
    words.SetNameValue("DATAPOINTER", CPLSPrintf("%p", static_cast<void*>(numbers.data())));
    require(plane ? plane->AddBand(type, words.List()) : CE_Failure);
    return plane;
}

/// Whether posts are farther away than `reach` from all that are marked.
std::vector<GByte> farFrom(std::vector<GByte> marks, int width, int reach) {
    std::vector<GByte> isFar(marks.size());
    const GdalDataset marked = planeOf(marks, width, GDT_Byte);
    const GdalDataset result = planeOf(isFar, width, GDT_Byte);
    CPLStringList options(
        CSLTokenizeString(CPLSPrintf("VALUES=%d MAXDIST=%d FIXED_BUF_VAL=0 NODATA=%d", kYes, reach, kYes)));
    require(GDALComputeProximity(marked->GetRasterBand(1), result->GetRasterBand(1), options.List(), nullptr, nullptr));
    return isFar;
}

}  // namespace

/// One layer of elevation rasters. Not for use by several threads: each has its own.
class DemSource final {
public:
    /// Part of a layer, at a fixed place.
    struct Block {
        [[nodiscard]] std::size_t place(int column, int row) const noexcept {
            return static_cast<std::size_t>((row - window.row) * window.width + column - window.column);
        }

        PixelWindow window;
        /// NaN where they are missing.
        std::vector<double> heights;
        /// What stands in their place, once one of those was asked for.
        std::vector<float> fill;
    };

    /// The blocks of all layers that were read last; once there are too many, all are forgotten.
    struct Blocks {
        std::size_t most;
        /// By layer, first column and first row.
        std::map<std::tuple<const DemSource*, int, int>, std::shared_ptr<Block>> blocks;
    };

    /// `blocks`: the memory that it shares with other layers.
    DemSource(std::unique_ptr<RasterLayer> layer, const std::string& geoid, std::shared_ptr<Blocks> blocks)
        : _layer(std::move(layer)),
          _shift(_layer->file().vertical, geoid, _layer->file().input.path),
          _blocks(std::move(blocks)) {}
    DemSource(const DemSource&) = delete;
    DemSource& operator=(const DemSource&) = delete;

    [[nodiscard]] const RasterLayer& layer() const noexcept { return *_layer; }
    [[nodiscard]] const RasterGrid& grid() const noexcept { return _layer->grid(); }
    [[nodiscard]] const VerticalShift& shift() const noexcept { return _shift; }

    /// Above the ellipsoid at a position, bilinear between posts; in place of those in wide voids stands the mean of
    /// the others. Returns: nullopt where no post around has data.
    [[nodiscard]] std::optional<FoundHeight> height(const PositionDeg& position) {
        const auto cell = grid().locate(position);
        if (!cell) return std::nullopt;
        const double u = cell->eastWeight;
        const double v = cell->secondWeight;
        struct Corner {
            int column, row;
            double weight, height = 0.0;
        };
        std::array<Corner, 4> corners{{{cell->west, cell->first, (1.0 - u) * (1.0 - v)},
                                       {cell->east, cell->first, u * (1.0 - v)},
                                       {cell->west, cell->second, (1.0 - u) * v},
                                       {cell->east, cell->second, u * v}}};
        FoundHeight result;
        double sum = 0.0;
        double weights = 0.0;
        for (Corner& corner : corners) {
            if (corner.weight == 0.0) continue;  // it is not asked for: it may be missing
            corner.height = post(corner.column, corner.row);
            if (std::isnan(corner.height)) {
                corner.height = filled(corner.column, corner.row);
                result.isFilled = result.isFilled || !std::isnan(corner.height);
            }
            if (std::isnan(corner.height)) continue;
            sum += corner.weight * corner.height;
            weights += corner.weight;
        }
        if (weights == 0.0) return std::nullopt;
        for (Corner& corner : corners)
            if (std::isnan(corner.height)) corner.height = sum / weights;
        result.metres = glm::mix(glm::mix(corners[0].height, corners[1].height, u),
                                 glm::mix(corners[2].height, corners[3].height, u), v);
        result.metres += _shift.at(position);
        return result;
    }

    /// Whether any post within the rectangle has data.
    [[nodiscard]] bool hasData(const RectDeg& rect) {
        bool isFound = false;
        forPosts(grid().inside(rect), [&](int, int, double height) {
            isFound = !std::isnan(height);
            return !isFound;
        });
        return isFound;
    }

    /// Adds the heights of all posts that have part in the rectangle, above the ellipsoid, narrow voids filled.
    /// Returns: whether the layer has heights everywhere in the rectangle.
    bool addRange(const RectDeg& rect, Interval& range) {
        bool isComplete = grid().covers(rect);
        forPosts(grid().touching(rect), [&](int column, int row, double height) {
            if (std::isnan(height)) height = filled(column, row);
            isComplete = isComplete && !std::isnan(height);
            if (!std::isnan(height)) range.expandBy(height + _shift.at(grid().position(column, row)));
            return true;
        });
        return isComplete;
    }

private:
    /// The first post of the next block.
    [[nodiscard]] static int nextBlock(int place) { return (place / kBlock + 1) * kBlock; }
    [[nodiscard]] const std::shared_ptr<Block>& blockWith(int column, int row) {
        if (_last && _last->window.contains(column, row)) return _last;
        const int west = nextBlock(column) - kBlock;
        const int first = nextBlock(row) - kBlock;
        const std::tuple place(this, west, first);
        const auto known = _blocks->blocks.find(place);
        if (known != _blocks->blocks.end()) return _last = known->second;
        osgAnalyticBin::support::throwIfStopRequested();
        const PixelWindow window{west, first, std::min(kBlock, grid().columns() - west),
                                 std::min(kBlock, grid().rows() - first)};
        std::vector<double> heights(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
        const CPLErr error = _layer->dataset().GetRasterBand(1)->RasterIO(GF_Read, west, first, window.width,
                                                                          window.height, heights.data(), window.width,
                                                                          window.height, GDT_Float64, 0, 0, nullptr);
        if (error != CE_None) throw Failure("cannot read \"" + _layer->file().input.path + "\": " + gdalMessage());
        if (_blocks->blocks.size() >= _blocks->most) _blocks->blocks.clear();
        _last = std::make_shared<Block>(Block{window, std::move(heights), {}});
        _blocks->blocks.emplace(place, _last);
        return _last;
    }
    [[nodiscard]] double post(int column, int row) {
        const Block& block = *blockWith(column, row);
        return block.heights[block.place(column, row)];
    }
    /// What stands at a post without data; NaN in a wide void.
    [[nodiscard]] double filled(int column, int row) {
        const std::shared_ptr<Block> block = blockWith(column, row);
        if (block->fill.empty()) block->fill = fillOf(block->window);
        return static_cast<double>(block->fill[block->place(column, row)]);
    }
    /// What stands in the voids of a block, row by row; NaN in wide ones. Throws Failure.
    /// Interpolates narrow voids, posts without data between posts with data, from their rims: GDALFillNodata(). A void
    /// is narrow where no disc as wide as kWidest fits in between the data; along the raster's border it is wide.
    /// Each block is filled from the posts around it, so a height depends on the raster alone and not on what was asked
    /// before.
    [[nodiscard]] std::vector<float> fillOf(const PixelWindow& block) {
        const int width = block.width + 2 * kBorder;
        std::vector<float> heights;
        for (int row = block.row - kBorder; row < block.row + block.height + kBorder; ++row) {
            for (int x = block.column - kBorder; x < block.column + block.width + kBorder; ++x) {
                const int column = grid().isGlobal() ? (x + grid().columns()) % grid().columns() : x;
                const bool isThere = column >= 0 && column < grid().columns() && row >= 0 && row < grid().rows();
                heights.push_back(isThere ? static_cast<float>(post(column, row)) : kVoid);
            }
        }
        std::vector<GByte> isKnown;
        for (const float height : heights) isKnown.push_back(std::isnan(height) ? 0 : kYes);
        if (std::find(isKnown.begin(), isKnown.end(), kYes) == isKnown.end())
            return std::vector(static_cast<std::size_t>(block.width) * static_cast<std::size_t>(block.height), kVoid);
        // Around each post that is half a void's width from all data lies a disc without data. A post that no such disc
        // reaches is in a narrow void; the jags allow for rims that follow the posts.
        constexpr int kHalf = kWidest / 2;
        constexpr int kJags = 2;
        const std::vector<GByte> isNarrow = farFrom(farFrom(isKnown, width, kHalf), width, kHalf + kJags);
        std::vector<float> values = heights;
        std::replace_if(
            values.begin(), values.end(), [](float height) { return std::isnan(height); }, 0.0F);
        const GdalDataset plane = planeOf(values, width, GDT_Float32);
        const GdalDataset mask = planeOf(isKnown, width, GDT_Byte);
        CPLStringList options(CSLTokenizeString("TEMP_FILE_DRIVER=MEM"));
        require(GDALFillNodata(plane->GetRasterBand(1), mask->GetRasterBand(1), kWidest, 0, kSmoothing, options.List(),
                               nullptr, nullptr));
        std::vector<float> result;
        for (int row = 0; row < block.height; ++row) {
            for (int column = 0; column < block.width; ++column) {
                const auto i = static_cast<std::size_t>((row + kBorder) * width + column + kBorder);
                result.push_back(isNarrow[i] == kYes ? values[i] : kVoid);
            }
        }
        return result;
    }
    /// Calls `visit(column, row, height)` for each post, block by block, as long as it returns true.
    template <typename Visit>
    void forPosts(const std::vector<PixelWindow>& windows, const Visit& visit) {
        for (const PixelWindow& window : windows) {
            const int east = window.column + window.width;
            const int south = window.row + window.height;
            for (int row = window.row; row < south; row = nextBlock(row)) {
                for (int column = window.column; column < east; column = nextBlock(column)) {
                    const std::shared_ptr<Block> block = blockWith(column, row);
                    for (int v = row; v < std::min(south, nextBlock(row)); ++v)
                        for (int u = column; u < std::min(east, nextBlock(column)); ++u)
                            if (!visit(u, v, block->heights[block->place(u, v)])) return;
                }
            }
        }
    }

    std::unique_ptr<RasterLayer> _layer;
    VerticalShift _shift;
    std::shared_ptr<Blocks> _blocks;
    std::shared_ptr<Block> _last;
};

namespace {

// Half of the memory is GDAL's cache, the other half what the threads keep.
std::size_t blocksPerThread(const Settings& settings) {
    constexpr double kFewest = 16.0;
    constexpr double kMost = 45.0;  // more save no time
    constexpr double kBytes = sizeof(double) * kBlock * kBlock;
    const double blocks = std::ldexp(0.5 * settings.memoryMib, 20) / settings.threads.value_or(1) / kBytes;
    return static_cast<std::size_t>(std::clamp(blocks, kFewest, kMost));
}

}  // namespace

DemMosaic::DemMosaic(const Settings& settings, const TileLayout* layout) {
    const auto blocks = std::make_shared<DemSource::Blocks>();
    blocks->most = blocksPerThread(settings);
    for (auto& layer : RasterLayer::elevationOf(settings, layout))
        _sources.push_back(std::make_unique<DemSource>(std::move(layer), settings.geoid, blocks));
}

DemMosaic::~DemMosaic() = default;

std::optional<FoundHeight> DemMosaic::heightFrom(std::size_t source, const PositionDeg& position) {
    for (std::size_t i = source; i < _sources.size(); ++i) {
        auto found = _sources[i]->height(position);
        if (!found) continue;
        const double own = _sources[i]->layer().band().share(position);
        if (own == 1.0) return found;
        const auto coarser = heightFrom(i + 1, position);
        if (coarser) found->metres = coarser->metres + own * (found->metres - coarser->metres);
        return found;
    }
    return std::nullopt;
}

Interval DemMosaic::range(const RectDeg& rect) {
    Interval range = Interval::none();
    bool isCovered = false;
    for (std::size_t i = 0; i < _sources.size(); ++i) {
        const bool isComplete = _sources[i]->addRange(rect, range);
        if (isComplete && !_sources[i]->layer().band().touches(rect)) return range;
        isCovered = isCovered || isComplete;
    }
    if (!isCovered) range.expandBy(0.0);
    return range;
}

bool DemMosaic::hasFinerRaster(const RectDeg& rect, double spacingDeg) const noexcept {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->grid().overlap(rect) > 0.0;
    });
}

bool DemMosaic::hasFinerData(const RectDeg& rect, double spacingDeg) {
    return std::any_of(_sources.begin(), _sources.end(), [&](const auto& source) {
        return TileLayout::isFiner(source->grid().resolutionDeg(), spacingDeg) && source->hasData(rect);
    });
}

std::vector<std::string> DemMosaic::inspect() {
    std::map<std::string, std::vector<std::string>> notes;  // each with the paths of what it is true of
    for (const auto& source : _sources) {
        const RasterFile& file = source->layer().file();
        file.requireHeights();
        for (const std::string& note : file.notes) notes[note].push_back(file.input.path);
        const VerticalShift& shift = source->shift();
        if (!shift.isNone()) notes["heights above " + shift.what() + ", converted by PROJ"].push_back(file.input.path);
    }
    std::vector<std::string> lines;
    for (const auto& [note, paths] : notes) {
        const std::string others = paths.size() > 1 ? " and " + std::to_string(paths.size() - 1) + " others" : "";
        lines.push_back("\"" + paths.front() + "\"" + others + ": " + note);
    }
    return lines;
}

double DemMosaic::finestDeg() const noexcept {
    return _sources.front()->layer().spacingDeg();
}

double DemMosaic::finestGlobalDeg() const noexcept {
    for (const auto& source : _sources)
        if (source->grid().isGlobal()) return source->grid().resolutionDeg();
    return finestDeg();
}

double DemMosaic::posts(const RectDeg& rect) const noexcept {
    double sum = 0.0;
    for (const auto& source : _sources) {
        const double resolution = source->grid().resolutionDeg();
        sum += source->grid().overlap(rect) / resolution / resolution;  // whose square may be too small for a number
    }
    return sum;
}

}  // namespace osgbindem
