// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterColours.h"

#include "Failure.h"

#include <cpl_string.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

/// Numbers of the bands in the order red, green, blue, alpha, or grey, alpha.
std::vector<int> colourBands(GDALDataset& file) {
    const int count = file.GetRasterCount();
    const auto bandOf = [&](GDALColorInterp colour) {
        for (int i = 1; i <= count; ++i)
            if (file.GetRasterBand(i)->GetColorInterpretation() == colour) return i;
        return 0;
    };
    std::vector<int> bands{bandOf(GCI_RedBand), bandOf(GCI_GreenBand), bandOf(GCI_BlueBand)};
    const int alpha = bandOf(GCI_AlphaBand);
    if (std::count(bands.begin(), bands.end(), 0) > 0) {
        const int colours = alpha == 0 ? count : alpha - 1;
        bands = colours >= 3 ? std::vector{1, 2, 3} : std::vector{std::max(1, bandOf(GCI_GrayIndex))};
    }
    if (alpha != 0) bands.push_back(alpha);
    return bands;
}

/// The number that is shown at full brightness: the end of the usual range that holds the highest one.
double brightest(GDALDataset& file, const std::vector<int>& bands, const std::string& path) {
    double highest = 0.0;
    for (const int number : bands) {
        std::array<double, 2> range{};
        GDALRasterBand& band = *file.GetRasterBand(number);
        if (band.ComputeRasterMinMax(TRUE, range.data()) == CE_None) highest = std::max(highest, range[1]);
    }
    const bool isWhole = GDALDataTypeIsInteger(file.GetRasterBand(bands.front())->GetRasterDataType()) != 0;
    for (const double end : {1.0, 255.0, 1023.0, 4095.0, 16383.0, 65535.0}) {
        if (highest <= end && (end > 1.0 || !isWhole)) return end;
    }
    throw Failure("colours of \"" + path + "\" reach " + std::string(CPLSPrintf("%.9g", highest)) +
                  "; bring them to bytes, for example with gdal_translate -ot Byte -scale");
}

}  // namespace

GdalDataset coloursOf(GDALDataset& file, const std::string& path) {
    CPLStringList words(CSLTokenizeString("-of VRT -ot Byte"));
    if (file.GetRasterBand(1)->GetColorTable() != nullptr) {
        words.AddString("-expand");
        words.AddString("rgba");
    } else {
        const std::vector<int> bands = colourBands(file);
        bool isThere = bands.size() >= static_cast<std::size_t>(std::min(file.GetRasterCount(), 4));
        for (std::size_t i = 0; i < bands.size(); ++i) {
            isThere = isThere && bands[i] == static_cast<int>(i) + 1 &&
                      file.GetRasterBand(bands[i])->GetRasterDataType() == GDT_Byte;
            words.AddString("-b");
            words.AddString(std::to_string(bands[i]).c_str());
        }
        if (isThere) return nullptr;
        if (file.GetRasterBand(bands.front())->GetRasterDataType() != GDT_Byte) {
            for (const char* word : {"-scale", "0", CPLSPrintf("%.17g", brightest(file, bands, path)), "0", "255"})
                words.AddString(word);
        }
    }
    GDALTranslateOptions* options = GDALTranslateOptionsNew(words.List(), nullptr);
    int usageError = 0;
    GDALDatasetH translated = GDALTranslate("", GDALDataset::ToHandle(&file), options, &usageError);
    GDALTranslateOptionsFree(options);
    if (translated == nullptr) throw Failure("cannot read the colours of \"" + path + "\": " + gdalMessage());
    return GdalDataset(GDALDataset::FromHandle(translated));
}

}  // namespace osgbindem
