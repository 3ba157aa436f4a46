// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../EarthScale.h"

#include <osgAnalyticBin/core/occlusion/BinHull.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::core {

namespace {

// The sine and the cosine of an angle.
struct Angle {
    explicit Angle(double radians) : sine(std::sin(radians)), cosine(std::cos(radians)) {}
    Angle(double ofSine, double ofCosine) : sine(ofSine), cosine(ofCosine) {}

    [[nodiscard]] Angle plus(const Angle& other) const {
        return {sine * other.cosine + cosine * other.sine, cosine * other.cosine - sine * other.sine};
    }
    [[nodiscard]] Angle minus(const Angle& other) const { return plus({-other.sine, other.cosine}); }

    double sine, cosine;
};

glm::dvec3 along(const Frame& frame, const glm::dvec3& v) {
    return {glm::dot(v, frame.x), glm::dot(v, frame.y), glm::dot(v, frame.z)};
}

// A radius of curvature at a bin's altitudes, or more: M changes within the bin.
double largestRadius(const Ellipsoid& ellipsoid, const Interval& altitude) {
    return 1.001 * largestCurvatureRadius(ellipsoid) + std::max(std::abs(altitude.lower), std::abs(altitude.upper));
}

// Points at a bin's lower, middle and upper latitude and longitude.
class ThreeByThree {
public:
    ThreeByThree(const Ellipsoid& ellipsoid, const GeodeticBin& bin, const Frame& frame)
        : _ellipsoid(ellipsoid),
          _axis(along(frame, {0.0, 0.0, 1.0})),
          _origin(along(frame, frame.origin)),
          _latitudes(threeOf(bin.latitude())) {
        const Interval &latitude = bin.latitude(), &longitude = bin.longitude();
        if (ellipsoid.isPlane()) {
            constexpr double kUnits = Ellipsoid::kMapUnitsInRadian;
            const std::array<double, 3> y{latitude.lower, latitude.middle(), latitude.upper};
            const std::array<double, 3> x{longitude.lower, longitude.middle(), longitude.upper};
            for (std::size_t i = 0; i < 3; ++i) {
                _northings[i] = along(frame, {0.0, kUnits * y[i], 0.0});
                _meridians[i] = along(frame, {kUnits * x[i], 0.0, 0.0});
            }
            return;
        }
        const std::array<Angle, 3> longitudes = threeOf(longitude);
        for (std::size_t i = 0; i < 3; ++i)
            _meridians[i] = along(frame, {longitudes[i].cosine, longitudes[i].sine, 0.0});
    }

    /// [DERIVATION] section 1: ECEF of a geodetic position is rho (cos l, sin l, 0) + z (0, 0, 1).
    /// Error: some 30 units in the last place of the longest of the vectors.
    [[nodiscard]] std::array<glm::dvec3, 3> at(std::size_t row, double altitude) const {
        glm::dvec3 middle = altitude * _axis + _northings[row];
        double axisDistance = 1.0;
        if (!_ellipsoid.isPlane()) {
            const Angle& latitude = _latitudes[row];
            const double radius = _ellipsoid.primeVerticalRadius(latitude.sine, latitude.cosine);
            middle = (_ellipsoid.squaredRatio() * radius + altitude) * latitude.sine * _axis;
            axisDistance = (radius + altitude) * latitude.cosine;
        }
        middle -= _origin;
        return {axisDistance * _meridians[0] + middle, axisDistance * _meridians[1] + middle,
                axisDistance * _meridians[2] + middle};
    }

    /// The cosine of the latitude nearest to the equator.
    [[nodiscard]] double largestCosine() const {
        if (_ellipsoid.isPlane() || _latitudes[0].sine * _latitudes[2].sine <= 0.0) return 1.0;
        return std::max(_latitudes[0].cosine, _latitudes[2].cosine);
    }

private:
    [[nodiscard]] static std::array<Angle, 3> threeOf(const Interval& interval) {
        const Angle middle(interval.middle()), half(0.5 * interval.width());
        return {middle.minus(half), middle, middle.plus(half)};
    }

    const Ellipsoid& _ellipsoid;
    glm::dvec3 _axis, _origin;  // the globe's axis and the frame's origin, along the frame's axes
    std::array<Angle, 3> _latitudes;
    std::array<glm::dvec3, 3> _northings{};  // of a plane
    std::array<glm::dvec3, 3> _meridians;    // the directions from the globe's axis, along the frame's axes
};

}  // namespace

std::array<BinHull, 4> hullsOfQuarters(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin,
                                       const Frame& frame) noexcept {
    const Interval &latitude = bin.latitude(), &longitude = bin.longitude(), &altitude = bin.altitude();
    const ThreeByThree grid(ellipsoid, bin, frame);
    // doc/theory/occlusion.md, section 4: second derivatives by latitude and by longitude, an eighth of the widths'
    // squares
    const double radius = largestRadius(ellipsoid, altitude);
    const double north = 0.5 * latitude.width(), east = 0.5 * longitude.width();
    const double bulge = (north * north + grid.largestCosine() * east * east) * radius / 8.0;
    const bool isRound = std::abs(ellipsoid.eccentricitySquared()) <= kRoundest;
    const double reach = bulge + margin + 32.0 * kEpsilon * radius;
    std::array<BinHull, 4> hulls;
    for (BinHull& hull : hulls) hull.reach = isRound ? reach : std::numeric_limits<double>::infinity();
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t end = 0; end < 2; ++end) {
            const auto points = grid.at(row, end == 0 ? altitude.lower : altitude.upper);
            // rows and columns in the middle belong to the quarters on both sides
            for (std::size_t quarter = 0; quarter < 4; ++quarter) {
                const std::size_t northward = row - quarter / 2, west = quarter % 2;
                if (northward > 1) continue;
                hulls[quarter].setCorner(4 * end + 2 * northward, points[west]);
                hulls[quarter].setCorner(4 * end + 2 * northward + 1, points[west + 1]);
            }
        }
    }
    return hulls;
}

BinBall ballAround(const Ellipsoid& ellipsoid, const GeodeticBin& bin, double margin, const Frame& frame) noexcept {
    // from the middle along its meridian, along a parallel and along a vertical
    const Interval &latitude = bin.latitude(), &altitude = bin.altitude();
    const double middle = latitude.middle(), north = 0.5 * latitude.width(), east = 0.5 * bin.longitude().width();
    const glm::dvec3 centre = ellipsoid.toEcef({middle, bin.longitude().middle(), altitude.middle()});
    const double radius = largestRadius(ellipsoid, altitude);
    const double axisward = ellipsoid.isPlane() ? 1.0 : std::min(1.0, std::cos(middle) + north);
    const double reach = radius * (north + axisward * east + 32.0 * kEpsilon) + 0.5 * altitude.width() + margin;
    return {along(frame, centre - frame.origin), reach};
}

}  // namespace osgAnalyticBin::core
