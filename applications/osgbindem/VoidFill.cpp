// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "VoidFill.h"

#include <cpl_string.h>
#include <gdal_alg.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace osgbindem {

namespace {

// Posts from the rim within which posts are filled.
constexpr int kReach = 128;
// Posts across a narrow void, at most.
constexpr int kNarrow = 16;
// Passes of GDAL's 3 x 3 mean over interpolated posts; each widens by one post what a height depends on.
constexpr int kSmoothing = 20;
// What is read around a block: at its corners a void's rim and smoothing still find all that they depend on.
constexpr int kBorder = kReach + kSmoothing + 1;
static_assert(VoidFill::kBlock + kBorder <= VoidFill::kMostReach);
// In the sea a difference fades out within this many posts; it does so less and less up to a height in metres.
constexpr double kSeaReach = 8.0;
constexpr double kCoastHeight = 100.0;

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();

void require(CPLErr error, const char* what) {
    if (error != CE_None) throw Failure(std::string("cannot ") + what + " around missing heights: " + gdalMessage());
}

/// Numbers as a raster of GDAL's, which works in their memory.
GdalDataset planeOf(int width, int height, GDALDataType type, void* numbers) {
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
    GdalDataset plane(driver == nullptr ? nullptr : driver->Create("", width, height, 0, type, nullptr));
    if (!plane) throw Failure("no memory to fill missing heights: " + gdalMessage());
    CPLStringList words;
    words.SetNameValue("DATAPOINTER", CPLSPrintf("%p", numbers));
    require(plane->AddBand(type, words.List()), "work");
    return plane;
}

/// Interpolates `values` where `isKnown` is 0 from where it is not.
void interpolate(int width, int height, std::vector<float>& values, std::vector<GByte>& isKnown, double reach) {
    const GdalDataset plane = planeOf(width, height, GDT_Float32, values.data());
    const GdalDataset mask = planeOf(width, height, GDT_Byte, isKnown.data());
    CPLStringList options(CSLTokenizeString("TEMP_FILE_DRIVER=MEM"));
    require(GDALFillNodata(plane->GetRasterBand(1), mask->GetRasterBand(1), reach, 0, kSmoothing, options.List(),
                           nullptr, nullptr),
            "interpolate");
}

/// Posts to the nearest one with data; more than kReach where that is farther.
std::vector<float> distancesTo(std::vector<GByte> isKnown, int width, int height) {
    std::vector<float> distances(isKnown.size());
    const GdalDataset known = planeOf(width, height, GDT_Byte, isKnown.data());
    const GdalDataset distance = planeOf(width, height, GDT_Float32, distances.data());
    CPLStringList options(CSLTokenizeString("VALUES=255 NODATA=100000"));
    options.SetNameValue("MAXDIST", std::to_string(kReach).c_str());
    require(GDALComputeProximity(known->GetRasterBand(1), distance->GetRasterBand(1), options.List(), nullptr, nullptr),
            "measure");
    return distances;
}

/// 1 up to `from`, 0 from `to` on, smooth between them.
double fade(double value, double from, double to) {
    return glm::smoothstep(to, from, value);
}

/// A block with the posts around it, as far as what is in the block depends on them.
class Window final {
public:
    Window(const VoidFill& fill, const PixelWindow& block)
        : _fill(fill),
          _block(block),
          _width(fill.layer.grid().columns()),
          _turns(fill.layer.grid().isGlobal() ? 1 : 0) {
        // One column and row beyond the raster's border, where nothing is known either, stand for all that lie there.
        const int most = _turns > 0 ? _width : 1;
        const int rows = fill.layer.grid().rows();
        const int west = std::max(block.column - kBorder, -most);
        const int first = std::max(block.row - kBorder, -1);
        _posts = {west, first, std::min(block.column + block.width + kBorder, _width + most) - west,
                  std::min(block.row + block.height + kBorder, rows + 1) - first};
        const auto count = static_cast<std::size_t>(_posts.width) * static_cast<std::size_t>(_posts.height);
        _heights.assign(count, std::numeric_limits<double>::quiet_NaN());
        _kinds.assign(count, Kind::Outside);
        findKinds();
    }

    [[nodiscard]] VoidFill::Block filled() {
        const std::vector<GByte> isKnown = known();
        if (std::find(isKnown.begin(), isKnown.end(), 255) == isKnown.end()) return {};
        const std::vector<float> distances = distancesTo(isKnown, _posts.width, _posts.height);
        sortVoids(distances);
        std::vector<float> narrow;
        std::vector<float> wide;
        VoidFill::Block result;
        forPosts(_block, [&](int x, int y, std::size_t i) {
            const Kind kind = _kinds[i];
            result.isRival.push_back(kind == Kind::Rival);
            float& height = result.heights.emplace_back(kVoid);
            if (kind == Kind::Rival) height = static_cast<float>(_heights[i]);
            if (kind == Kind::Narrow) {
                if (narrow.empty()) narrow = interpolated();
                height = narrow[i];
            }
            if (kind != Kind::Wide || !_fill.coarser || distances[i] >= kReach) return;
            if (wide.empty()) wide = differences();
            const double coarser = coarserAt(x, y).metres;
            const double onLand = fade(distances[i], 0.5 * kReach, kReach);
            const double inSea = fade(distances[i], 0.0, kSeaReach);
            const double share = inSea + (onLand - inSea) * (1.0 - fade(coarser, 0.0, kCoastHeight));
            height = static_cast<float>(coarser + share * wide[i]);
        });
        return result;
    }

private:
    enum class Kind : char { Data, Rival, Outside, Narrow, Wide };

    [[nodiscard]] std::size_t index(int x, int y) const noexcept {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(_posts.width) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] bool isVoid(std::size_t i) const noexcept { return _kinds[i] >= Kind::Narrow; }

    /// Calls `visit(x, y, index)` for each post of a rectangle that is within the window.
    template <typename Visit>
    void forPosts(const PixelWindow& rect, const Visit& visit) const {
        const int south = std::min(rect.row + rect.height - _posts.row, _posts.height);
        const int east = std::min(rect.column + rect.width - _posts.column, _posts.width);
        for (int y = std::max(rect.row - _posts.row, 0); y < south; ++y)
            for (int x = std::max(rect.column - _posts.column, 0); x < east; ++x) visit(x, y, index(x, y));
    }
    template <typename Visit>
    [[nodiscard]] bool hasNear(int x, int y, const Visit& is) const {
        bool result = false;
        forPosts({_posts.column + x - 1, _posts.row + y - 1, 3, 3},
                 [&](int u, int v, std::size_t i) { result = is(u, v, i) || result; });
        return result;
    }
    /// Round the globe, where the raster goes round it.
    [[nodiscard]] int columnOf(int x) const noexcept {
        const int column = _posts.column + x;
        return _turns > 0 ? (column + _width) % _width : column;
    }
    [[nodiscard]] FoundHeight coarserAt(int x, int y) const { return _fill.coarser(columnOf(x), _posts.row + y); }

    void findKinds() {
        const PixelWindow raster{-_turns * _width, 0, (2 * _turns + 1) * _width, _fill.layer.grid().rows()};
        forPosts(raster, [&](int x, int y, std::size_t i) {
            _heights[i] = _fill.post(columnOf(x), _posts.row + y);
            if (!std::isnan(_heights[i])) _kinds[i] = Kind::Data;
        });
        for (const RasterLayer::Member& member : _fill.layer.members()) {
            for (PixelWindow part : _fill.layer.grid().inside(member.grid.extent())) {
                part.column -= _turns * _width;
                for (int turn = -_turns; turn <= _turns; ++turn, part.column += _width) findVoids(part);
            }
        }
    }

    /// In a part of the window where one of the layer's rasters is.
    void findVoids(const PixelWindow& part) {
        forPosts(part, [&](int x, int y, std::size_t i) {
            if (_kinds[i] != Kind::Outside) return;
            const FoundHeight coarser = _fill.hasRivals ? coarserAt(x, y) : FoundHeight();
            _kinds[i] = coarser.isRival ? Kind::Rival : Kind::Narrow;
            if (coarser.isRival) _heights[i] = coarser.metres;
        });
    }

    [[nodiscard]] std::vector<GByte> known() const {
        std::vector<GByte> isKnown(_kinds.size());
        std::transform(_kinds.begin(), _kinds.end(), isKnown.begin(),
                       [](Kind kind) { return static_cast<GByte>(kind <= Kind::Rival ? 255 : 0); });
        return isKnown;
    }

    /// Tells narrow voids from wide ones. Those along the raster's border are wide.
    /// `distances`: posts to the nearest one with data.
    void sortVoids(const std::vector<float>& distances) {
        std::vector<bool> isSeen(_kinds.size(), false);
        forPosts(_posts, [&](int startX, int startY, std::size_t start) {
            constexpr std::size_t kMostAtBorder = 4;  // one post of so many
            if (!isVoid(start) || isSeen[start]) return;
            std::vector<std::pair<int, int>> found{{startX, startY}};
            isSeen[start] = true;
            bool isNarrow = true;
            std::size_t atBorder = 0;
            for (std::size_t next = 0; next < found.size(); ++next) {
                const auto [x, y] = found[next];
                isNarrow = isNarrow && distances[index(x, y)] <= 0.5F * kNarrow;
                const bool isAtBorder = hasNear(x, y, [&](int u, int v, std::size_t i) {
                    if (isVoid(i) && !isSeen[i]) {
                        isSeen[i] = true;
                        found.emplace_back(u, v);
                    }
                    return _kinds[i] == Kind::Outside;
                });
                if (isAtBorder) ++atBorder;
            }
            if (isNarrow && kMostAtBorder * atBorder <= found.size()) return;
            for (const auto& [x, y] : found) _kinds[index(x, y)] = Kind::Wide;
        });
    }

    /// The heights with narrow voids interpolated.
    [[nodiscard]] std::vector<float> interpolated() const {
        std::vector<float> values(_heights.begin(), _heights.end());
        std::vector<GByte> isKnown(values.size(), 255);
        for (std::size_t i = 0; i < values.size(); ++i) {
            // Wide voids touch no narrow one, so what they hold is of no account.
            if (std::isnan(values[i])) values[i] = 0.0F;
            if (_kinds[i] == Kind::Narrow || _kinds[i] == Kind::Outside) isKnown[i] = 0;
        }
        interpolate(_posts.width, _posts.height, values, isKnown, kNarrow);
        return values;
    }

    /// Those of the heights from what coarser rasters have, interpolated from the rims of wide voids.
    [[nodiscard]] std::vector<float> differences() const {
        std::vector<float> result(_heights.size(), 0.0F);
        std::vector<GByte> isKnown = known();
        const auto isMissing = [&](int, int, std::size_t i) { return std::isnan(_heights[i]); };
        forPosts(_posts, [&](int x, int y, std::size_t i) {
            if (_kinds[i] == Kind::Outside) isKnown[i] = 255;
            if (isMissing(x, y, i) || !hasNear(x, y, isMissing)) return;
            // Where the coarser rasters have nothing the difference is interpolated too; beyond the border it is 0.
            const double difference = _heights[i] - coarserAt(x, y).metres;
            isKnown[i] = std::isnan(difference) ? 0 : 255;
            if (isKnown[i] != 0) result[i] = static_cast<float>(difference);
        });
        interpolate(_posts.width, _posts.height, result, isKnown, kReach);
        return result;
    }

    const VoidFill& _fill;
    PixelWindow _block;
    int _width;
    /// Round the globe, to either side.
    int _turns;
    /// Columns may lie outside of the raster by one turn of the globe.
    PixelWindow _posts;
    std::vector<double> _heights;
    /// Of each post. What is missing is beyond the raster's border, or in a void.
    std::vector<Kind> _kinds;
};

}  // namespace

VoidFill::Block VoidFill::filled(const PixelWindow& block) const {
    return Window(*this, block).filled();
}

}  // namespace osgbindem
