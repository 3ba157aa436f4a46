// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "WarpedPlace.h"

#include "Failure.h"
#include "Gdal.h"

#include <cpl_string.h>
#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

namespace {

/// Pixels and lines of a raster, or longitudes and latitudes.
struct Places {
    std::vector<double> x;
    std::vector<double> y;
    std::vector<int> isFound;

    void add(double placeX, double placeY) {
        x.push_back(placeX);
        y.push_back(placeY);
    }
    void transform(void* transformer, bool toPixels) {
        std::vector<double> z(x.size(), 0.0);
        isFound.assign(x.size(), 0);
        GDALGenImgProjTransform(transformer, toPixels ? TRUE : FALSE, static_cast<int>(x.size()), x.data(), y.data(),
                                z.data(), isFound.data());
        for (std::size_t i = 0; i < x.size(); ++i)
            if (!std::isfinite(x[i]) || !std::isfinite(y[i])) isFound[i] = 0;
    }
};

/// Whether all longitudes of a pole are one place within a raster of so many pixels.
bool holdsPole(void* transformer, double latitude, int width, int height) {
    Places places;
    for (const double longitude : {-120.0, 0.0, 120.0}) places.add(longitude, latitude);
    places.transform(transformer, true);
    for (std::size_t i = 0; i < 3; ++i) {
        const bool isWithin = places.isFound[i] != 0 && places.x[i] >= 0.0 && places.x[i] <= width &&
                              places.y[i] >= 0.0 && places.y[i] <= height;
        if (!isWithin || std::hypot(places.x[i] - places.x[0], places.y[i] - places.y[0]) > 1.0) return false;
    }
    return true;
}

/// The area of a raster of so many pixels, from a lattice of places in it. West > east: none is found.
RectDeg extentOf(void* transformer, int width, int height) {
    constexpr int kSteps = 64;
    constexpr double kMostStep = 90.0;  // beside a pole the way round it is not known
    Places places;
    for (int i = 0; i < (kSteps + 1) * (kSteps + 1); ++i) {
        places.add(static_cast<double>(width) * (i % (kSteps + 1)) / kSteps,
                   static_cast<double>(height) * (i / (kSteps + 1)) / kSteps);
    }
    places.transform(transformer, false);
    RectDeg rect{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    bool isRound = false;
    // From the middle outward, so that longitudes have no jump between neighbours.
    const double unknown = std::nan("");
    double start = unknown;
    for (const int rowStep : {1, -1}) {
        double middle = start;
        for (int row = kSteps / 2; row >= 0 && row <= kSteps; row += rowStep) {
            for (const int columnStep : {1, -1}) {
                double last = middle;
                for (int column = kSteps / 2; column >= 0 && column <= kSteps; column += columnStep) {
                    const auto i = static_cast<std::size_t>(row * (kSteps + 1) + column);
                    if (places.isFound[i] == 0) continue;
                    const double step = std::isnan(last) ? 0.0 : std::remainder(places.x[i] - last, 360.0);
                    isRound = isRound || std::abs(step) > kMostStep;
                    last = std::isnan(last) ? places.x[i] : last + step;
                    if (column == kSteps / 2 || std::isnan(middle)) middle = last;
                    rect = {std::min(rect.west, last), std::min(rect.south, places.y[i]), std::max(rect.east, last),
                            std::max(rect.north, places.y[i])};
                }
            }
            if (std::isnan(start)) start = middle;
        }
    }
    for (const double pole : {90.0, -90.0}) {
        if (rect.west > rect.east || !holdsPole(transformer, pole, width, height)) continue;
        isRound = true;
        (pole > 0.0 ? rect.north : rect.south) = pole;
    }
    if (isRound || rect.east - rect.west >= 360.0) return {-180.0, rect.south, 180.0, rect.north};
    return rect;
}

/// So many posts along a whole circle that they are as close as the spacing, or up to a 64th closer: rasters whose
/// spacings are almost the same have the same number.
double roundedSpacing(double circleDeg, double spacingDeg) {
    const double posts = circleDeg / spacingDeg;
    const double step = std::exp2(std::floor(std::log2(posts)) - 6.0);
    return circleDeg / (std::ceil(posts / step) * step);
}

}  // namespace

WarpedPlace warpedPlaceOf(GDALDataset& dataset, const OGRSpatialReference& target, const std::string& path) {
    CPLStringList words;
    words.SetNameValue("DST_SRS", wktOf(target).c_str());
    const std::unique_ptr<void, void (*)(void*)> transformer(
        GDALCreateGenImgProjTransformer2(GDALDataset::ToHandle(&dataset), nullptr, words.List()),
        GDALDestroyGenImgProjTransformer);
    const auto failure = [&] {
        return Failure("cannot bring \"" + path + "\" to latitude and longitude: " + gdalMessage());
    };
    if (!transformer) throw failure();
    const int width = dataset.GetRasterXSize();
    const int height = dataset.GetRasterYSize();
    constexpr int kSteps = 8;
    Places places;
    for (int i = 0; i < (kSteps + 1) * (kSteps + 1); ++i) {
        const double x = (width - 1.0) * (i % (kSteps + 1)) / kSteps;
        const double y = (height - 1.0) * (i / (kSteps + 1)) / kSteps;
        places.add(x, y);
        places.add(x + 1.0, y);
        places.add(x, y + 1.0);
    }
    places.transform(transformer.get(), false);
    std::vector<double> eastDeg;
    std::vector<double> northDeg;
    for (std::size_t i = 0; i < places.x.size(); i += 3) {
        if (places.isFound[i] == 0 || places.isFound[i + 1] == 0 || places.isFound[i + 2] == 0) continue;
        const double lonX = std::remainder(places.x[i + 1] - places.x[i], 360.0);
        const double lonY = std::remainder(places.x[i + 2] - places.x[i], 360.0);
        const double latX = places.y[i + 1] - places.y[i];
        const double latY = places.y[i + 2] - places.y[i];
        const double area = std::abs(lonX * latY - lonY * latX);
        const double east = area / std::hypot(latX, latY);
        const double north = area / std::hypot(lonX, lonY);
        if (east > 0.0 && std::isfinite(east)) eastDeg.push_back(east);
        if (north > 0.0 && std::isfinite(north)) northDeg.push_back(north);
    }
    const RectDeg extent = extentOf(transformer.get(), width, height);
    if (extent.west > extent.east || eastDeg.empty() || northDeg.empty()) throw failure();
    std::sort(eastDeg.begin(), eastDeg.end());
    std::sort(northDeg.begin(), northDeg.end());
    return {extent, roundedSpacing(360.0, eastDeg.front()), roundedSpacing(180.0, northDeg[northDeg.size() / 2])};
}

}  // namespace osgbindem
