// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TestRaster.h"

#include <array>

/// Red, green, blue.
using Colour = std::array<int, 3>;

/// How a file says that it has no pixel somewhere.
enum class Hole { Alpha, Mask, Nodata, Palette };

/// An image, square degree by square degree: `pixels` by `pixels` from the north-west corner on.
struct TestImage {
    TestImage(double westDeg, double northDeg, double pixelDeg, int side, const Colour& colour)
        : west(westDeg), north(northDeg), spacingDeg(pixelDeg), pixels(side) {
        colourAt = [colour](double, double) { return colour; };
    }

    /// Round the globe: twice as many columns as rows.
    [[nodiscard]] static TestImage globe(double spacingDeg, const Colour& colour) {
        return {-180.0, 90.0, spacingDeg, static_cast<int>(std::lround(360.0 / spacingDeg)), colour};
    }

    /// Writes a file. Returns: its path.
    std::string write(const std::string& path) const {
        constexpr int kNodata = 7;
        const int rows = std::min(pixels, static_cast<int>(std::lround((north + 90.0) / spacingDeg)));
        Bands bands;
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < pixels; ++column) {
                const auto colour = colourAt(north - (row + 0.5) * spacingDeg, west + (column + 0.5) * spacingDeg);
                for (std::size_t c = 0; c < 3; ++c) bands[c].push_back(colour ? (*colour)[c] : kNodata);
                bands[3].push_back(colour ? 255 : 0);
            }
        }
        CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
        const int count = hole == Hole::Palette ? 1 : hole == Hole::Alpha ? 4 : 3;
        const OpenRaster file(path, {pixels, rows, count}, GDT_Byte, west, north, spacingDeg, spacingDeg);
        if (hole == Hole::Alpha) file.band(4).SetColorInterpretation(GCI_AlphaBand);
        if (hole == Hole::Mask) file->CreateMaskBand(GMF_PER_DATASET);
        if (hole == Hole::Palette) writePalette(file.band(), bands);
        for (int band = 1; band <= 3 && hole != Hole::Palette; ++band) {
            if (hole == Hole::Nodata) file.band(band).SetNoDataValue(kNodata);
            OpenRaster::write(file.band(band), bands[static_cast<std::size_t>(band - 1)]);
        }
        if (hole == Hole::Alpha) OpenRaster::write(file.band(4), bands[3]);
        if (hole == Hole::Mask) OpenRaster::write(*file.band().GetMaskBand(), bands[3]);
        return path;
    }

    double west, north, spacingDeg;
    int pixels;
    /// nullopt: a hole. With a palette there is one colour.
    std::function<std::optional<Colour>(double latitudeDeg, double longitudeDeg)> colourAt;
    Hole hole = Hole::Alpha;

private:
    using Bands = std::array<std::vector<double>, 4>;

    /// Index 1 is the colour, index 0 the hole.
    static void writePalette(GDALRasterBand& band, const Bands& bands) {
        std::vector<double> indices;
        GDALColorTable table;
        for (std::size_t i = 0; i < bands[3].size(); ++i) {
            indices.push_back(bands[3][i] > 0 ? 1 : 0);
            const auto part = [&](std::size_t c) { return static_cast<short>(bands[c][i]); };
            const GDALColorEntry entry{part(0), part(1), part(2), 255};
            if (indices.back() == 1) table.SetColorEntry(1, &entry);
        }
        band.SetNoDataValue(0.0);
        band.SetColorTable(&table);
        OpenRaster::write(band, indices);
    }
};
