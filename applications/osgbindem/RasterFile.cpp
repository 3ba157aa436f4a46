// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RasterFile.h"

#include "Failure.h"

#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string_view>
#include <utility>

namespace osgbindem {

using osgAnalyticBin::support::throwIfStopRequested;

namespace {

// An overview's posts are not exactly twice as far apart when the raster has an odd number of them.
constexpr double kSlack = 1e-3;

const OGRSpatialReference& wgs84() {
    static thread_local const OGRSpatialReference reference = [] {
        OGRSpatialReference r;
        r.importFromEPSG(4326);
        r.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        return r;
    }();
    return reference;
}

// Drivers of text that find a row by reading those above it. GDAL tries rows that cannot be read anew for each row
// below: 2^rows times in a file that was cut short, unless it is read from the top.
bool isRowsOfText(GDALDataset& dataset) {
    const std::array<std::string_view, 3> drivers{"AAIGrid", "GRASSASCIIGrid", "ISG"};
    const GDALDriver* driver = dataset.GetDriver();
    return driver != nullptr && std::find(drivers.begin(), drivers.end(), driver->GetDescription()) != drivers.end();
}

void requireAllRows(GDALDataset& dataset, const std::string& path) {
    for (int row = 0; row < dataset.GetRasterYSize(); ++row) {
        throwIfStopRequested();
        double post = 0.0;
        const CPLErr error =
            dataset.GetRasterBand(1)->RasterIO(GF_Read, 0, row, 1, 1, &post, 1, 1, GDT_Float64, 0, 0, nullptr);
        if (error != CE_None) throw Failure("cannot read \"" + path + "\": " + gdalMessage());
    }
}

/// `overview`: its number, or -1 for the raster itself.
GdalDataset opened(const std::string& path, int overview = -1) {
    CPLStringList words;
    if (overview >= 0) words.SetNameValue("OVERVIEW_LEVEL", std::to_string(overview).c_str());
    GdalDataset dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, nullptr, words.List(), nullptr));
    if (!dataset) {
        // GDAL has names that are no files, so the file system is asked only afterwards.
        const std::string reason =
            mayExist(path) ? gdalMessage() + "; give a raster file" : "no such file; check the name";
        throw Failure("cannot open \"" + path + "\": " + reason);
    }
    if (dataset->GetRasterCount() == 0)
        throw Failure("no raster band in \"" + path + "\"; name one of its subdatasets as gdalinfo lists them");
    if (isRowsOfText(*dataset)) requireAllRows(*dataset, path);
    return dataset;
}

// Without a reference system, degrees are recognised by their range.
bool looksLikeDegrees(const GeoTransform& t, int width, int height) {
    const double east = t[0] + width * t[1];
    const double other = t[3] + height * t[5];
    return t[1] > 0.0 && t[0] >= -361.0 && east <= 721.0 && east - t[0] <= 361.0 &&
           std::abs(t[3]) <= 90.0 + std::abs(t[5]) && std::abs(other) <= 90.0 + std::abs(t[5]);
}

// Whether all corners are at numbers that coordinates may be; GDAL brings degrees into range turn by turn.
bool isPlausible(const GeoTransform& t, GDALDataset& dataset) {
    constexpr double kMostDegrees = 1e4;
    constexpr double kMostUnits = 1e11;  // of a length, be it millimetres
    const OGRSpatialReference* reference = dataset.GetSpatialRef();
    const double most = reference != nullptr && reference->IsGeographic() ? kMostDegrees : kMostUnits;
    for (const double column : {0.0, static_cast<double>(dataset.GetRasterXSize())}) {
        for (const double row : {0.0, static_cast<double>(dataset.GetRasterYSize())}) {
            const double x = t[0] + column * t[1] + row * t[2];
            const double y = t[3] + column * t[4] + row * t[5];
            if (!(std::abs(x) <= most && std::abs(y) <= most)) return false;
        }
    }
    return true;
}

bool isOfEarth(const OGRSpatialReference& reference) {
    constexpr double kMost = 0.01;  // spheres and ellipsoids of the earth differ by less
    return std::abs(reference.GetSemiMajor() / wgs84().GetSemiMajor() - 1.0) < kMost;
}

std::string verticalOf(const OGRSpatialReference& reference) {
    if (reference.IsCompound() == 0) return {};
    const OGR_SRSNode* vertical = reference.GetAttrNode("VERT_CS");
    if (vertical == nullptr) vertical = reference.GetAttrNode("VERTCRS");
    if (vertical == nullptr || vertical->GetChildCount() == 0) return {};
    return wktOf(*vertical);
}

/// The raster's own coordinates of places that are spread evenly over it, each followed by those a pixel farther along
/// the row, along the column, and along both. Empty where GDAL does not know them.
struct Places {
    explicit Places(GDALDataset& dataset) {
        constexpr int kSteps = 8;
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; j <= kSteps; ++j) {
                const double column = (dataset.GetRasterXSize() - 1.0) * j / kSteps;
                const double row = (dataset.GetRasterYSize() - 1.0) * i / kSteps;
                x.insert(x.end(), {column, column + 1.0, column, column + 1.0});
                y.insert(y.end(), {row, row, row + 1.0, row + 1.0});
            }
        }
        std::vector<double> z(x.size(), 0.0);
        isFound.resize(x.size());
        void* transformer = GDALCreateGenImgProjTransformer2(GDALDataset::ToHandle(&dataset), nullptr, nullptr);
        if (transformer == nullptr) {
            x.clear();
            return;
        }
        GDALGenImgProjTransform(transformer, FALSE, static_cast<int>(x.size()), x.data(), y.data(), z.data(),
                                isFound.data());
        GDALDestroyGenImgProjTransformer(transformer);
    }

    std::vector<double> x;
    std::vector<double> y;
    std::vector<int> isFound;
};

/// The area of places that `way` brings to degrees. West > east: none is found.
RectDeg extentOf(const Places& places, OGRCoordinateTransformation& way) {
    constexpr int kPlaces = 1000;        // along each border
    constexpr double kLeastGap = 11.25;  // a smaller one may be between places
    const auto [west, east] = std::minmax_element(places.x.begin(), places.x.end());
    const auto [south, north] = std::minmax_element(places.y.begin(), places.y.end());
    RectDeg extent;
    if (way.TransformBounds(*west, *south, *east, *north, &extent.west, &extent.south, &extent.east, &extent.north,
                            kPlaces) == 0)
        return {180.0, 90.0, -180.0, -90.0};
    if (extent.east <= extent.west) extent.east += 360.0;
    if (extent.east - extent.west > 360.0 - kLeastGap) return {-180.0, extent.south, 180.0, extent.north};
    return extent;
}

}  // namespace

RasterFile::RasterFile(const Settings& settings, DemInput raster, bool isElevation, double spacingDeg)
    : input(std::move(raster)) {
    open(settings, isElevation, -1);
    const int number = overview(spacingDeg);
    if (number >= 0) open(settings, isElevation, number);
}

void RasterFile::open(const Settings& settings, bool isElevation, int overview) {
    dataset.reset();
    file = opened(input.path, overview);
    takeTransform();
    takeReference(settings.isWgs84);
    notes.clear();
    dataset = isElevation ? heightsOf(*file, settings, input, horizontal, notes) : coloursOf(*file, input.path);
    place();
}

void RasterFile::takeTransform() {
    const GeoTransform& t = transform;
    const bool hasTransform = file->GetGeoTransform(transform.data()) == CE_None;
    isUnturned = hasTransform && t[2] == 0.0 && t[4] == 0.0 && t[1] > 0.0 && t[5] != 0.0;
    if (!hasTransform) {
        if (file->GetGCPCount() > 0 && file->GetGCPSpatialRef() != nullptr) return;
        throw Failure("no georeferencing in \"" + input.path +
                      "\"; add it, for example with gdal_edit.py -a_srs -a_ullr");
    }
    if (!isPlausible(t, *file))
        throw Failure("the coordinates of \"" + input.path + "\" are far from any globe; correct its georeferencing");
    if (file->GetSpatialRef() == nullptr &&
        !(isUnturned && looksLikeDegrees(t, file->GetRasterXSize(), file->GetRasterYSize()))) {
        throw Failure("no reference system in \"" + input.path +
                      "\", and its coordinates are not degrees; add one, for example with gdal_edit.py -a_srs");
    }
}

void RasterFile::takeReference(bool isWgs84) {
    target = wgs84();
    const OGRSpatialReference* reference = referenceOf(*file);
    if (reference == nullptr) return;
    vertical = verticalOf(*reference);
    horizontal = *reference;
    horizontal.StripVertical();
    horizontal.DemoteTo2D(nullptr);
    horizontal.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (reference->IsLocal() != 0)
        throw Failure("the reference system of \"" + input.path +
                      "\" is local; give one that has a place on the globe");
    if (!isWgs84) {
        target.SetGeogCS("globe", "globe", "globe", reference->GetSemiMajor(), reference->GetInvFlattening());
        target.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    } else if (!isOfEarth(*reference)) {
        throw Failure("\"" + input.path +
                      "\" is of another body than the globe; give rasters of one body, or --radii " +
                      CPLSPrintf("%.9g %.9g", reference->GetSemiMajor(), reference->GetSemiMinor()));
    }
}

Failure RasterFile::noWayToGlobe() const {
    return Failure("cannot bring \"" + input.path + "\" to latitude and longitude: " + gdalMessage());
}

std::unique_ptr<OGRCoordinateTransformation> RasterFile::wayToGlobe() const {
    std::unique_ptr<OGRCoordinateTransformation> way(OGRCreateCoordinateTransformation(&horizontal, &target));
    if (!way) throw noWayToGlobe();
    return way;
}

bool RasterFile::isInDegreesOfGlobe() const {
    if (!isUnturned) return false;
    if (horizontal.IsEmpty()) return true;
    if (horizontal.IsGeographic() == 0 || horizontal.IsDerivedGeographic() != 0) return false;
    if (horizontal.IsSame(&target) != 0) return true;
    const auto way = wayToGlobe();
    constexpr double kMost = 0.01;  // pixels
    // Latitudes of a sphere and of an ellipsoid differ most halfway between poles and equator.
    for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        for (const double v : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const double east = transform[0] + u * file->GetRasterXSize() * transform[1];
            const double north = std::clamp(transform[3] + v * file->GetRasterYSize() * transform[5], -90.0, 90.0);
            double x = east;
            double y = north;
            if (way->Transform(1, &x, &y) == 0) return false;
            if (std::abs(std::remainder(x - east, 360.0)) > kMost * transform[1] && std::abs(north) < 90.0)
                return false;
            if (std::abs(y - north) > kMost * std::abs(transform[5])) return false;
        }
    }
    return true;
}

void RasterFile::place() {
    isPlain = isInDegreesOfGlobe();
    if (isPlain) {
        const double east = transform[0] + file->GetRasterXSize() * transform[1];
        const double other = transform[3] + file->GetRasterYSize() * transform[5];
        extent = {transform[0], std::min(transform[3], other), east, std::max(transform[3], other)};
        eastDeg = transform[1];
        northDeg = std::abs(transform[5]);
    } else {
        placeWarped();
    }
    constexpr double kFinestDeg = 1e-9;  // a tenth of a millimetre
    if (!(eastDeg >= kFinestDeg && northDeg >= kFinestDeg))
        throw Failure("the pixels of \"" + input.path + "\" have no size on a globe; correct its georeferencing");
    constexpr double kMostTurns = 2.0;
    if (extent.east - extent.west > kMostTurns * 360.0 || eastDeg > 360.0 || northDeg > 180.0)
        throw Failure("\"" + input.path + "\" or one of its pixels is larger than a globe; correct its georeferencing");
    if (!(extent.south < 90.0 && extent.north > -90.0))
        throw Failure("no part of \"" + input.path +
                      "\" lies between latitudes -90 and 90; correct its georeferencing");
}

void RasterFile::placeWarped() {
    const auto way = wayToGlobe();
    Places places(*dataset);
    if (places.x.empty()) throw noWayToGlobe();
    extent = extentOf(places, *way);
    way->Transform(static_cast<int>(places.x.size()), places.x.data(), places.y.data(), nullptr, places.isFound.data());
    std::vector<double> eastward;
    std::vector<double> northward;
    for (std::size_t i = 0; i < places.x.size(); i += 4) {
        const auto isFound = places.isFound.begin() + static_cast<std::ptrdiff_t>(i);
        const double lonX = std::remainder(places.x[i + 1] - places.x[i], 360.0);
        const double lonY = std::remainder(places.x[i + 2] - places.x[i], 360.0);
        const double latX = places.y[i + 1] - places.y[i];
        const double latY = places.y[i + 2] - places.y[i];
        const double area = std::abs(lonX * latY - lonY * latX);
        const double east = area / std::hypot(latX, latY);
        const double north = area / std::hypot(lonX, lonY);
        if (std::count(isFound, isFound + 4, 0) > 0 || !std::isfinite(area)) {
            // Next to where a map ends, degrees change faster than its border tells.
            extent = {-180.0, -90.0, 180.0, 90.0};
            continue;
        }
        if (east > 0.0 && std::isfinite(east)) eastward.push_back(east);
        if (north > 0.0 && std::isfinite(north)) northward.push_back(north);
    }
    if (extent.west > extent.east || eastward.empty() || northward.empty()) throw noWayToGlobe();
    std::sort(northward.begin(), northward.end());
    eastDeg = *std::min_element(eastward.begin(), eastward.end());
    northDeg = northward[northward.size() / 2];
}

/// The number of the coarsest that is as fine as needed; -1 without one.
int RasterFile::overview(double spacingDeg) const {
    GDALRasterBand& band = *file->GetRasterBand(1);
    const double fullDeg = std::min(eastDeg, northDeg);
    int level = -1;
    double coarsestDeg = fullDeg;
    for (int i = 0; i < band.GetOverviewCount(); ++i) {
        GDALRasterBand* overview = band.GetOverview(i);
        if (overview == nullptr) continue;
        const double deg = fullDeg * std::max(static_cast<double>(band.GetXSize()) / overview->GetXSize(),
                                              static_cast<double>(band.GetYSize()) / overview->GetYSize());
        if (deg <= coarsestDeg || deg > spacingDeg * (1.0 + kSlack)) continue;
        coarsestDeg = deg;
        level = i;
    }
    return level;
}

void RasterFile::requireHeights() const {
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    // GDAL reads these posts from an overview where there is one, so that a server sends little.
    constexpr int kMost = 256;  // along a side
    const int width = std::min(kMost, band.GetXSize());
    const int rows = std::min(kMost, band.GetYSize());
    std::vector<double> heights(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
    const CPLErr error = band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), heights.data(), width, rows,
                                       GDT_Float64, 0, 0, nullptr);
    const auto isHeight = [](double height) { return !std::isnan(height); };
    if (error == CE_None && std::any_of(heights.begin(), heights.end(), isHeight)) return;
    std::array<double, 2> range{};
    if (error == CE_None && band.ComputeRasterMinMax(FALSE, range.data()) == CE_None) return;
    throw Failure("no heights in \"" + input.path + "\": " + gdalMessage() +
                  "; leave it out, or see --nodata, --height-unit and --radii");
}

Settings withDeclaredRadii(Settings settings) {
    if (settings.areRadiiGiven) return settings;
    const std::string& path = settings.dems.front().path;
    const GdalDataset dataset = opened(path);
    const OGRSpatialReference* reference = referenceOf(*dataset);
    if (reference == nullptr || reference->IsLocal() != 0 || isOfEarth(*reference)) return settings;
    settings.ellipsoid = {reference->GetSemiMajor(), reference->GetSemiMinor()};
    settings.isWgs84 = false;
    std::cout << "the globe has the radii of \"" << path << "\", " << settings.ellipsoid.equatorialRadius() << " and "
              << settings.ellipsoid.polarRadius() << " m; see --radii" << std::endl;
    return settings;
}

}  // namespace osgbindem
