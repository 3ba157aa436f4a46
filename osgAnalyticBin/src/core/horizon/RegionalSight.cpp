// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../Constants.h"
#include "../kernels/ScalarTests.h"

#include <osgAnalyticBin/core/horizon/RegionalSight.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace osgAnalyticBin::core {

namespace {

using PastBorder = RegionalSight::PastBorder;

// Error bound of angles, radians.
constexpr double kRounding = 1e-12;
// Error bound of sums of a few products of sines and cosines.
constexpr double kSlack = 8.0 * kEpsilon;

// The latitude in unit space of the direction of a position (doc/theory/horizon.md, section 2).
double latitudeInUnitSpace(const Ellipsoid& ellipsoid, double latitude, double altitude) {
    const double sine = std::sin(latitude), cosine = std::cos(latitude);
    const double n = ellipsoid.primeVerticalRadius(sine, cosine);
    return std::atan2((n * ellipsoid.squaredRatio() + altitude) * sine / ellipsoid.polarRadius(),
                      (n + altitude) * cosine / ellipsoid.equatorialRadius());
}

// Convex, without the sides that a half-plane cuts off: where normal.v >= least.
void clip(std::vector<glm::dvec2>& polygon, const glm::dvec2& normal, double least) {
    std::vector<glm::dvec2> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = glm::dot(normal, a) - least, db = glm::dot(normal, b) - least;
        if (da >= 0.0) inside.push_back(a);
        if ((da < 0.0) != (db < 0.0)) inside.push_back(a + da / (da - db) * (b - a));
    }
    polygon.swap(inside);
}

// Edges of a convex cone, in order about the direction of the eye: it holds the directions in unit space of all lines
// of sight in the frustum from the eye to the occluder.
std::vector<glm::dvec3> edgesOfSight(const Ellipsoid& ellipsoid, const HorizonEyeData& data, const PlaneSet& frustum) {
    const glm::dvec3 toEye(data.x, data.y, data.z);
    const glm::dvec3 right =
        glm::normalize(glm::cross(toEye, std::abs(toEye.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 ahead = glm::cross(toEye, right);
    constexpr int kCorners = 32;
    const double radius = data.sinDip / std::cos(kPi / kCorners) * (1.0 + kRounding);
    std::vector<glm::dvec2> polygon;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * kPi * i / kCorners;
        polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    const glm::dvec3 radii(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    for (std::size_t i = 0; i < frustum.size(); ++i) {
        const Plane plane = frustum[i];
        // in the space in which the occluder is the unit sphere
        const glm::dvec3 normal = data.scale * radii * plane.normal;
        const double slack = kRounding * (glm::length(normal) / data.cosDip + std::abs(plane.offset));
        const double upward = glm::dot(normal, toEye);
        const double ofEye = upward / data.cosDip + plane.offset;
        if (!(ofEye >= -1e3 * slack)) continue;  // the near plane: sight begins outside
        const double least = -plane.offset - std::max(upward, upward * data.cosDip) - 1e3 * slack;
        // the eye's own direction stays inside
        clip(polygon, {glm::dot(normal, right), glm::dot(normal, ahead)}, std::min(least, 0.0));
    }
    std::vector<glm::dvec3> edges;
    for (const glm::dvec2& corner : polygon)
        edges.push_back(glm::normalize(data.cosDip * toEye + corner.x * right + corner.y * ahead));
    return edges;
}

// The largest latitude in a convex cone in unit space, radians.
double northernmost(const std::vector<glm::dvec3>& edges) {
    double north = -kHalfPi;
    bool holdsPole = true;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const glm::dvec3 &a = edges[i], &b = edges[(i + 1) % edges.size()];
        north = std::max(north, std::asin(std::clamp(a.z, -1.0, 1.0)));
        const glm::dvec3 normal = glm::cross(a, b);
        holdsPole = holdsPole && normal.z >= -kRounding;
        // the great circle's own northernmost direction
        const glm::dvec3 summit = glm::dvec3(0, 0, glm::dot(normal, normal)) - normal.z * normal;
        const bool isBetween =
            glm::dot(glm::cross(a, summit), normal) > 0.0 && glm::dot(glm::cross(summit, b), normal) > 0.0;
        if (isBetween) north = std::max(north, std::atan2(glm::length(glm::dvec2(normal)), std::abs(normal.z)));
    }
    return holdsPole ? kHalfPi : north;
}

// Collects the directions in which an eye sees past borders.
class BordersInSight {
public:
    BordersInSight(const Ellipsoid& ellipsoid, const HorizonEyeData& eye, const PlaneSet& frustum)
        : _ellipsoid(ellipsoid), _frustum(frustum), _eye(eye) {
        // altitudes are between the occluder's and the eye's
        const double larger = std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
        _highest = std::max(0.0, eye.scale / eye.cosDip - 1.0) * larger;
        _lowest = std::min(0.0, eye.scale - 1.0) * larger;
    }

    // Directions and borders are those of the mirrored globe from now on: its northern border is the southern one.
    void mirror() {
        _isMirrored = true;
        _eye.z = -_eye.z;
    }

    // The meridian `turn` radians east of the eye; west if `side` is -1. Returns: false where nothing is held.
    [[nodiscard]] bool addMeridian(double side, double turn) {
        if (!(turn > 0.0)) return false;
        const double longitude = std::atan2(_eye.y, _eye.x) + side * turn;
        const glm::dvec3 normal(std::sin(longitude), -std::cos(longitude), 0.0);
        const double height = glm::dot(normal, toEye());
        // across the border, from the eye
        const glm::dvec3 across = height > 0.0 ? height * toEye() - normal : normal - height * toEye();
        const double distance = glm::length(across);
        const double cosine = (_eye.cosDip * std::abs(height) - kSlack) / (_eye.sinDip * distance);
        if (cosine < 1.0 && (side > 0.0 ? turns().upper : -turns().lower) < turn) return true;
        return add(across / distance, cosine);
    }

    // The parallel of a latitude in radians. Returns: false where nothing is held.
    [[nodiscard]] bool addParallel(double border) {
        if (border >= kHalfPi) return true;
        const double north = std::min(latitudeInUnitSpace(_ellipsoid, border, _lowest),
                                      latitudeInUnitSpace(_ellipsoid, border, _highest)) -
                             kRounding;
        const double sine = std::sin(north);
        if (!(_eye.z < sine - kSlack)) return false;
        // A great circle turns back where it is parallel to the border, or its part that counts ends before.
        double cosine = (sine - _eye.z * _eye.cosDip - kSlack) / (_eye.equatorial * _eye.sinDip);
        if (_eye.z > 0.0) {
            const double touching = std::sqrt((sine - _eye.z - kSlack) * (sine + _eye.z));
            if (touching * _eye.cosDip <= _eye.z * _eye.sinDip) cosine = (touching - kSlack) / _eye.equatorial;
        }
        if (cosine < 1.0 && northernmost(edges()) < north) return true;
        const double x = _eye.x / _eye.equatorial, y = _eye.y / _eye.equatorial;
        return add({-_eye.z * x, -_eye.z * y, _eye.equatorial}, cosine);
    }

    [[nodiscard]] const std::vector<PastBorder>& borders() const { return _borders; }

private:
    [[nodiscard]] glm::dvec3 toEye() const { return {_eye.x, _eye.y, _eye.z}; }

    // Of the cone of all lines of sight in the picture. It costs more than all else, and few eyes are near a border.
    [[nodiscard]] std::vector<glm::dvec3> edges() {
        HorizonEyeData eye = _eye;
        if (_isMirrored) eye.z = -eye.z;
        if (_edges.empty()) _edges = edgesOfSight(_ellipsoid, eye, _frustum);
        std::vector<glm::dvec3> edges = _edges;
        if (!_isMirrored) return edges;
        for (glm::dvec3& edge : edges) edge.z = -edge.z;
        std::reverse(edges.begin(), edges.end());
        return edges;
    }

    // How far to the west and to the east of the eye the lines of sight go; infinite if not known.
    [[nodiscard]] Interval turns() {
        const std::vector<glm::dvec3> edges = this->edges();
        Interval all{0.0, 0.0};
        if (edges.empty()) return {-HUGE_VAL, HUGE_VAL};
        for (const glm::dvec3& edge : edges) {
            const double turn = std::atan2(edge.y * _eye.x - edge.x * _eye.y, edge.x * _eye.x + edge.y * _eye.y);
            if (!(std::abs(turn) < 0.49 * kPi)) return {-HUGE_VAL, HUGE_VAL};
            all = {std::min(all.lower, turn), std::max(all.upper, turn)};
        }
        return {all.lower - kRounding, all.upper + kRounding};
    }

    // The wedge of directions whose angle from `outward`, a unit vector across the direction of the eye, has a cosine
    // above `cosine`.
    [[nodiscard]] bool add(const glm::dvec3& outward, double cosine) {
        if (cosine >= 1.0) return true;
        if (!(cosine > -1.0)) return false;
        const glm::dvec3 across = cosine * glm::cross(toEye(), outward);
        const glm::dvec3 along = std::sqrt((1.0 - cosine) * (1.0 + cosine)) * outward;
        PastBorder border{along - across, along + across, cosine < 0.0};
        if (_isMirrored) border.left.z = -border.left.z;
        if (_isMirrored) border.right.z = -border.right.z;
        _borders.push_back(border);
        return true;
    }

    const Ellipsoid& _ellipsoid;
    const PlaneSet& _frustum;
    HorizonEyeData _eye;
    std::vector<glm::dvec3> _edges;  // not mirrored; empty: not asked for yet
    double _lowest = 0.0, _highest = 0.0;
    bool _isMirrored = false;
    std::vector<PastBorder> _borders;
};

// The numbers of a bin in a row of bins.
struct Numbers {
    const double* first;
    std::size_t stride;
    double operator[](std::size_t row) const { return first[row * stride]; }
};

// Whether all directions of a bin, margin included, are behind a plane through the centre.
bool isBehind(const glm::dvec3& normal, const Numbers& bin) {
    const double equatorial = std::sqrt(normal.x * normal.x + normal.y * normal.y);
    const auto largest = kernels::scalar::largestCosine<double>(bin, normal.x, normal.y, normal.z, equatorial);
    return std::max(largest.south, largest.north) < -bin[row::SinMargin] - kernels::scalar::kCosineSlack;
}

bool isOutside(const PastBorder& border, const Numbers& bin) {
    const bool isBehindOne = isBehind(border.left, bin);
    return isBehindOne != border.isReflex ? isBehindOne : isBehind(border.right, bin);
}

}  // namespace

std::optional<RegionalSight> RegionalSight::from(const HorizonEye& eye, const CoveredRegion& region,
                                                 const PlaneSet& frustum) noexcept {
    const HorizonEyeData& data = eye.data();
    const GeodeticBin& extents = region.extents();
    if (extents.empty() || !(data.cosDip > 0.0)) return std::nullopt;
    BordersInSight borders(region.ellipsoid(), data, frustum);
    if (!extents.isFullCircle()) {
        const double half = 0.5 * extents.longitude().width() - kRounding;
        const double aside = std::remainder(std::atan2(data.y, data.x) - extents.longitude().middle(), 2.0 * kPi);
        if (!borders.addMeridian(1.0, half - aside) || !borders.addMeridian(-1.0, half + aside)) return std::nullopt;
    }
    if (!borders.addParallel(extents.latitude().upper)) return std::nullopt;
    borders.mirror();
    if (!borders.addParallel(-extents.latitude().lower)) return std::nullopt;
    RegionalSight sight;
    for (const PastBorder& border : borders.borders()) sight._borders[sight._count++] = border;
    return sight;
}

bool RegionalSight::holds(const double* numbers, std::size_t stride) const noexcept {
    const Numbers bin{numbers, stride};
    return std::all_of(_borders.begin(), _borders.begin() + static_cast<std::ptrdiff_t>(_count),
                       [&](const PastBorder& border) { return isOutside(border, bin); });
}

}  // namespace osgAnalyticBin::core
