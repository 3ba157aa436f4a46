// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PixelTransform.h"

#include "Failure.h"
#include "Gdal.h"

#include <cpl_string.h>
#include <gdal_alg.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace osgbindem {

using osgAnalyticBin::support::Failure;

void PixelTransform::Free::operator()(void* transformer) const {
    GDALDestroyGenImgProjTransformer(transformer);
}

PixelTransform::PixelTransform(GDALDataset& dataset, const OGRSpatialReference& target, const std::string& path) {
    CPLStringList words;
    words.SetNameValue("DST_SRS", wktOf(target).c_str());
    _transformer.reset(GDALCreateGenImgProjTransformer2(GDALDataset::ToHandle(&dataset), nullptr, words.List()));
    if (!_transformer) throw Failure("cannot bring \"" + path + "\" to latitude and longitude: " + gdalMessage());
}

void PixelTransform::transform(Places& places, bool isInverse) const {
    std::vector<double> z(places.x.size(), 0.0);
    places.isFound.assign(places.x.size(), 0);
    GDALGenImgProjTransform(_transformer.get(), isInverse ? TRUE : FALSE, static_cast<int>(places.x.size()),
                            places.x.data(), places.y.data(), z.data(), places.isFound.data());
    for (std::size_t i = 0; i < places.x.size(); ++i) {
        if (!std::isfinite(places.x[i]) || !std::isfinite(places.y[i])) places.isFound[i] = 0;
    }
}

namespace {

/// The area of a raster on the globe, from a lattice of places in it.
class Footprint {
public:
    Footprint(const PixelTransform& transform, int width, int height) : _transform(transform) {
        PixelTransform::Places places;
        for (int row = 0; row <= kSteps; ++row) {
            for (int column = 0; column <= kSteps; ++column) {
                places.add(static_cast<double>(width) * column / kSteps, static_cast<double>(height) * row / kSteps);
            }
        }
        transform.toDegrees(places);
        int start = 0;  // the found place that is next to the middle
        for (int i = 0; i < kCount; ++i) {
            if (places.isFound[at(i)] != 0 && awayFromMiddle(i) < awayFromMiddle(start)) start = i;
        }
        if (places.isFound[at(start)] == 0) return;
        follow(places, start);
        addPole(90.0, width, height);
        addPole(-90.0, width, height);
    }

    [[nodiscard]] bool isFound() const { return _rect.west <= _rect.east; }
    [[nodiscard]] RectDeg rect() const {
        if (!_isRound && _rect.east - _rect.west < 360.0) return _rect;
        return {-180.0, _rect.south, 180.0, _rect.north};
    }

private:
    static constexpr int kSteps = 64;
    static constexpr int kCount = (kSteps + 1) * (kSteps + 1);
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    static int awayFromMiddle(int i) {
        return std::abs(2 * (i % (kSteps + 1)) - kSteps) + std::abs(2 * (i / (kSteps + 1)) - kSteps);
    }

    /// From place to place, so that longitudes have no jump between neighbours.
    void follow(PixelTransform::Places& places, int start) {
        std::vector<int> found{start};
        std::vector<bool> isSeen(at(kCount), false);
        isSeen[at(start)] = true;
        for (std::size_t next = 0; next < found.size(); ++next) {
            const int i = found[next];
            const double longitude = places.x[at(i)];
            _rect.west = std::min(_rect.west, longitude);
            _rect.east = std::max(_rect.east, longitude);
            _rect.south = std::min(_rect.south, places.y[at(i)]);
            _rect.north = std::max(_rect.north, places.y[at(i)]);
            const int column = i % (kSteps + 1);
            for (const int j :
                 {column > 0 ? i - 1 : -1, column < kSteps ? i + 1 : -1, i - kSteps - 1, i + kSteps + 1}) {
                if (j < 0 || j >= kCount || isSeen[at(j)] || places.isFound[at(j)] == 0) continue;
                isSeen[at(j)] = true;
                const double step = std::remainder(places.x[at(j)] - longitude, 360.0);
                constexpr double kMostStep = 90.0;  // beside a pole the way round it is not known
                _isRound = _isRound || std::abs(step) > kMostStep;
                places.x[at(j)] = longitude + step;
                found.push_back(j);
            }
        }
    }

    /// Where all longitudes of a pole are one place within the raster.
    void addPole(double latitude, int width, int height) {
        PixelTransform::Places places;
        for (const double longitude : {-120.0, 0.0, 120.0}) places.add(longitude, latitude);
        _transform.toPixels(places);
        for (std::size_t i = 0; i < 3; ++i) {
            const bool isWithin = places.isFound[i] != 0 && places.x[i] >= 0.0 && places.x[i] <= width &&
                                  places.y[i] >= 0.0 && places.y[i] <= height;
            if (!isWithin || std::hypot(places.x[i] - places.x[0], places.y[i] - places.y[0]) > 1.0) return;
        }
        _isRound = true;
        (latitude > 0.0 ? _rect.north : _rect.south) = latitude;
    }

    const PixelTransform& _transform;
    RectDeg _rect{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    bool _isRound = false;
};

/// Distances between pixels along parallels and along meridians, at some places in a raster.
struct Spacings {
    std::vector<double> east;
    std::vector<double> north;
};

Spacings spacingsOf(const PixelTransform& transform, int width, int height) {
    constexpr int kSteps = 8;
    Spacings spacings;
    for (int i = 0; i < (kSteps + 1) * (kSteps + 1); ++i) {
        const double x = (width - 1.0) * (i % (kSteps + 1)) / kSteps;
        const double y = (height - 1.0) * (i / (kSteps + 1)) / kSteps;
        PixelTransform::Places places;
        places.add(x, y);
        places.add(x + 1.0, y);
        places.add(x, y + 1.0);
        transform.toDegrees(places);
        if (std::count(places.isFound.begin(), places.isFound.end(), 0) > 0) continue;
        const double lonX = std::remainder(places.x[1] - places.x[0], 360.0);
        const double lonY = std::remainder(places.x[2] - places.x[0], 360.0);
        const double latX = places.y[1] - places.y[0];
        const double latY = places.y[2] - places.y[0];
        const double area = std::abs(lonX * latY - lonY * latX);
        const double east = area / std::hypot(latX, latY);
        const double north = area / std::hypot(lonX, lonY);
        if (east > 0.0 && std::isfinite(east)) spacings.east.push_back(east);
        if (north > 0.0 && std::isfinite(north)) spacings.north.push_back(north);
    }
    std::sort(spacings.east.begin(), spacings.east.end());
    std::sort(spacings.north.begin(), spacings.north.end());
    return spacings;
}

/// So many posts along a whole circle that they are as close as the spacing, or up to a 64th closer: rasters whose
/// spacings are almost the same have the same number.
double postsAround(double circleDeg, double spacingDeg) {
    const double posts = circleDeg / spacingDeg;
    const double step = std::exp2(std::floor(std::log2(posts)) - 6.0);
    return std::ceil(posts / step) * step;
}

}  // namespace

std::optional<WarpedPlace> warpedPlaceOf(const PixelTransform& transform, int width, int height) {
    const Footprint footprint(transform, width, height);
    const Spacings spacings = spacingsOf(transform, width, height);
    if (!footprint.isFound() || spacings.east.empty() || spacings.north.empty()) return std::nullopt;
    return WarpedPlace{footprint.rect(), 360.0 / postsAround(360.0, spacings.east.front()),
                       180.0 / postsAround(180.0, spacings.north[spacings.north.size() / 2])};
}

}  // namespace osgbindem
