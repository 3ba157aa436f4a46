// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "VoidFill.h"

#include "Failure.h"
#include "Interruption.h"

#include <cpl_string.h>
#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::Failure;
using osgAnalyticBin::support::throwIfStopRequested;

namespace {

constexpr int kVoidBlock = 256;
// Passes of GDAL's 3 x 3 mean over interpolated posts; each widens by one post what a height depends on.
constexpr int kSmoothing = 20;
// What is read around a block: at its corners a void's rim and smoothing still find all that they depend on.
constexpr int kBorder = VoidFill::kReach + kSmoothing + 1;
static_assert(kVoidBlock + kBorder <= VoidFill::kMostReach);
// Blocks kept in memory, 256 KiB each.
constexpr std::size_t kMostHeld = 24;
// In the sea a difference fades out within this many posts; it does so less and less up to a height in metres.
constexpr double kSeaReach = 8.0;
constexpr double kCoastHeight = 100.0;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

void require(CPLErr error, const char* what) {
    if (error != CE_None) throw Failure(std::string("cannot ") + what + " around missing heights: " + gdalMessage());
}

/// A raster of one band in memory.
class Plane {
public:
    Plane(int width, int height, GDALDataType type) : _width(width), _height(height) {
        GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
        _dataset.reset(driver == nullptr ? nullptr : driver->Create("", width, height, 1, type, nullptr));
        if (!_dataset) throw Failure("no memory to fill missing heights: " + gdalMessage());
    }

    [[nodiscard]] GDALRasterBandH band() const { return GDALRasterBand::ToHandle(_dataset->GetRasterBand(1)); }

    template <typename Number>
    void write(std::vector<Number>& values, GDALDataType type) const {
        transfer(GF_Write, values, type);
    }
    void read(std::vector<float>& values) const { transfer(GF_Read, values, GDT_Float32); }

private:
    template <typename Number>
    void transfer(GDALRWFlag flag, std::vector<Number>& values, GDALDataType type) const {
        require(GDALRasterIO(band(), flag, 0, 0, _width, _height, values.data(), _width, _height, type, 0, 0), "copy");
    }

    int _width;
    int _height;
    GdalDataset _dataset;
};

/// Interpolates `values` where `isKnown` is 0 from where it is not.
void interpolate(int width, int height, std::vector<float>& values, std::vector<GByte>& isKnown, double reach) {
    const Plane plane(width, height, GDT_Float32);
    const Plane mask(width, height, GDT_Byte);
    plane.write(values, GDT_Float32);
    mask.write(isKnown, GDT_Byte);
    CPLStringList options(CSLTokenizeString("TEMP_FILE_DRIVER=MEM"));
    require(GDALFillNodata(plane.band(), mask.band(), reach, 0, kSmoothing, options.List(), nullptr, nullptr),
            "interpolate");
    plane.read(values);
}

/// Posts to the nearest one with data; more than kReach where that is farther.
std::vector<float> distancesTo(const std::vector<GByte>& isKnown, int width, int height) {
    const Plane known(width, height, GDT_Byte);
    const Plane distance(width, height, GDT_Float32);
    std::vector<GByte> copy(isKnown);
    known.write(copy, GDT_Byte);
    CPLStringList options(CSLTokenizeString("VALUES=255 NODATA=100000"));
    options.SetNameValue("MAXDIST", std::to_string(VoidFill::kReach).c_str());
    require(GDALComputeProximity(known.band(), distance.band(), options.List(), nullptr, nullptr), "measure");
    std::vector<float> distances(isKnown.size());
    distance.read(distances);
    return distances;
}

/// 1 up to `from`, 0 from `to` on, smooth between them.
double fade(double value, double from, double to) {
    const double share = std::clamp((to - value) / (to - from), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

}  // namespace

/// A block with the posts around it, as far as what is in the block depends on them.
struct VoidFill::Window {
    /// Columns may be beyond the raster's by a turn of the globe.
    PixelWindow posts;
    PixelWindow block;
    std::vector<double> heights;
    /// Of each post: beyond the raster's border, and that of a void too wide to be interpolated.
    std::vector<bool> isOutside;
    std::vector<bool> isWide;
    /// Of each post: that of a rival's height.
    std::vector<bool> isRival;

    [[nodiscard]] std::size_t index(int x, int y) const noexcept {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(posts.width) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] bool isMissing(int x, int y) const noexcept { return std::isnan(heights[index(x, y)]); }

    [[nodiscard]] bool isVoid(int x, int y) const noexcept { return isMissing(x, y) && !isOutside[index(x, y)]; }

    /// Calls `visit(x, y, i)` for each missing post of the block within the raster, `i` counting the block's posts.
    template <typename Visit>
    void forMissing(const Visit& visit) const {
        std::size_t i = 0;
        for (int row = block.row; row < block.row + block.height; ++row) {
            for (int column = block.column; column < block.column + block.width; ++column, ++i) {
                const int x = column - posts.column;
                const int y = row - posts.row;
                if (isVoid(x, y)) visit(x, y, i);
            }
        }
    }

    [[nodiscard]] std::vector<GByte> known() const {
        std::vector<GByte> isKnown(heights.size());
        std::transform(heights.begin(), heights.end(), isKnown.begin(),
                       [](double height) { return static_cast<GByte>(std::isnan(height) ? 0 : 255); });
        return isKnown;
    }

    /// Tells narrow voids from wide ones. Those along the raster's border are wide.
    /// `distances`: posts to the nearest one with data.
    void sortVoids(const std::vector<float>& distances) {
        isWide.assign(heights.size(), false);
        std::vector<bool> isSeen(heights.size(), false);
        for (int y = 0; y < posts.height; ++y) {
            for (int x = 0; x < posts.width; ++x) {
                if (isVoid(x, y) && !isSeen[index(x, y)]) sortVoid(x, y, isSeen, distances);
            }
        }
    }

private:
    void sortVoid(int startX, int startY, std::vector<bool>& isSeen, const std::vector<float>& distances) {
        constexpr std::size_t kMostAtBorder = 4;  // one post of so many
        std::vector<std::pair<int, int>> found{{startX, startY}};
        isSeen[index(startX, startY)] = true;
        bool isNarrow = true;
        std::size_t atBorder = 0;
        for (std::size_t next = 0; next < found.size(); ++next) {
            const auto [x, y] = found[next];
            isNarrow = isNarrow && distances[index(x, y)] <= 0.5F * kNarrow;
            bool isAtBorder = false;
            for (int v = std::max(0, y - 1); v <= std::min(posts.height - 1, y + 1); ++v) {
                for (int u = std::max(0, x - 1); u <= std::min(posts.width - 1, x + 1); ++u) {
                    isAtBorder = isAtBorder || isOutside[index(u, v)];
                    if (!isVoid(u, v) || isSeen[index(u, v)]) continue;
                    isSeen[index(u, v)] = true;
                    found.emplace_back(u, v);
                }
            }
            if (isAtBorder) ++atBorder;
        }
        if (isNarrow && kMostAtBorder * atBorder <= found.size()) return;
        for (const auto& [x, y] : found) isWide[index(x, y)] = true;
    }
};

VoidFill::Below VoidFill::at(int column, int row) {
    const int blocksPerRow = (_width + kVoidBlock - 1) / kVoidBlock;
    const PixelWindow block{column / kVoidBlock * kVoidBlock, row / kVoidBlock * kVoidBlock,
                            std::min(kVoidBlock, _width - column / kVoidBlock * kVoidBlock),
                            std::min(kVoidBlock, _height - row / kVoidBlock * kVoidBlock)};
    const int number = row / kVoidBlock * blocksPerRow + column / kVoidBlock;
    auto found = _blocks.find(number);
    if (found == _blocks.end()) {
        throwIfStopRequested();
        if (_held >= kMostHeld) {
            for (auto it = _blocks.begin(); it != _blocks.end();)
                it = it->second.heights.empty() ? std::next(it) : _blocks.erase(it);
            _held = 0;
        }
        found = _blocks.emplace(number, filled(block)).first;
        if (!found->second.heights.empty()) ++_held;
    }
    if (found->second.heights.empty()) return {};
    const auto post = static_cast<std::size_t>((row - block.row) * block.width + column - block.column);
    return {found->second.heights[post], found->second.isRival[post]};
}

void VoidFill::read(Window& window) const {
    const PixelWindow& block = window.block;
    PixelWindow& posts = window.posts;
    // One column and row beyond the raster's border, where nothing is known either, stand for all that lie there.
    const int west = isGlobal() ? block.column - kBorder : std::max(block.column - kBorder, -1);
    const int east =
        isGlobal() ? block.column + block.width + kBorder : std::min(block.column + block.width + kBorder, _width + 1);
    const int first = std::max(block.row - kBorder, -1);
    const int last = std::min(block.row + block.height + kBorder, _height + 1);
    posts = {west, first, east - west, last - first};
    window.heights.assign(static_cast<std::size_t>(posts.width) * static_cast<std::size_t>(posts.height),
                          std::numeric_limits<double>::quiet_NaN());
    const int firstInside = std::max(first, 0);
    const int rows = std::min(last, _height) - firstInside;
    std::vector<double> part;
    for (int column = west; column < east;) {
        const int inside = inRaster(column);
        if (inside < 0 || inside >= _width) {
            ++column;
            continue;
        }
        const int width = std::min(east - column, _width - inside);
        _read({inside, firstInside, width, rows}, part);
        for (int row = 0; row < rows; ++row) {
            const auto from = part.begin() + static_cast<std::ptrdiff_t>(row) * width;
            std::copy(from, from + width,
                      window.heights.begin() +
                          static_cast<std::ptrdiff_t>(window.index(column - west, firstInside - first + row)));
        }
        column += width;
    }
}

void VoidFill::findOutside(Window& window) const {
    const PixelWindow& posts = window.posts;
    window.isOutside.assign(window.heights.size(), true);
    for (const RasterLayer::Member& member : _layer.members()) {
        const PixelWindow& part = member.window;
        const int turns = isGlobal() ? 1 : 0;
        for (int turn = -turns; turn <= turns; ++turn) {
            const int column = part.column + turn * _width;
            const int west = std::max(column - posts.column, 0);
            const int east = std::min(column + part.width - posts.column, posts.width);
            const int first = std::max(part.row - posts.row, 0);
            const int last = std::min(part.row + part.height - posts.row, posts.height);
            for (int y = first; y < last; ++y)
                for (int x = west; x < east; ++x) window.isOutside[window.index(x, y)] = false;
        }
    }
}

void VoidFill::takeRivals(Window& window) const {
    for (int y = 0; y < window.posts.height; ++y) {
        for (int x = 0; x < window.posts.width; ++x) {
            if (!window.isVoid(x, y)) continue;
            const Below below = belowAt(window, x, y);
            if (!below.isRival) continue;
            window.heights[window.index(x, y)] = below.height;
            window.isRival[window.index(x, y)] = true;
        }
    }
}

VoidFill::Block VoidFill::filled(const PixelWindow& block) const {
    Window window;
    window.block = block;
    read(window);
    window.isRival.assign(window.heights.size(), false);
    findOutside(window);
    if (_hasRivals) takeRivals(window);
    const std::vector<GByte> isKnown = window.known();
    if (std::find(isKnown.begin(), isKnown.end(), 255) == isKnown.end()) return {};
    const std::vector<float> distances = distancesTo(isKnown, window.posts.width, window.posts.height);
    window.sortVoids(distances);
    Block result;
    bool hasNarrow = false;
    bool hasWide = false;
    for (int row = block.row; row < block.row + block.height; ++row) {
        for (int column = block.column; column < block.column + block.width; ++column) {
            const std::size_t i = window.index(column - window.posts.column, row - window.posts.row);
            result.isRival.push_back(window.isRival[i]);
            result.heights.push_back(window.isRival[i] ? static_cast<float>(window.heights[i]) : kVoid);
        }
    }
    window.forMissing(
        [&](int x, int y, std::size_t) { (window.isWide[window.index(x, y)] ? hasWide : hasNarrow) = true; });
    if (hasNarrow) interpolateNarrow(window, result.heights);
    if (hasWide && _coarser) addDifferences(window, distances, result.heights);
    return result;
}

void VoidFill::interpolateNarrow(const Window& window, std::vector<float>& result) const {
    std::vector<float> values(window.heights.begin(), window.heights.end());
    std::vector<GByte> isKnown(values.size(), 255);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isnan(values[i])) continue;
        // Wide voids touch no narrow one, so what they hold is of no account.
        values[i] = 0.0F;
        if (!window.isWide[i]) isKnown[i] = 0;
    }
    interpolate(window.posts.width, window.posts.height, values, isKnown, kNarrow);
    window.forMissing([&](int x, int y, std::size_t i) {
        if (!window.isWide[window.index(x, y)]) result[i] = values[window.index(x, y)];
    });
}

VoidFill::Below VoidFill::belowAt(const Window& window, int x, int y) const {
    return _coarser(inRaster(window.posts.column + x), window.posts.row + y);
}

void VoidFill::addDifferences(const Window& window, const std::vector<float>& distances,
                              std::vector<float>& result) const {
    const int width = window.posts.width;
    const int height = window.posts.height;
    std::vector<float> differences(window.heights.size(), 0.0F);
    const auto isAtRim = [&](int x, int y) {
        for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
                if (window.isMissing(u, v)) return true;
        return false;
    };
    // Where the coarser rasters have nothing the difference is interpolated too; beyond the border it is 0.
    std::vector<GByte> isKnown = window.known();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t i = window.index(x, y);
            if (window.isOutside[i]) isKnown[i] = 255;
            if (window.isMissing(x, y) || !isAtRim(x, y)) continue;
            const double difference = window.heights[i] - belowAt(window, x, y).height;
            if (std::isnan(difference))
                isKnown[i] = 0;
            else
                differences[i] = static_cast<float>(difference);
        }
    }
    interpolate(width, height, differences, isKnown, kReach);
    window.forMissing([&](int x, int y, std::size_t i) {
        const std::size_t j = window.index(x, y);
        if (!window.isWide[j] || distances[j] >= kReach) return;
        const double coarser = belowAt(window, x, y).height;
        const double onLand = fade(distances[j], 0.5 * kReach, kReach);
        const double inSea = fade(distances[j], 0.0, kSeaReach);
        const double share = inSea + (onLand - inSea) * (1.0 - fade(coarser, 0.0, kCoastHeight));
        result[i] = static_cast<float>(coarser + share * differences[j]);
    });
}

}  // namespace osgbindem
