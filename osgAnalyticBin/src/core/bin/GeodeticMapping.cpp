// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../LocalFrame.h"

#include <osgAnalyticBin/core/bin/GeodeticMapping.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

// The bounds below are sums and products of some twenty rounded terms.
constexpr double kRoundUp = 1.0 + 1e-13;

// Upper bounds of the factors of the third derivatives over a range of latitudes.
struct LatitudeBounds {
    double sinLat, cosLat;       // of |sin|, |cos|
    double meridional;           // of M
    double primeVertical;        // of N
    double meridionalSlope;      // of |M'|
    double meridionalCurvature;  // of |M''|
};

LatitudeBounds latitudeBounds(const Ellipsoid& ellipsoid, const ParameterBox& box) {
    const double south = std::max(box.center.x - box.halfSize.x, -kHalfPi);
    const double north = std::min(box.center.x + box.halfSize.x, kHalfPi);
    const bool crossesEquator = south <= 0.0 && north >= 0.0;
    // Latitudes nearest to the equator and farthest from it: all that follows is monotone between them.
    const double nearest = crossesEquator ? 0.0 : std::min(std::abs(south), std::abs(north));
    const double farthest = std::max(std::abs(south), std::abs(north));
    const double e2 = ellipsoid.eccentricitySquared();
    const double a = ellipsoid.equatorialRadius();
    const double sinLow = std::sin(nearest);

    LatitudeBounds bounds{};
    bounds.sinLat = std::sin(farthest);
    bounds.cosLat = std::cos(nearest);
    const double wMin = std::min(ellipsoid.curvatureTerm(sinLow, bounds.cosLat),
                                 ellipsoid.curvatureTerm(bounds.sinLat, std::cos(farthest)));
    const double rootW = std::sqrt(wMin);
    bounds.primeVertical = a / rootW;
    bounds.meridional = a * ellipsoid.squaredRatio() / (wMin * rootW);
    const double sinCos = std::min(0.5, bounds.sinLat * bounds.cosLat);
    const double cos2p =
        std::max(std::abs(1.0 - 2.0 * sinLow * sinLow), std::abs(1.0 - 2.0 * bounds.sinLat * bounds.sinLat));
    // doc/theory/derivation.md, section 3: M' = 3 M e2 sp cp / w, M'' = 3 a (1-e2) e2 (cos 2p + 5 e2 sp2 cp2 / w) /
    // w^(5/2)
    bounds.meridionalSlope = 3.0 * bounds.meridional * std::abs(e2) * sinCos / wMin;
    bounds.meridionalCurvature =
        3.0 * bounds.meridional * std::abs(e2) * (cos2p + 5.0 * std::abs(e2) * sinCos * sinCos / wMin) / wMin;
    return bounds;
}

}  // namespace

glm::dvec3 GeodeticMapping::value(const glm::dvec3& parameters) const noexcept {
    return _ellipsoid.toEcef({parameters.x, parameters.y, parameters.z});
}

glm::dmat3 GeodeticMapping::jacobian(const glm::dvec3& parameters) const noexcept {
    constexpr double kUnits = Ellipsoid::kMapUnitsInRadian;
    if (_ellipsoid.isPlane()) return glm::dmat3({0.0, kUnits, 0.0}, {kUnits, 0.0, 0.0}, {0.0, 0.0, 1.0});
    const LocalFrame frame(parameters.x, parameters.y);
    const double h = parameters.z;
    const double m = _ellipsoid.meridionalRadius(frame.sinLat, frame.cosLat);
    const double n = _ellipsoid.primeVerticalRadius(frame.sinLat, frame.cosLat);
    return glm::dmat3((m + h) * frame.north,                // f_p
                      (n + h) * frame.cosLat * frame.east,  // f_l
                      frame.up);                            // f_h
}

Hessians GeodeticMapping::hessians(const glm::dvec3& parameters) const noexcept {
    if (_ellipsoid.isPlane()) return {};
    const LocalFrame frame(parameters.x, parameters.y);
    const double h = parameters.z;
    const double e2 = _ellipsoid.eccentricitySquared();
    const double m = _ellipsoid.meridionalRadius(frame.sinLat, frame.cosLat);
    const double n = _ellipsoid.primeVerticalRadius(frame.sinLat, frame.cosLat);
    const double mSlope =
        3.0 * m * e2 * frame.sinLat * frame.cosLat / _ellipsoid.curvatureTerm(frame.sinLat, frame.cosLat);
    Hessians result;
    result.uu = mSlope * frame.north - (m + h) * frame.up;  // f_pp
    result.vv = -(n + h) * frame.cosLat * frame.radial;     // f_ll
    result.ww = glm::dvec3(0.0);                            // f_hh
    result.uv = -(m + h) * frame.sinLat * frame.east;       // f_pl
    result.uw = frame.north;                                // f_ph
    result.vw = frame.cosLat * frame.east;                  // f_lh
    return result;
}

double GeodeticMapping::remainder(const ParameterBox& box) const noexcept {
    if (_ellipsoid.isPlane()) return 0.0;
    const LatitudeBounds bound = latitudeBounds(_ellipsoid, box);
    const double h = std::max(std::abs(box.center.z - box.halfSize.z), std::abs(box.center.z + box.halfSize.z));
    const double mh = bound.meridional + h;
    const double nh = bound.primeVertical + h;
    const double p = box.halfSize.x;
    const double l = box.halfSize.y;
    const double dh = box.halfSize.z;
    // doc/theory/derivation.md, section 3: the components along east, and in the meridian plane.
    const double east = 3.0 * (bound.meridionalSlope * bound.sinLat + mh * bound.cosLat) * p * p * l +
                        nh * bound.cosLat * l * l * l + 6.0 * bound.sinLat * p * l * dh;
    const double meridian = (bound.meridionalCurvature + mh) * p * p * p + 2.0 * bound.meridionalSlope * p * p * p +
                            3.0 * mh * bound.sinLat * p * l * l + 3.0 * p * p * dh + 3.0 * bound.cosLat * l * l * dh;
    return std::hypot(east, meridian) / 6.0 * kRoundUp;
}

double GeodeticMapping::termMagnitude(const ParameterBox& box) const noexcept {
    if (_ellipsoid.isPlane()) return 0.0;
    const double sinLat = std::abs(std::sin(box.center.x));
    const double cosLat = std::abs(std::cos(box.center.x));
    const double h = std::abs(box.center.z);
    const double n = _ellipsoid.primeVerticalRadius(sinLat, cosLat);
    const double m = _ellipsoid.meridionalRadius(sinLat, cosLat);
    const double mSlope = 3.0 * m * std::abs(_ellipsoid.eccentricitySquared()) * sinLat * cosLat /
                          _ellipsoid.curvatureTerm(sinLat, cosLat);
    const double p = box.halfSize.x;
    const double l = box.halfSize.y;
    const double across = (n + h) * cosLat;
    const double value = std::hypot(across, (n * _ellipsoid.squaredRatio() + h) * sinLat);
    const double first = (m + h) * p + across * l + box.halfSize.z;
    const double second = std::hypot(mSlope, m + h) * p * p + across * l * l + (m + h) * sinLat * p * l +
                          (p + cosLat * l) * box.halfSize.z;
    return value + first + second;
}

ParameterBox parameterBox(const GeodeticBin& bin) noexcept {
    assert(!bin.empty());
    const Geodetic center = bin.center();
    // The factor covers the rounding of the differences, which a given middle leaves within half an epsilon.
    const auto reach = [](const Interval& interval, double middle) {
        constexpr double kOutward = 1.0 + 2.0 * std::numeric_limits<double>::epsilon();
        return std::max(interval.upper - middle, middle - interval.lower) * kOutward;
    };
    return {{center.latitude, center.longitude, center.altitude},
            {reach(bin.latitude(), center.latitude), reach(bin.longitude(), center.longitude),
             reach(bin.altitude(), center.altitude)}};
}

}  // namespace osgAnalyticBin::core
