// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

// Heights of databases of rasters in any reference system, side by side and over others. The oracle at a post of the
// finest tiles is the raster's own bilinear value, at the pixels where GDAL's transformation of the post falls.

#include "RasterTest.h"
#include "TileLayout.h"

#include <cpl_string.h>
#include <gdal_alg.h>
#include <gdal_utils.h>

#include <array>
#include <memory>
#include <random>

namespace {

/// A raster file as GDAL has it.
class Truth {
public:
    explicit Truth(const std::string& path) : _file(path), _heights(OpenRaster::read(_file.band())) {
        CPLStringList words;
        words.SetNameValue("DST_SRS", "EPSG:4326");
        GDALDatasetH dataset = GDALDataset::ToHandle(_file.operator->());
        _transformer.reset(GDALCreateGenImgProjTransformer2(dataset, nullptr, words.List()));
    }

    [[nodiscard]] int width() const { return _file->GetRasterXSize(); }
    [[nodiscard]] int height() const { return _file->GetRasterYSize(); }

    /// Longitude and latitude of a pixel position.
    [[nodiscard]] std::array<double, 2> degrees(double x, double y) const { return transformed(false, x, y); }

    /// Metres; NaN outside of the middles of the outer pixels, and beside missing ones.
    [[nodiscard]] double at(double latitude, double longitude) const {
        const auto place = pixel(latitude, longitude, -0.5);
        return place ? bilinear((*place)[0] - 0.5, (*place)[1] - 0.5) : std::nan("");
    }
    /// Whether the position is in the raster or next to it.
    [[nodiscard]] bool isNear(double latitude, double longitude) const {
        return pixel(latitude, longitude, 2.0).has_value();
    }

private:
    struct Free {
        void operator()(void* transformer) const { GDALDestroyGenImgProjTransformer(transformer); }
    };

    /// Where the position is in the raster, or beside it by less than `room` pixels.
    [[nodiscard]] std::optional<std::array<double, 2>> pixel(double latitude, double longitude, double room) const {
        for (const double turn : {0.0, 360.0, -360.0}) {
            const auto [x, y] = transformed(true, longitude + turn, latitude);
            if (x >= -room && x <= width() + room && y >= -room && y <= height() + room) return std::array{x, y};
        }
        return std::nullopt;
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

    OpenRaster _file;
    std::vector<double> _heights;
    std::unique_ptr<void, Free> _transformer;
};

class Heights : public RasterTest {
protected:
    /// Compares 1000 posts of the finest tiles, anywhere in the rasters, with the finest raster that has data there.
    /// `rasters`: finest first.
    void expectHeights(const Words& rasters, int fewest = 900) const {
        const LoadedDatabase database = databaseOf(joined(joined(rasters, region), {"--blend", "0"}));
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
};

/// A virtual raster of files that lie side by side. Returns: its path.
std::string writeMosaic(const std::string& path, const std::vector<std::string>& files) {
    std::vector<const char*> names;
    for (const std::string& file : files) names.push_back(file.c_str());
    GDALClose(GDALBuildVRT(path.c_str(), static_cast<int>(names.size()), nullptr, names.data(), nullptr, nullptr));
    return path;
}

/// Hills some kilometres apart, at places in metres.
double hillsOfMetres(double y, double x) {
    return 1500.0 + 400.0 * std::sin(x / 900.0) * std::cos(y / 700.0);
}

TEST_F(Heights, TilesOfAMapProjectionSideBySideOverAGlobe) {
    region = {"-te", "17.9", "59.8", "18.4", "60.2"};
    Words rasters;
    for (int i = 0; i < 9; ++i) {
        TestRaster tile(670050.0 + 4000.0 * (i % 3), 6650050.0 + 4000.0 * (i / 3), 100.0, 40, hillsOfMetres);
        rasters.push_back(saved(tile.in("EPSG:25833")));
    }
    const std::string globe = savedGlobe(0.5, flat(0.0));
    const std::string whole = writeMosaic(file("mosaic.vrt"), rasters);
    // Each for itself they meet, too: between the outer posts of two tiles lies the nearer one.
    const LoadedDatabase apart = databaseOf(joined(joined({globe}, rasters), joined(region, {"--blend", "0"})));
    const LoadedDatabase together = databaseOf(joined({globe, whole, "--blend", "0"}, region));
    for (double latitude = 59.93; latitude < 60.03; latitude += 0.002)
        for (double longitude = 18.06; longitude < 18.2; longitude += 0.004)
            EXPECT_NEAR(apart.altitudeAt(latitude, longitude), together.altitudeAt(latitude, longitude), 30.0)
                << latitude << ' ' << longitude;
    region.clear();
    expectHeights({whole, globe});
}

TEST_F(Heights, TilesOfTwoZonesAndOfANationalGridSideBySide) {
    region = {"-te", "11.7", "50.3", "12.3", "50.7"};
    Words rasters;
    // Both sides of 12 degrees east; what lies in both is in the first one.
    for (const auto& [reference, west] : {std::pair("EPSG:25832", 700050.0), {"EPSG:25833", 288050.0}})
        rasters.push_back(saved(TestRaster(west, 5600050.0, 100.0, 100.0, 120, 100, hillsOfMetres).in(reference)));
    expectHeights(rasters, 850);
    rasters.push_back(saved(TestRaster(4498050.0, 5590050.0, 100.0, 100, hillsOfMetres).in("EPSG:31468")));
    expectHeights(rasters, 800);
}

TEST_F(Heights, ARasterAcrossTheDateLine) {
    const auto plateau = [](double y, double x) { return 2000.0 + hillsOfMetres(y / 10.0, x / 10.0); };
    const std::string aleutians = saved(TestRaster(600500.0, 6099500.0, 1000.0, 200, plateau).in("EPSG:32660"));
    expectHeights({aleutians});
    expectHeights({aleutians, savedGlobe(0.5, flat(100.0))}, 800);
}

TEST_F(Heights, ATurnedRaster) {
    const std::string turned = saved(TestRaster(700050.0, 5600050.0, 100.0, 100, hillsOfMetres).in("EPSG:25832"));
    double transform[6] = {700000.0, 86.6, 50.0, 5600100.0, 50.0, -86.6};
    OpenRaster(turned, GDAL_OF_UPDATE)->SetGeoTransform(transform);
    expectHeights({turned});
}

/// Hills of so many metres from one to the next, divided by 2 pi.
TestRaster::Height wavesOf(double metres) {
    return [metres](double y, double x) { return 1000.0 + 800.0 * std::sin(x / metres) * std::cos(y / metres); };
}

struct OneRaster {
    const char* name;
    const char* reference;
    double x, y, spacing;
    int columns, rows;
    TestRaster::Height height;
    int fewest = 900;
};

void PrintTo(const OneRaster& raster, std::ostream* out) {
    *out << raster.name;
}

// Geographic systems that are not degrees of WGS 84, maps, and maps whose pixels differ in size.
const OneRaster kRasters[] = {
    {"Pole", "EPSG:3413", -297500.0, 297500.0, 5000.0, 120, 120, wavesOf(2e4)},
    {"Paris", "EPSG:4807", 0.05, 53.95, 0.05, 100, 80, hills},
    {"Tokyo", "EPSG:4301", 139.0, 36.0, 0.001, 100, 100, hills},
    {"TurnedPole",
     "+proj=ob_tran +o_proj=longlat +o_lon_p=-162 +o_lat_p=39.25 +lon_0=180 +datum=WGS84 "
     "+to_meter=0.0174532925199433 +no_defs",
     -9.95, 5.95, 0.1, 60, 60, hills},
    {"Sphere", "+proj=longlat +R=6371007 +towgs84=0,0,0 +no_defs", -179.5, 89.5, 1.0, 360, 180, hills},
    {"Cone", "EPSG:3034", 2.502e6, 3.998e6, 4000.0, 300, 300, wavesOf(4e4)},
    {"Mercator", "EPSG:3857", -1.995e7, 1.995e7, 1e5, 400, 400, wavesOf(6e5), 850},
    // Half of what it shows is empty, and degrees change fast along its border.
    {"Disc", "+proj=ortho +lat_0=40 +lon_0=170 +datum=WGS84", -6.35e6, 6.35e6, 1e5, 128, 128, wavesOf(6e5), 700}};

class HeightsOf : public Heights, public testing::WithParamInterface<OneRaster> {};

TEST_P(HeightsOf, ARasterInThisSystem) {
    const OneRaster& r = GetParam();
    TestRaster raster(r.x, r.y, r.spacing, r.spacing, r.columns, r.rows, r.height);
    expectHeights({saved(raster.in(r.reference))}, r.fewest);
}

INSTANTIATE_TEST_SUITE_P(Systems, HeightsOf, testing::ValuesIn(kRasters),
                         [](const auto& raster) { return std::string(raster.param.name); });

}  // namespace
