// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "HeightDataset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace osgbindem {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

HeightDataset::HeightDataset(GDALRasterBand& numbers, const HeightCode& code, const OGRSpatialReference* horizontal)
    : _source(*numbers.GetDataset()) {
    if (horizontal != nullptr) _horizontal = *horizontal;
    // GDAL's mosaics open what has no driver by its name, once more.
    poDriver = GetGDALDriverManager()->GetDriverByName("VRT");
    nRasterXSize = numbers.GetXSize();
    nRasterYSize = numbers.GetYSize();
    SetBand(1, new HeightBand(*this, numbers, code));
}

HeightBand& HeightDataset::heights() {
    return *static_cast<HeightBand*>(GetRasterBand(1));
}

HeightBand::HeightBand(HeightDataset& dataset, GDALRasterBand& numbers, const HeightCode& code)
    : _numbers(numbers), _code(code), _isSingle(numbers.GetRasterDataType() == GDT_Float32) {
    poDS = &dataset;
    nBand = 1;
    eDataType = GDT_Float64;
    nRasterXSize = numbers.GetXSize();
    nRasterYSize = numbers.GetYSize();
    numbers.GetBlockSize(&nBlockXSize, &nBlockYSize);
}

double HeightBand::GetNoDataValue(int* hasNodata) {
    if (hasNodata != nullptr) *hasNodata = TRUE;
    return kMissing;
}

CPLErr HeightBand::IReadBlock(int column, int row, void* data) {
    const int x = column * nBlockXSize;
    const int y = row * nBlockYSize;
    const int width = std::min(nBlockXSize, nRasterXSize - x);
    const int height = std::min(nBlockYSize, nRasterYSize - y);
    constexpr GSpacing kSize = sizeof(double);
    return IRasterIO(GF_Read, x, y, width, height, data, width, height, GDT_Float64, kSize, kSize * nBlockXSize,
                     nullptr);
}

CPLErr HeightBand::IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns, int rows,
                             GDALDataType type, GSpacing pixelSpace, GSpacing lineSpace, GDALRasterIOExtraArg* extra) {
    const bool isNearest = extra == nullptr || extra->eResampleAlg == GRIORA_NearestNeighbour;
    const bool isDense = type == GDT_Float64 && pixelSpace == static_cast<GSpacing>(sizeof(double));
    if (flag != GF_Read || !isNearest || !isDense) {
        return GDALRasterBand::IRasterIO(flag, x, y, width, height, data, columns, rows, type, pixelSpace, lineSpace,
                                         extra);
    }
    const CPLErr error = _numbers.RasterIO(GF_Read, x, y, width, height, data, columns, rows, GDT_Float64, pixelSpace,
                                           lineSpace, nullptr);
    std::vector<unsigned char> mask;
    if (error == CE_None && _code.mask != nullptr) {
        mask.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
        const CPLErr maskError =
            _code.mask->RasterIO(GF_Read, x, y, width, height, mask.data(), columns, rows, GDT_Byte, 0, 0, nullptr);
        if (maskError != CE_None) return maskError;
    }
    for (int row = 0; error == CE_None && row < rows; ++row) {
        auto* line = reinterpret_cast<double*>(static_cast<char*>(data) + row * lineSpace);
        decode(line, mask.empty() ? nullptr : mask.data() + static_cast<std::ptrdiff_t>(row) * columns, columns);
    }
    return error;
}

void HeightBand::decode(double* line, const unsigned char* mask, int count) {
    const float nodata = static_cast<float>(_code.nodata.value_or(0.0));
    for (int i = 0; i < count; ++i) {
        const double number = line[i];
        const bool isMissing =
            (_code.nodata && (number == *_code.nodata || (_isSingle && static_cast<float>(number) == nodata))) ||
            (mask != nullptr && mask[i] == 0);
        const double metres = number * _code.scale + _code.offset;
        const bool isHeight = std::abs(metres) <= _code.highest;
        line[i] = isMissing || !isHeight ? kMissing : metres;
        if (isMissing || isHeight || std::isnan(number)) continue;
        ++_marks;
        _lastMark = number;
    }
}

}  // namespace osgbindem
