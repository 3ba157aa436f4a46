// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterFile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace osgbindem {

namespace {

// Metres beyond which no terrain of the earth lies, and none of any other body.
constexpr double kHighestOnEarth = 12000.0;
constexpr double kHighest = 1e5;
// The lowest number of 16 bits marks missing heights in any unit. A height that it is by chance is interpolated.
constexpr double kLowestNumber = -32768.0;

/// How the numbers of a band become metres.
struct HeightCode {
    std::optional<double> nodata;
    double scale = 1.0;
    double offset = 0.0;
    /// Numbers beyond are marks for missing heights that the file does not declare.
    double highest = 0.0;
    /// Each is 0 where heights are missing.
    std::vector<GDALRasterBand*> masks;
};

class HeightBand final : public GDALRasterBand {
public:
    HeightBand(GDALDataset& dataset, GDALRasterBand& numbers, const HeightCode& code)
        : _numbers(numbers), _code(code), _isSingle(numbers.GetRasterDataType() == GDT_Float32) {
        poDS = &dataset;
        nBand = 1;
        eDataType = GDT_Float64;
        nRasterXSize = numbers.GetXSize();
        nRasterYSize = numbers.GetYSize();
        numbers.GetBlockSize(&nBlockXSize, &nBlockYSize);
    }

    double GetNoDataValue(int* hasNodata) override {
        if (hasNodata != nullptr) *hasNodata = TRUE;
        return kMissing;
    }

protected:
    CPLErr IReadBlock(int column, int row, void* data) override {
        const int x = column * nBlockXSize;
        const int y = row * nBlockYSize;
        const int width = std::min(nBlockXSize, nRasterXSize - x);
        const int height = std::min(nBlockYSize, nRasterYSize - y);
        constexpr GSpacing kSize = sizeof(double);
        return IRasterIO(GF_Read, x, y, width, height, data, width, height, GDT_Float64, kSize, kSize * nBlockXSize,
                         nullptr);
    }

    CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns, int rows,
                     GDALDataType type, GSpacing pixelSpace, GSpacing lineSpace, GDALRasterIOExtraArg* extra) override {
        const bool isNearest = extra == nullptr || extra->eResampleAlg == GRIORA_NearestNeighbour;
        const bool isDense = type == GDT_Float64 && pixelSpace == static_cast<GSpacing>(sizeof(double));
        if (flag != GF_Read || !isNearest || !isDense)
            return GDALRasterBand::IRasterIO(flag, x, y, width, height, data, columns, rows, type, pixelSpace,
                                             lineSpace, extra);
        CPLErr error = _numbers.RasterIO(GF_Read, x, y, width, height, data, columns, rows, GDT_Float64, pixelSpace,
                                         lineSpace, nullptr);
        const auto at = [&](int row) { return reinterpret_cast<double*>(static_cast<char*>(data) + row * lineSpace); };
        for (GDALRasterBand* mask : _code.masks) {
            if (error != CE_None) break;
            std::vector<GByte> isThere(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
            error =
                mask->RasterIO(GF_Read, x, y, width, height, isThere.data(), columns, rows, GDT_Byte, 0, 0, nullptr);
            auto next = isThere.begin();
            for (int row = 0; row < rows; ++row)
                for (int i = 0; i < columns; ++i)
                    if (*next++ == 0) at(row)[i] = kMissing;
        }
        for (int row = 0; error == CE_None && row < rows; ++row)
            for (int i = 0; i < columns; ++i) at(row)[i] = decoded(at(row)[i]);
        return error;
    }

private:
    static constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

    [[nodiscard]] double decoded(double number) const {
        const auto same = static_cast<float>(_code.nodata.value_or(0.0));
        const bool isMissing =
            std::isnan(number) ||
            (_code.nodata && (number == *_code.nodata || (_isSingle && static_cast<float>(number) == same)));
        const double metres = number * _code.scale + _code.offset;
        const bool isHeight = std::abs(metres) <= _code.highest && number != kLowestNumber;
        return !isMissing && isHeight ? metres : kMissing;
    }

    GDALRasterBand& _numbers;
    HeightCode _code;
    bool _isSingle;
};

class HeightDataset final : public GDALDataset {
public:
    HeightDataset(GDALRasterBand& numbers, const HeightCode& code, const OGRSpatialReference& horizontal)
        : _source(*numbers.GetDataset()), _horizontal(horizontal) {
        // GDAL's mosaics open what has no driver by its name, once more.
        poDriver = GetGDALDriverManager()->GetDriverByName("VRT");
        nRasterXSize = numbers.GetXSize();
        nRasterYSize = numbers.GetYSize();
        SetBand(1, new HeightBand(*this, numbers, code));
    }

    CPLErr GetGeoTransform(double* transform) override { return _source.GetGeoTransform(transform); }
    const OGRSpatialReference* GetSpatialRef() const override { return _horizontal.IsEmpty() ? nullptr : &_horizontal; }
    int GetGCPCount() override { return _source.GetGCPCount(); }
    const OGRSpatialReference* GetGCPSpatialRef() const override { return GetSpatialRef(); }
    const GDAL_GCP* GetGCPs() override { return _source.GetGCPs(); }

private:
    GDALDataset& _source;
    OGRSpatialReference _horizontal;
};

/// What the raster says of its unit; nullopt for units that are no length.
std::optional<double> declaredMetresPerUnit(GDALRasterBand& band, const OGRSpatialReference* reference) {
    const std::string unit = CPLString(band.GetUnitType()).tolower();
    if (unit.empty()) {
        const bool isCompound = reference != nullptr && reference->IsCompound() != 0;
        return isCompound ? reference->GetTargetLinearUnits("VERT_CS") : 1.0;
    }
    struct Unit {
        const char* start;
        double metres;
    };
    constexpr double kFoot = 0.3048;
    constexpr double kSurveyFoot = 1200.0 / 3937.0;
    for (const Unit& known : {Unit{"us survey f", kSurveyFoot}, Unit{"us_survey_f", kSurveyFoot},
                              Unit{"ftus", kSurveyFoot}, Unit{"us-ft", kSurveyFoot}, Unit{"foot_us", kSurveyFoot},
                              Unit{"ft", kFoot}, Unit{"f", kFoot}, Unit{"international f", kFoot}, Unit{"km", 1000.0},
                              Unit{"kilomet", 1000.0}, Unit{"cm", 0.01}, Unit{"centimet", 0.01}, Unit{"dm", 0.1},
                              Unit{"decimet", 0.1}, Unit{"mm", 0.001}, Unit{"millimet", 0.001}, Unit{"met", 1.0}}) {
        if (unit.rfind(known.start, 0) == 0) return known.metres;
    }
    return unit == "m" ? std::optional(1.0) : std::nullopt;
}

/// The band with the heights, and what masks it; `notes` get a word when it is one of several.
GDALRasterBand& heightBandOf(GDALDataset& file, const Settings& settings, const std::string& path,
                             std::vector<GDALRasterBand*>& masks, std::vector<std::string>& notes) {
    const int count = file.GetRasterCount();
    const int number = settings.band.value_or(1);
    if (number > count)
        throw Failure("no band " + std::to_string(number) + " in \"" + path + "\", which has " + std::to_string(count) +
                      "; see --band");
    GDALRasterBand& band = *file.GetRasterBand(number);
    bool isAlone = true;
    for (GDALRasterBand* other : file.GetBands()) {
        if (other == &band) continue;
        const bool isAlpha = other->GetColorInterpretation() == GCI_AlphaBand;
        if (isAlpha) masks.push_back(other);
        isAlone = isAlone && isAlpha;
    }
    if ((band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA | GMF_ALPHA)) == 0) masks.push_back(band.GetMaskBand());
    if (!isAlone && !settings.band) {
        const std::string name = band.GetDescription();
        notes.push_back("band " + std::to_string(number) + " of " + std::to_string(count) +
                        (name.empty() ? name : ", \"" + name + "\",") + " has the heights; see --band");
    }
    return band;
}

/// Number of the first band with this meaning; 0 without one.
int bandOf(GDALDataset& file, GDALColorInterp colour) {
    for (int i = 1; i <= file.GetRasterCount(); ++i)
        if (file.GetRasterBand(i)->GetColorInterpretation() == colour) return i;
    return 0;
}

/// Numbers of the bands with red, green and blue.
std::vector<int> colourBands(GDALDataset& file) {
    const std::vector<int> bands{bandOf(file, GCI_RedBand), bandOf(file, GCI_GreenBand), bandOf(file, GCI_BlueBand)};
    if (std::count(bands.begin(), bands.end(), 0) == 0) return bands;
    const int alpha = bandOf(file, GCI_AlphaBand);
    if ((alpha == 0 ? file.GetRasterCount() : alpha - 1) >= 3) return {1, 2, 3};
    return std::vector(3, std::max(1, bandOf(file, GCI_GrayIndex)));
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
    for (const double end : {1.0, 255.0, 1023.0, 4095.0, 16383.0, 65535.0})
        if (highest <= end && (end > 1.0 || !isWhole)) return end;
    throw Failure("colours of \"" + path + "\" reach " + std::string(CPLSPrintf("%.9g", highest)) +
                  "; bring them to bytes, for example with gdal_translate -ot Byte -scale");
}

}  // namespace

GdalDataset heightsOf(GDALDataset& file, const Settings& settings, const DemInput& input,
                      const OGRSpatialReference& horizontal, std::vector<std::string>& notes) {
    HeightCode code;
    GDALRasterBand& band = heightBandOf(file, settings, input.path, code.masks, notes);
    int hasNodata = 0;
    const double nodata = band.GetNoDataValue(&hasNodata);
    if (hasNodata != 0) code.nodata = nodata;
    if (settings.nodata) code.nodata = settings.nodata;
    const auto declared = declaredMetresPerUnit(band, referenceOf(file));
    if (!declared && !input.metresPerUnit)
        throw Failure("heights of \"" + input.path + "\" are in \"" + band.GetUnitType() +
                      "\", which is no length that is known; give --height-unit");
    const double metres = input.metresPerUnit.value_or(declared.value_or(1.0));
    if (!input.metresPerUnit && metres != 1.0)
        notes.push_back("the unit that it declares is " + std::string(CPLSPrintf("%.9g", metres)) + " m");
    code.scale = band.GetScale() * metres;
    code.offset = band.GetOffset() * metres;
    if (code.offset > 0.5 * horizontal.GetSemiMajor())
        throw Failure("heights of \"" + input.path +
                      "\" are distances from the middle of the body, with an offset of " +
                      std::string(CPLSPrintf("%.9g", code.offset)) +
                      " m; take it away with gdal_edit.py -offset 0, and see --radii");
    // A user's factor may exaggerate heights.
    const double most = settings.isWgs84 ? kHighestOnEarth : kHighest;
    code.highest = most * std::max(1.0, std::abs(input.metresPerUnit.value_or(1.0)));
    return GdalDataset(new HeightDataset(band, code, horizontal));
}

GdalDataset coloursOf(GDALDataset& file, const std::string& path) {
    const auto translated = [&](GDALDataset& source, const std::string& words) {
        return madeBy<GDALTranslateOptionsNew, GDALTranslateOptionsFree>(
            CPLStringList(CSLTokenizeString(("-of VRT " + words).c_str())), "read the colours of \"" + path + "\"",
            [&](auto* options, int* usageError) {
                return GDALTranslate("", GDALDataset::ToHandle(&source), options, usageError);
            });
    };
    const GDALColorInterp meaning = file.GetRasterBand(1)->GetColorInterpretation();
    if (meaning >= GCI_HueBand)
        throw Failure("bands of \"" + path + "\" are " + GDALGetColorInterpretationName(meaning) +
                      " and others; give an image of red, green and blue");
    GDALDataset* source = &file;
    if (file.GetRasterBand(1)->GetColorTable() != nullptr) source = translated(file, "-ot Byte -expand rgba").release();
    std::vector<int> bands = colourBands(*source);
    GDALRasterBand* first = source->GetRasterBand(bands.front());
    // GDAL's masks know alpha bands in the last place only, and not beside nodata.
    const bool isUnmasked = (first->GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) != 0;
    const int alpha = isUnmasked ? bandOf(*source, GCI_AlphaBand) : 0;
    std::string colours = "-ot Byte -colorinterp red,green,blue,alpha -a_nodata none";
    if (first->GetRasterDataType() != GDT_Byte) {
        const double most = brightest(file, bands, path);
        for (const int channel : {1, 2, 3}) colours += CPLSPrintf(" -scale_%d 0 %.17g 0 255", channel, most);
    }
    if (alpha == 0 && first->GetMaskFlags() == GMF_NODATA && bands.front() != bands.back()) {
        // A pixel is missing only when all of its colours are.
        std::string parts;
        std::string numbers;
        for (const int band : bands) {
            parts += CPLSPrintf("-b %d ", band);
            numbers += CPLSPrintf("%.17g ", file.GetRasterBand(band)->GetNoDataValue());
        }
        source = translated(file, parts + "-mo \"NODATA_VALUES=" + numbers + "\"").release();
        bands = {1, 2, 3};
    }
    for (const int band : bands) colours += CPLSPrintf(" -b %d", band);
    colours += CPLSPrintf(alpha > 0 ? " -b %d" : " -b mask,%d", alpha > 0 ? alpha : bands.front());
    if (alpha > 0 && source->GetRasterBand(alpha)->GetRasterDataType() == GDT_UInt16)
        colours += " -scale_4 0 65535 0 255";
    GdalDataset result = translated(*source, colours);
    if (source != &file) source->ReleaseRef();  // the result has a reference of its own
    return result;
}

}  // namespace osgbindem
