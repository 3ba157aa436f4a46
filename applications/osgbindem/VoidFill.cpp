// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "VoidFill.h"

#include "Gdal.h"

#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr GByte kYes = 255;
// Passes of GDAL's 3 x 3 mean over interpolated posts; each widens by one post what a height depends on.
constexpr int kSmoothing = 4;
// What is read around a block: all that the posts at its edge depend on.
constexpr int kBorder = VoidFill::kWidest + kSmoothing + 1;

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

std::vector<float> VoidFill::filled(const PixelWindow& block) const {
    const int width = block.width + 2 * kBorder;
    std::vector<float> heights;
    for (int row = block.row - kBorder; row < block.row + block.height + kBorder; ++row) {
        for (int x = block.column - kBorder; x < block.column + block.width + kBorder; ++x) {
            const int column = grid.isGlobal() ? (x + grid.columns()) % grid.columns() : x;
            const bool isThere = column >= 0 && column < grid.columns() && row >= 0 && row < grid.rows();
            heights.push_back(isThere ? static_cast<float>(post(column, row)) : kVoid);
        }
    }
    std::vector<GByte> isKnown;
    for (const float height : heights) isKnown.push_back(std::isnan(height) ? 0 : kYes);
    if (std::find(isKnown.begin(), isKnown.end(), kYes) == isKnown.end())
        return std::vector(static_cast<std::size_t>(block.width) * static_cast<std::size_t>(block.height), kVoid);
    // Discs fit in between the data where posts are far from it. What they do not reach is narrow, a rim apart that is
    // jagged by posts.
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

}  // namespace osgbindem
