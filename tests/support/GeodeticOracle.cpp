// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <support/GeodeticOracle.h>

namespace osgAnalyticBin::test {

namespace {

constexpr Real kRounding = 64 * std::numeric_limits<Real>::epsilon();
// The last step of climbing is 2^-24 of a cell; the value errs by its square.
constexpr int kHalvings = 24;
constexpr int kMostSteps = 1000;
// Wider than this, longitudes are cut into parts.
constexpr double kWidestPart = 3.0;

Real squaredRatio(const core::Ellipsoid& ellipsoid) {
    const Real ratio = static_cast<Real>(ellipsoid.polarRadius()) / ellipsoid.equatorialRadius();
    return ratio * ratio;
}

// The radius of curvature across the meridian, without the differences that cancel on flat ellipsoids.
Real primeVerticalRadius(const core::Ellipsoid& ellipsoid, Real sine, Real cosine) {
    return ellipsoid.equatorialRadius() / std::sqrt(cosine * cosine + squaredRatio(ellipsoid) * sine * sine);
}

// Pattern search: the best of the neighbours at shrinking steps, within the bin.
Real climbed(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, const core::Plane& plane, Real sign,
             std::array<Real, 3> at, std::array<Real, 3> step) {
    const std::array<core::Interval, 3> box{bin.latitude(), bin.longitude(), bin.altitude()};
    const auto valueAt = [&](const std::array<Real, 3>& x) {
        return sign * exactDistance(plane, geodeticToEcef(ellipsoid, x[0], x[1], x[2]));
    };
    Real best = valueAt(at);
    for (int steps = 0, halvings = 0; halvings < kHalvings && steps < kMostSteps; ++steps) {
        const std::array<Real, 3> from = at;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const Real side : {Real{-1}, Real{1}}) {
                std::array<Real, 3> x = from;
                x[axis] += side * step[axis];
                const bool goesRound = axis == 1 && bin.isFullCircle();
                if (!goesRound) x[axis] = std::clamp<Real>(x[axis], box[axis].lower, box[axis].upper);
                const Real value = valueAt(x);
                if (value > best) {
                    best = value;
                    at = x;
                }
            }
        }
        if (at != from) continue;
        ++halvings;
        for (Real& s : step) s /= 2;
    }
    return sign * best;
}

}  // namespace

Real length(const RealVector& a) noexcept {
    return std::sqrt(dot(a, a));
}

glm::dvec3 rounded(const RealVector& v) noexcept {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

RealVector geodeticToEcef(const core::Ellipsoid& ellipsoid, Real latitude, Real longitude, Real altitude) noexcept {
    const Real sine = std::sin(latitude);
    const Real cosine = std::cos(latitude);
    const Real n = primeVerticalRadius(ellipsoid, sine, cosine);
    const Real rho = (n + altitude) * cosine;
    return {rho * std::cos(longitude), rho * std::sin(longitude), (n * squaredRatio(ellipsoid) + altitude) * sine};
}

namespace {

// Of an ellipsoid far from a sphere, by Newton's steps within a shrinking bracket: in the quadrant of the point, the
// reduced latitude t of its foot is the only zero of a rho sin t - b z cos t - (a2 - b2) sin t cos t.
Real latitudeByBracket(const core::Ellipsoid& ellipsoid, Real rho, Real z) noexcept {
    const Real a = ellipsoid.equatorialRadius();
    const Real b = ellipsoid.polarRadius();
    Real south = 0;
    Real north = std::atan2(Real(1), Real(0));
    Real t = std::atan2(b * std::abs(z), a * rho);
    for (int i = 0; i < 100; ++i) {
        const Real sine = std::sin(t);
        const Real cosine = std::cos(t);
        const Real value = a * rho * sine - b * std::abs(z) * cosine - (a * a - b * b) * sine * cosine;
        const Real slope =
            a * rho * cosine + b * std::abs(z) * sine - (a * a - b * b) * (cosine - sine) * (cosine + sine);
        (value > 0 ? north : south) = t;
        Real next = t - value / slope;
        if (!(next >= south && next <= north)) next = (south + north) / 2;
        if (next == t) break;
        t = next;
    }
    return std::copysign(std::atan2(a * std::sin(t), b * std::cos(t)), z);
}

}  // namespace

// Fixed point of tan(latitude) = (z + N e2 sin(latitude)) / rho; not the iteration of the core.
RealGeodetic ecefToGeodetic(const core::Ellipsoid& ellipsoid, const RealVector& point) noexcept {
    const Real e2 = 1 - squaredRatio(ellipsoid);
    const Real a = ellipsoid.equatorialRadius();
    const Real rho = std::hypot(point.x, point.y);
    Real latitude = std::atan2(point.z, rho * (1 - e2));
    const bool converges = std::abs(e2) < Real(0.3);
    if (!converges) latitude = latitudeByBracket(ellipsoid, rho, point.z);
    for (int i = 0; i < 200 && converges; ++i) {
        const Real sine = std::sin(latitude);
        const Real next = std::atan2(point.z + a / std::sqrt(1 - e2 * sine * sine) * e2 * sine, rho);
        if (next == latitude) break;
        latitude = next;
    }
    const Real sine = std::sin(latitude);
    const Real cosine = std::cos(latitude);
    const Real altitude = rho * cosine + point.z * sine - a * a / primeVerticalRadius(ellipsoid, sine, cosine);
    return {latitude, rho > 0 ? std::atan2(point.y, point.x) : 0, altitude};
}

Real exactDistance(const core::Plane& plane, const RealVector& point) noexcept {
    return dot(real(plane.normal), point) + plane.offset;
}

BinOracle::BinOracle(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin) noexcept
    : _ellipsoid(ellipsoid),
      _bin(bin),
      _fullCircle(bin.isFullCircle()),
      _a2(static_cast<Real>(ellipsoid.equatorialRadius()) * ellipsoid.equatorialRadius()),
      _b2(static_cast<Real>(ellipsoid.polarRadius()) * ellipsoid.polarRadius()),
      _parts(bin.longitude().width() > kWidestPart ? kMostParts : 1),
      _longitudes(),
      _latitudes(),
      _rho(),
      _height() {
    const Real west = bin.longitude().lower;
    const Real width = static_cast<Real>(bin.longitude().upper) - west;
    for (std::size_t i = 0; i <= _parts; ++i) {
        const Real longitude = west + width * static_cast<Real>(i) / static_cast<Real>(_parts);
        _longitudes[i] = {std::sin(longitude), std::cos(longitude)};
    }
    const std::array<Real, 2> edges{bin.latitude().lower, bin.latitude().upper};
    for (std::size_t i = 0; i < 2; ++i) {
        _latitudes[i] = {std::sin(edges[i]), std::cos(edges[i])};
        const Real n = primeVerticalRadius(ellipsoid, _latitudes[i].sine, _latitudes[i].cosine);
        _rho[i] = n * _latitudes[i].cosine;
        _height[i] = n * squaredRatio(ellipsoid) * _latitudes[i].sine;
    }
}

// The maximum of x cos l + y sin l over the longitudes.
Real BinOracle::largestAlongParallel(Real x, Real y) const noexcept {
    if (_fullCircle) return std::hypot(x, y);
    Real largest = -std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i <= _parts; ++i) {
        const Angle& from = _longitudes[i];
        largest = std::max(largest, x * from.cosine + y * from.sine);
        if (i == _parts) break;
        const Angle& to = _longitudes[i + 1];
        if (y * from.cosine - x * from.sine > 0 && y * to.cosine - x * to.sine < 0) return std::hypot(x, y);
    }
    return largest;
}

Real BinOracle::maximum(const RealVector& direction) const noexcept {
    const Real c = largestAlongParallel(direction.x, direction.y);
    const auto slope = [&](const Angle& p) { return p.cosine * direction.z - p.sine * c; };
    if (slope(_latitudes[0]) > 0 && slope(_latitudes[1]) < 0) {
        return std::sqrt(_a2 * c * c + _b2 * direction.z * direction.z) +
               _bin.altitude().upper * std::hypot(c, direction.z);
    }
    Real largest = -std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < 2; ++i) {
        const Real perMetre = _latitudes[i].cosine * c + _latitudes[i].sine * direction.z;
        const Real altitude = perMetre > 0 ? _bin.altitude().upper : _bin.altitude().lower;
        largest = std::max(largest, _rho[i] * c + _height[i] * direction.z + altitude * perMetre);
    }
    return largest;
}

RealRange BinOracle::range(const glm::dvec3& direction) const noexcept {
    return {-maximum(real(-direction)), maximum(real(direction))};
}

RealRange BinOracle::distanceRange(const core::Plane& plane) const noexcept {
    const RealRange along = range(plane.normal);
    return {along.lower + plane.offset, along.upper + plane.offset};
}

Real BinOracle::rounding(const core::Plane& plane) const noexcept {
    const double altitude = std::max(std::abs(_bin.altitude().lower), std::abs(_bin.altitude().upper));
    const double radius = std::max(_ellipsoid.equatorialRadius(), _ellipsoid.polarRadius());
    return kRounding * (static_cast<Real>(radius) + altitude + std::abs(plane.offset));
}

RealRange sampledDistanceRange(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin, const core::Plane& plane,
                               int steps) {
    const std::array<core::Interval, 3> box{bin.latitude(), bin.longitude(), bin.altitude()};
    // Wide bins may have two hills along a parallel: one in the middle, one at an end.
    const std::array<int, 3> counts{steps, bin.longitude().width() > kWidestPart ? 4 * steps : steps, 1};
    std::array<Real, 3> step{};
    for (std::size_t i = 0; i < 3; ++i) {
        step[i] = (static_cast<Real>(box[i].upper) - box[i].lower) / counts[i];
    }
    RealRange range{std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()};
    // Climbing starts at the best position of every parallel: from a pole, where longitude means nothing, none leads.
    for (int i = 0; i <= counts[0]; ++i) {
        RealRange ofParallel{std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()};
        std::array<Real, 3> lowest{};
        std::array<Real, 3> highest{};
        for (int j = 0; j <= counts[1]; ++j) {
            for (int k = 0; k <= counts[2]; ++k) {
                const std::array<Real, 3> x{box[0].lower + i * step[0], box[1].lower + j * step[1],
                                            box[2].lower + k * step[2]};
                const Real value = exactDistance(plane, geodeticToEcef(ellipsoid, x[0], x[1], x[2]));
                if (value < ofParallel.lower) {
                    ofParallel.lower = value;
                    lowest = x;
                }
                if (value > ofParallel.upper) {
                    ofParallel.upper = value;
                    highest = x;
                }
            }
        }
        range.lower = std::min(range.lower, climbed(ellipsoid, bin, plane, -1, lowest, step));
        range.upper = std::max(range.upper, climbed(ellipsoid, bin, plane, 1, highest, step));
    }
    return range;
}

}  // namespace osgAnalyticBin::test
