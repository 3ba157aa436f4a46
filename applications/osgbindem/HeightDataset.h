// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <optional>

namespace osgbindem {

/// How the numbers of a band become metres.
struct HeightCode {
    std::optional<double> nodata;
    double scale = 1.0;
    double offset = 0.0;
    /// Numbers beyond are marks for missing heights that the file does not declare.
    double highest = 0.0;
    /// 0 where heights are missing; nullptr without one.
    GDALRasterBand* mask = nullptr;
};

class HeightBand;

/// One band of a raster in metres, with NaN for missing heights, so that whatever is made of it mixes no mark for
/// missing data with heights. Its reference system has no vertical part.
class HeightDataset final : public GDALDataset {
public:
    /// `numbers`: has to last as long.
    HeightDataset(GDALRasterBand& numbers, const HeightCode& code, const OGRSpatialReference* horizontal);

    [[nodiscard]] HeightBand& heights();

    CPLErr GetGeoTransform(double* transform) override { return _source.GetGeoTransform(transform); }
    const OGRSpatialReference* GetSpatialRef() const override { return _horizontal.IsEmpty() ? nullptr : &_horizontal; }
    int GetGCPCount() override { return _source.GetGCPCount(); }
    const OGRSpatialReference* GetGCPSpatialRef() const override { return GetSpatialRef(); }
    const GDAL_GCP* GetGCPs() override { return _source.GetGCPs(); }

private:
    GDALDataset& _source;
    OGRSpatialReference _horizontal;
};

class HeightBand final : public GDALRasterBand {
public:
    HeightBand(HeightDataset& dataset, GDALRasterBand& numbers, const HeightCode& code);

    double GetNoDataValue(int* hasNodata) override;

    /// Numbers that were taken for marks since the band was opened, and the last of them.
    [[nodiscard]] double marks() const noexcept { return _marks; }
    [[nodiscard]] double lastMark() const noexcept { return _lastMark; }

protected:
    CPLErr IReadBlock(int column, int row, void* data) override;
    CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns, int rows,
                     GDALDataType type, GSpacing pixelSpace, GSpacing lineSpace, GDALRasterIOExtraArg* extra) override;

private:
    void decode(double* line, const unsigned char* mask, int count);

    GDALRasterBand& _numbers;
    HeightCode _code;
    bool _isSingle;
    double _marks = 0.0;
    double _lastMark = 0.0;
};

}  // namespace osgbindem
