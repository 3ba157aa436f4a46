// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TestImage.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <osg/Texture2D>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace {

constexpr double kNodata = 7.0;

void writeBand(GDALRasterBand& band, const std::vector<std::uint8_t>& values) {
    std::vector<std::uint8_t> copy = values;
    if (band.RasterIO(GF_Write, 0, 0, band.GetXSize(), band.GetYSize(), copy.data(), band.GetXSize(), band.GetYSize(),
                      GDT_Byte, 0, 0, nullptr) != CE_None)
        throw std::runtime_error("cannot write an image");
}

/// Index 1 is the colour, index 0 the hole.
void writePalette(GDALRasterBand& band, const std::array<std::vector<std::uint8_t>, 4>& bands) {
    std::vector<std::uint8_t> indices;
    GDALColorTable table;
    for (std::size_t i = 0; i < bands[3].size(); ++i) {
        indices.push_back(bands[3][i] > 0 ? 1 : 0);
        const GDALColorEntry entry{bands[0][i], bands[1][i], bands[2][i], 255};
        if (indices.back() == 1) table.SetColorEntry(1, &entry);
    }
    band.SetNoDataValue(0.0);
    band.SetColorTable(&table);
    writeBand(band, indices);
}

}  // namespace

TestImage TestImage::globe(double spacingDeg, const Colour& colour) {
    return square(-180.0, 90.0, spacingDeg, static_cast<int>(std::lround(360.0 / spacingDeg)), colour);
}

TestImage TestImage::square(double west, double north, double spacingDeg, int pixels, const Colour& colour) {
    return {west, north, spacingDeg, pixels, [colour](double, double) { return colour; }, Hole::Alpha};
}

void TestImage::write(const std::string& path) const {
    GDALAllRegister();
    const int rows = std::min(pixels, static_cast<int>(std::lround((north + 90.0) / spacingDeg)));
    std::array<std::vector<std::uint8_t>, 4> bands;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < pixels; ++column) {
            const auto colour = colourAt(north - (row + 0.5) * spacingDeg, west + (column + 0.5) * spacingDeg);
            for (std::size_t c = 0; c < 3; ++c)
                bands[c].push_back(static_cast<std::uint8_t>(colour ? (*colour)[c] : static_cast<int>(kNodata)));
            bands[3].push_back(colour ? 255 : 0);
        }
    }
    CPLSetConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const int count = hole == Hole::Palette ? 1 : hole == Hole::Alpha ? 4 : 3;
    GDALDataset* dataset = driver->Create(path.c_str(), pixels, rows, count, GDT_Byte, nullptr);
    double transform[6] = {west, spacingDeg, 0.0, north, 0.0, -spacingDeg};
    dataset->SetGeoTransform(transform);
    OGRSpatialReference reference;
    reference.importFromEPSG(4326);
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    dataset->SetSpatialRef(&reference);
    if (hole == Hole::Alpha) dataset->GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand);
    if (hole == Hole::Mask) dataset->CreateMaskBand(GMF_PER_DATASET);
    if (hole == Hole::Palette) writePalette(*dataset->GetRasterBand(1), bands);
    for (int band = 1; band <= 3 && hole != Hole::Palette; ++band) {
        if (hole == Hole::Nodata) dataset->GetRasterBand(band)->SetNoDataValue(kNodata);
        writeBand(*dataset->GetRasterBand(band), bands[static_cast<std::size_t>(band - 1)]);
    }
    if (hole == Hole::Alpha) writeBand(*dataset->GetRasterBand(4), bands[3]);
    if (hole == Hole::Mask) writeBand(*dataset->GetRasterBand(1)->GetMaskBand(), bands[3]);
    GDALClose(GDALDataset::ToHandle(dataset));
}

const osg::Image* textureOf(const LoadedTile& tile) {
    const osg::StateSet* state = tile.geometry->getStateSet();
    const auto* texture =
        state ? dynamic_cast<const osg::Texture2D*>(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE))
              : nullptr;
    return texture ? texture->getImage() : nullptr;
}

Colour shownAt(const LoadedDatabase& database, double latitudeDeg, double longitudeDeg) {
    return shownAt(database.leafAt(latitudeDeg, longitudeDeg), latitudeDeg, longitudeDeg);
}

Colour shownAt(const LoadedTile& tile, double latitudeDeg, double longitudeDeg) {
    const osg::Image* image = textureOf(tile);
    if (!image) throw std::runtime_error("no texture there");
    const Rect rect = tile.rect();
    const auto texel = [&](double share) { return static_cast<unsigned int>(std::lround(share * (image->s() - 1))); };
    const unsigned char* shown = image->data(texel((longitudeDeg - rect.west) / (rect.east - rect.west)),
                                             texel((latitudeDeg - rect.south) / (rect.north - rect.south)));
    return {shown[0], shown[1], shown[2]};
}
