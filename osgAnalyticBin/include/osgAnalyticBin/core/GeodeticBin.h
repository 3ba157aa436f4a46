// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Ellipsoid.h>

#include <algorithm>
#include <array>
#include <limits>

namespace osgAnalyticBin::core {

/// A closed interval; empty when lower > upper.
struct Interval {
    /// The lower end.
    double lower = 0.0;
    /// The upper end.
    double upper = 0.0;

    /// Holds no number.
    [[nodiscard]] static constexpr Interval none() noexcept {
        return {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    }

    /// Negative when empty.
    [[nodiscard]] double width() const noexcept { return upper - lower; }
    /// Requires: not empty.
    [[nodiscard]] double middle() const noexcept { return 0.5 * (lower + upper); }
    /// Ends are contained.
    [[nodiscard]] bool contains(double value) const noexcept { return lower <= value && value <= upper; }
    /// Whether both ends of the other are contained.
    [[nodiscard]] bool contains(const Interval& other) const noexcept {
        return lower <= other.lower && other.upper <= upper;
    }
    /// How much of it both have in common; negative: how far they are apart. Requires: neither is empty.
    [[nodiscard]] double overlap(const Interval& other) const noexcept {
        return std::min(upper, other.upper) - std::max(lower, other.lower);
    }
    /// The smallest interval that holds both.
    [[nodiscard]] Interval united(const Interval& other) const noexcept {
        return {std::min(lower, other.lower), std::max(upper, other.upper)};
    }
    /// NaN changes nothing.
    void expandBy(double value) noexcept { *this = united({value, value}); }
    /// Whether both ends are the same numbers.
    [[nodiscard]] bool operator==(const Interval& other) const noexcept {
        return lower == other.lower && upper == other.upper;
    }
};

/// A box in latitude, longitude (radians) and altitude (metres above the ellipsoid): the analytic bin of a tile.
/// Latitudes lie in [-pi/2, pi/2]. A longitude interval runs eastward from its lower to its upper end; it may pass
/// the date line by running past pi, and is the whole circle from a width of 2 pi on. Empty, whole-globe,
/// pole-touching and date-line-crossing bins are ordinary values.
/// Source: [JJ] section 2.
class GeodeticBin final {
public:
    /// The empty bin.
    GeodeticBin() noexcept;

    /// Latitudes are clamped to the poles, a longitude width to 2 pi. An interval with NaN, with infinite bounds, or
    /// with lower > upper makes the bin empty. Longitudes beyond 1e6 radians are too inexact and become the whole
    /// circle, so that verdicts stay proofs; tests: GeodeticBin.LongitudesThatAreTooFarAwayAreAll.
    GeodeticBin(Interval latitude, Interval longitude, Interval altitude) noexcept;

    /// Angles in degrees, altitude in metres. The conversion is monotone: bins that share an edge in degrees share
    /// it in radians, bit for bit.
    [[nodiscard]] static GeodeticBin fromDegrees(Interval latitudeDeg, Interval longitudeDeg,
                                                 Interval altitude) noexcept;

    /// Every latitude and longitude, with the given altitudes.
    [[nodiscard]] static GeodeticBin wholeGlobe(Interval altitude) noexcept;

    /// Radians.
    [[nodiscard]] const Interval& latitude() const noexcept { return _latitude; }
    /// Radians; see the class for the date line.
    [[nodiscard]] const Interval& longitude() const noexcept { return _longitude; }
    /// Metres.
    [[nodiscard]] const Interval& altitude() const noexcept { return _altitude; }

    /// Whether it holds no position.
    [[nodiscard]] bool empty() const noexcept { return !(_latitude.lower <= _latitude.upper); }
    /// Whether it runs all the way around the globe.
    [[nodiscard]] bool isFullCircle() const noexcept;

    /// The position in the middle of the three intervals. Requires: not empty.
    [[nodiscard]] Geodetic center() const noexcept;

    /// Guarantee: true for every position of the bin; longitudes are compared modulo 2 pi with a tolerance of 2e-15
    /// (13 nanometres on earth), and of 1.2 epsilon of both longitudes where these are far apart or far from zero.
    [[nodiscard]] bool contains(const Geodetic& position) const noexcept;

    /// True when every position of the other bin lies in this one; every bin contains the empty one.
    [[nodiscard]] bool contains(const GeodeticBin& other) const noexcept;

    /// The smallest bin that holds both, over the shorter of the two ways round the globe. It is wider by the tolerance
    /// of contains() where the longitudes of one bin are shifted by whole turns; tests:
    /// GeodeticBin.UnionHoldsBinsManyTurnsAway.
    [[nodiscard]] GeodeticBin united(const GeodeticBin& other) const noexcept;

    /// Grows to hold the position or the other bin.
    void expandBy(const Geodetic& position) noexcept;
    /// Grows to hold the other bin.
    void expandBy(const GeodeticBin& other) noexcept { *this = united(other); }

    /// The same latitudes and longitudes with other altitudes.
    [[nodiscard]] GeodeticBin withAltitude(Interval altitude) const noexcept;

    /// The four quarters in latitude and longitude: south-west, south-east, north-west, north-east.
    /// Guarantee: neighbours share their edges and the outer edges are this bin's, bit for bit;
    /// tests: GeodeticBin.QuartersNestExactly.
    [[nodiscard]] std::array<GeodeticBin, 4> quarters() const noexcept;

    /// Whether all ends are the same numbers.
    [[nodiscard]] bool operator==(const GeodeticBin& other) const noexcept;
    /// Whether any end differs.
    [[nodiscard]] bool operator!=(const GeodeticBin& other) const noexcept { return !(*this == other); }

private:
    Interval _latitude;
    Interval _longitude;
    Interval _altitude;
};

}  // namespace osgAnalyticBin::core
