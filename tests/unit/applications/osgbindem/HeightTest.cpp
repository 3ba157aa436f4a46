// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Heights of databases of rasters in any reference system, side by side and over others. The oracle at a post of the
// finest tiles is the raster's own bilinear value, at the pixels where GDAL's transformation of the post falls.

#include "DatabaseCheck.h"
#include "Program.h"
#include "TileLayout.h"

#include <cpl_string.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>

namespace {

using Words = std::vector<std::string>;

/// A raster file as GDAL has it.
class Truth {
public:
    explicit Truth(const std::string& path) : _dataset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER)) {
        CPLStringList words;
        words.SetNameValue("DST_SRS", "EPSG:4326");
        _transformer.reset(
            GDALCreateGenImgProjTransformer2(GDALDataset::ToHandle(_dataset.get()), nullptr, words.List()));
        _heights.resize(static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()));
        GDALRasterBand& band = *_dataset->GetRasterBand(1);
        EXPECT_EQ(band.RasterIO(GF_Read, 0, 0, width(), height(), _heights.data(), width(), height(), GDT_Float64, 0, 0,
                                nullptr),
                  CE_None);
    }

    [[nodiscard]] int width() const { return _dataset->GetRasterXSize(); }
    [[nodiscard]] int height() const { return _dataset->GetRasterYSize(); }

    /// Longitude and latitude of a pixel position.
    [[nodiscard]] std::array<double, 2> degrees(double x, double y) const { return transformed(false, x, y); }

    /// Metres; NaN outside of the middles of the outer pixels, and beside missing ones.
    [[nodiscard]] double at(double latitude, double longitude) const {
        for (const double turn : {0.0, 360.0, -360.0}) {
            const auto [x, y] = transformed(true, longitude + turn, latitude);
            if (isWithin(x, y)) return bilinear(x - 0.5, y - 0.5);
        }
        return std::nan("");
    }
    /// Whether the position is in the raster or next to it.
    [[nodiscard]] bool isNear(double latitude, double longitude) const {
        for (const double turn : {0.0, 360.0, -360.0}) {
            const auto [x, y] = transformed(true, longitude + turn, latitude);
            if (x > -2.0 && x < width() + 2.0 && y > -2.0 && y < height() + 2.0) return true;
        }
        return false;
    }

private:
    struct Free {
        void operator()(void* transformer) const { GDALDestroyGenImgProjTransformer(transformer); }
    };
    struct Close {
        void operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }
    };

    [[nodiscard]] bool isWithin(double x, double y) const {
        return x >= 0.5 && x <= width() - 0.5 && y >= 0.5 && y <= height() - 0.5;
    }
    [[nodiscard]] std::array<double, 2> transformed(bool isInverse, double x, double y) const {
        double z = 0.0;
        int isFound = 0;
        GDALGenImgProjTransform(_transformer.get(), isInverse ? TRUE : FALSE, 1, &x, &y, &z, &isFound);
        if (isFound == 0) return {HUGE_VAL, HUGE_VAL};
        return {x, y};
    }
    [[nodiscard]] double bilinear(double x, double y) const {
        const int column = std::min(static_cast<int>(x), width() - 2);
        const int row = std::min(static_cast<int>(y), height() - 2);
        const auto post = [&](int c, int r) {
            return _heights[static_cast<std::size_t>(r) * static_cast<std::size_t>(width()) +
                            static_cast<std::size_t>(c)];
        };
        const double u = x - column;
        const double v = y - row;
        return (1 - v) * ((1 - u) * post(column, row) + u * post(column + 1, row)) +
               v * ((1 - u) * post(column, row + 1) + u * post(column + 1, row + 1));
    }

    std::unique_ptr<GDALDataset, Close> _dataset;
    std::unique_ptr<void, Free> _transformer;
    std::vector<double> _heights;
};

class Heights : public testing::Test {
protected:
    void SetUp() override { GDALAllRegister(); }

    std::string file(const std::string& name) const { return _folder.file(name); }

    /// Writes a raster; returns its file.
    std::string raster(const std::string& name, const std::string& reference, double x, double y, double spacing,
                       int columns, int rows, const TestRaster::Height& height) const {
        TestRaster raster(x, y, spacing, spacing, columns, rows, height);
        raster.setReference(reference);
        raster.write(file(name));
        return file(name);
    }

    /// GDAL's mosaic of rasters; returns its file.
    std::string mosaicOf(const Words& rasters) const {
        std::vector<const char*> names;
        for (const std::string& path : rasters) names.push_back(path.c_str());
        GDALClose(GDALBuildVRT(file("mosaic.vrt").c_str(), static_cast<int>(names.size()), nullptr, names.data(),
                               nullptr, nullptr));
        return file("mosaic.vrt");
    }

    /// Compares 1000 posts of the finest tiles, anywhere in the rasters, with the finest raster that has data there.
    /// `rasters`: finest first. `sources`: what the database is built from, in place of them.
    void expectHeights(const Words& rasters, int fewest = 900, const Words& sources = {}) const {
        Words words = sources.empty() ? rasters : sources;
        words.insert(words.end(), region.begin(), region.end());
        words.insert(words.end(), {"--blend", "0", "--overwrite", "-o", file("earth.osgb")});
        build(words);
        const LoadedDatabase database = loadDatabase(file("earth.osgb"));
        std::vector<std::unique_ptr<Truth>> truths;
        for (const std::string& path : rasters) truths.push_back(std::make_unique<Truth>(path));
        std::mt19937 random(1);
        int compared = 0;
        for (int i = 0; i < 1000; ++i) {
            const Truth& truth = *truths[random() % truths.size()];
            std::uniform_real_distribution<double> column(0.5, truth.width() - 0.5);
            std::uniform_real_distribution<double> row(0.5, truth.height() - 0.5);
            const double x = column(random);
            const auto [longitude, latitude] = truth.degrees(x, row(random));
            if (!std::isfinite(longitude)) continue;
            if (comparePost(database, truths, latitude, std::remainder(longitude, 360.0))) ++compared;
        }
        EXPECT_GE(compared, fewest);
    }

    /// Of the command line, where the rasters are in a part of the earth.
    Words region;

private:
    /// Returns: false where a post lies between rasters, or in a void.
    static bool comparePost(const LoadedDatabase& database, const std::vector<std::unique_ptr<Truth>>& truths,
                            double latitude, double longitude) {
        const LoadedTile& tile = database.leafAt(latitude, longitude);
        const Rect rect = tile.rect();
        const double spacing = (rect.north - rect.south) / tile.cells;
        const int column = static_cast<int>(std::lround((longitude - rect.west) / spacing));
        const int row = static_cast<int>(std::lround((latitude - rect.south) / spacing));
        const double postLatitude = rect.south + row * spacing;
        const double postLongitude = rect.west + column * spacing;
        double expected = std::nan("");
        for (const auto& truth : truths) {
            expected = truth->at(postLatitude, postLongitude);
            if (!std::isnan(expected)) break;
            if (truth->isNear(postLatitude, postLongitude)) return false;
        }
        // All posts of a pole are one, where the raster has many.
        if (std::isnan(expected) || std::abs(postLatitude) == 90.0) return false;
        const double found = database.ellipsoid().toGeodetic(tile.post(column, row)).altitude;
        // Heights are whole steps, and vertices are rounded.
        const osgbindem::TileLayout layout(tile.cells, 20, database.ellipsoid());
        const double most = 1.0 / 128.0 + layout.quantum(tile.level) + 0.001;
        EXPECT_NEAR(found, expected, most) << postLatitude << ' ' << postLongitude << " level " << tile.level;
        return true;
    }

    const TempFolder _folder;
};

/// Hills some kilometres apart, at places in metres.
double hillsOfMetres(double y, double x) {
    return 1500.0 + 400.0 * std::sin(x / 900.0) * std::cos(y / 700.0);
}

TEST_F(Heights, TilesOfAMapProjectionSideBySideOverAGlobe) {
    region = {"-te", "17.9", "59.8", "18.4", "60.2"};
    Words rasters;
    for (int i = 0; i < 9; ++i) {
        rasters.push_back(raster("tile" + std::to_string(i) + ".tif", "EPSG:25833", 670050.0 + 4000.0 * (i % 3),
                                 6650050.0 + 4000.0 * (i / 3), 100.0, 40, 40, hillsOfMetres));
    }
    const std::string whole = mosaicOf(rasters);
    expectHeights({whole}, 900, rasters);
    region.clear();
    TestRaster::globe(0.5, [](double, double) { return 0.0; }).write(file("globe.tif"));
    rasters.push_back(file("globe.tif"));
    expectHeights({whole, rasters.back()}, 900, rasters);
}

TEST_F(Heights, TilesOfTwoZonesAndOfANationalGridSideBySide) {
    region = {"-te", "11.7", "50.3", "12.3", "50.7"};
    Words rasters;
    // Both sides of 12 degrees east; what lies in both is in the first one.
    rasters.push_back(raster("west.tif", "EPSG:25832", 700050.0, 5600050.0, 100.0, 120, 100, hillsOfMetres));
    rasters.push_back(raster("east.tif", "EPSG:25833", 288050.0, 5600050.0, 100.0, 120, 100, hillsOfMetres));
    expectHeights(rasters, 850);
    rasters.push_back(raster("grid.tif", "EPSG:31468", 4498050.0, 5590050.0, 100.0, 100, 100, hillsOfMetres));
    expectHeights(rasters, 800);
}

TEST_F(Heights, TilesOfDegreesWithAnEmptyColumn) {
    region = {"-te", "9", "49", "14", "54"};
    Words rasters;
    for (int i = 0; i < 9; ++i) {
        const double west = 10.0 + i % 3;
        rasters.push_back(raster("tile" + std::to_string(i) + ".tif", "EPSG:4326", west + 0.005, 50.995 + i / 3, 0.01,
                                 100, 100, [=](double latitude, double longitude) {
                                     return longitude > west + 0.99 ? std::nan("") : hills(latitude, longitude);
                                 }));
    }
    expectHeights(rasters, 850);
}

TEST_F(Heights, ARasterThatHoldsThePole) {
    const std::string polar =
        raster("polar.tif", "EPSG:3413", -297500.0, 297500.0, 5000.0, 120, 120,
               [](double y, double x) { return 1000.0 + 900.0 * std::sin(x / 2e4) * std::sin(y / 2e4); });
    expectHeights({polar});
}

TEST_F(Heights, ARasterAcrossTheDateLine) {
    const auto plateau = [](double y, double x) { return 2000.0 + hillsOfMetres(y / 10.0, x / 10.0); };
    const std::string aleutians = raster("aleutians.tif", "EPSG:32660", 600500.0, 6099500.0, 1000.0, 200, 200, plateau);
    expectHeights({aleutians});
    TestRaster::globe(0.5, [](double, double) { return 100.0; }).write(file("globe.tif"));
    expectHeights({aleutians, file("globe.tif")}, 800);
}

TEST_F(Heights, GeographicSystemsThatAreNotDegreesOfWgs84) {
    expectHeights({raster("paris.tif", "EPSG:4807", 0.05, 53.95, 0.05, 100, 80, hills)});
    expectHeights({raster("tokyo.tif", "EPSG:4301", 139.0, 36.0, 0.001, 100, 100, hills)});
    expectHeights({raster("rotated.tif",
                          "+proj=ob_tran +o_proj=longlat +o_lon_p=-162 +o_lat_p=39.25 +lon_0=180 +datum=WGS84 "
                          "+to_meter=0.0174532925199433 +no_defs",
                          -9.95, 5.95, 0.1, 60, 60, hills)});
}

TEST_F(Heights, MapsWhosePixelsDifferInSize) {
    const auto waves = [](double y, double x) { return 1000.0 + 800.0 * std::sin(x / 4e4) * std::cos(y / 4e4); };
    expectHeights({raster("cone.tif", "EPSG:3034", 2.502e6, 3.998e6, 4000.0, 300, 300, waves)});
    const auto wide = [](double y, double x) { return 1000.0 + 800.0 * std::sin(x / 6e5) * std::cos(y / 6e5); };
    expectHeights({raster("mercator.tif", "EPSG:3857", -1.995e7, 1.995e7, 1e5, 400, 400, wide)}, 850);
    // Half of what it shows is empty, and degrees change fast along its border.
    expectHeights(
        {raster("disc.tif", "+proj=ortho +lat_0=40 +lon_0=170 +datum=WGS84", -6.35e6, 6.35e6, 1e5, 128, 128, wide)},
        700);
}

TEST_F(Heights, ATurnedRaster) {
    const std::string turned = raster("turned.tif", "EPSG:25832", 700050.0, 5600050.0, 100.0, 100, 100, hillsOfMetres);
    GDALDataset* dataset = GDALDataset::Open(turned.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE);
    double transform[6] = {700000.0, 86.6, 50.0, 5600100.0, 50.0, -86.6};
    dataset->SetGeoTransform(transform);
    GDALClose(GDALDataset::ToHandle(dataset));
    expectHeights({turned});
}

TEST_F(Heights, LatitudesOfASphere) {
    expectHeights(
        {raster("sphere.tif", "+proj=longlat +R=6371007 +towgs84=0,0,0 +no_defs", -179.5, 89.5, 1.0, 360, 180, hills)});
}

TEST_F(Heights, RastersOfDegrees) {
    TestRaster::globe(1.0, hills).write(file("globe.tif"));
    expectHeights({raster("fine.tif", "EPSG:4326", 10.0, 50.0, 0.03, 80, 80, hills),
                   raster("other.tif", "EPSG:4269", -100.0, 40.0, 0.1, 80, 60, hills), file("globe.tif")});
}

}  // namespace
