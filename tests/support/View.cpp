// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <ccd/ccd.h>

#include <support/View.h>

namespace osgAnalyticBin::test {

namespace {

using core::Ellipsoid;
using core::GeodeticBin;
using core::Plane;

// The frustum is cut this much beyond the farthest point of the bin.
constexpr double kBeyond = 1.001;
constexpr unsigned long kMostIterations = 200;

Plane through(const glm::dvec3& inward, const glm::dvec3& point) {
    const glm::dvec3 normal = glm::normalize(inward);
    return {normal, -glm::dot(normal, point)};
}

// The angle of an interval where cos(angle - at) is largest.
Real nearestAngle(Real at, Real lower, Real upper) {
    const Real turn = 8 * std::atan(Real{1});
    const Real offset = std::fmod(std::fmod(at - lower, turn) + turn, turn);
    if (offset <= upper - lower) return lower + offset;
    return std::cos(at - lower) > std::cos(at - upper) ? lower : upper;
}

struct ScaledBin {
    const Ellipsoid* ellipsoid;
    const GeodeticBin* bin;
    RealVector origin;
    Real unit;
};

struct CutFrustum {
    std::array<RealVector, 8> corners;
};

RealVector local(const ScaledBin& frame, const RealVector& x) {
    return (1 / frame.unit) * (x - frame.origin);
}

void toCcd(const RealVector& v, ccd_vec3_t* out) {
    ccdVec3Set(out, static_cast<ccd_real_t>(v.x), static_cast<ccd_real_t>(v.y), static_cast<ccd_real_t>(v.z));
}

RealVector fromCcd(const ccd_vec3_t* v) {
    return {v->v[0], v->v[1], v->v[2]};
}

void supportOfBin(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const auto& frame = *static_cast<const ScaledBin*>(object);
    toCcd(local(frame, farthestPoint(*frame.ellipsoid, *frame.bin, fromCcd(direction))), point);
}

void supportOfFrustum(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    const auto& frustum = *static_cast<const CutFrustum*>(object);
    const RealVector d = fromCcd(direction);
    const auto* best = &frustum.corners[0];
    for (const RealVector& corner : frustum.corners) {
        if (dot(corner, d) > dot(*best, d)) best = &corner;
    }
    toCcd(*best, point);
}

RealVector toUnitSpace(const Ellipsoid& ellipsoid, double depth, const RealVector& v) {
    const Real smaller = std::min(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    const Real larger = std::max(ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    const Real scale = 1 - depth / (depth >= 0.0 ? smaller : larger);
    const Real a = scale * ellipsoid.equatorialRadius();
    return {v.x / a, v.y / a, v.z / (scale * ellipsoid.polarRadius())};
}

// The least squared distance from the origin of from + t step, 0 <= t <= most.
Real leastSquare(const RealVector& from, const RealVector& step, Real most) {
    const Real square = dot(step, step);
    const Real t = square > 0 ? std::clamp<Real>(-dot(from, step) / square, 0, most) : 0;
    const RealVector nearest = from + t * step;
    return dot(nearest, nearest);
}

}  // namespace

void View::lookAlong(const glm::dvec3& direction, Random& random) noexcept {
    forward = glm::normalize(direction);
    right = glm::cross(forward, random.direction());
    right = glm::normalize(right - glm::dot(right, forward) * forward);
    up = glm::cross(right, forward);
}

std::vector<Plane> View::planes() const {
    std::vector<Plane> result;
    for (const glm::dvec3& side : {right, -right, up, -up}) {
        if (orthographic) {
            result.push_back(through(side, eye - halfWidth * side));
        } else {
            result.push_back(through(side + halfWidth * forward, eye));
        }
    }
    if (std::isfinite(nearDistance)) result.push_back(through(forward, eye + nearDistance * forward));
    if (std::isfinite(farDistance)) result.push_back(through(-forward, eye + farDistance * forward));
    return result;
}

RealVector farthestPoint(const Ellipsoid& ellipsoid, const GeodeticBin& bin, const RealVector& direction) noexcept {
    const Real longitude =
        nearestAngle(std::atan2(direction.y, direction.x), bin.longitude().lower, bin.longitude().upper);
    const Real c = direction.x * std::cos(longitude) + direction.y * std::sin(longitude);
    const Real latitude = nearestAngle(std::atan2(direction.z, c), bin.latitude().lower, bin.latitude().upper);
    RealVector best;
    Real most = -std::numeric_limits<Real>::infinity();
    for (const Real p : {latitude, static_cast<Real>(bin.latitude().lower), static_cast<Real>(bin.latitude().upper)}) {
        for (const double h : {bin.altitude().lower, bin.altitude().upper}) {
            const RealVector x = geodeticToEcef(ellipsoid, p, longitude, h);
            if (dot(x, direction) <= most) continue;
            most = dot(x, direction);
            best = x;
        }
    }
    return best;
}

bool hullsMeet(const Ellipsoid& ellipsoid, const GeodeticBin& bin, const View& view) {
    const RealVector eye = real(view.eye);
    const RealVector forward = real(view.forward);
    const Real deepest = dot(farthestPoint(ellipsoid, bin, forward) - eye, forward);
    const Real nearest = dot(farthestPoint(ellipsoid, bin, Real{-1} * forward) - eye, forward);
    Real from = view.orthographic ? nearest - (deepest - nearest) - 1 : 0;
    from = std::max<Real>(from, view.nearDistance);
    const Real to = std::min<Real>(deepest + (kBeyond - 1) * std::abs(deepest), view.farDistance);
    if (to <= from) return false;

    const core::Geodetic center = bin.center();
    const RealVector origin = geodeticToEcef(ellipsoid, center);
    const Real size = std::max(length(farthestPoint(ellipsoid, bin, real(view.right)) - origin), deepest - nearest);
    const ScaledBin frame{&ellipsoid, &bin, origin, std::max<Real>(size, 1)};
    CutFrustum frustum;
    for (std::size_t i = 0; i < 8; ++i) {
        const Real depth = i & 4 ? to : from;
        const Real half = view.orthographic ? Real{view.halfWidth} : depth * view.halfWidth;
        const RealVector corner =
            eye + depth * forward + (i & 1 ? half : -half) * real(view.right) + (i & 2 ? half : -half) * real(view.up);
        frustum.corners[i] = local(frame, corner);
    }
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = supportOfBin;
    ccd.support2 = supportOfFrustum;
    ccd.max_iterations = kMostIterations;
    return ccdGJKIntersect(&frame, &frustum, &ccd) != 0;
}

bool segmentMissesOccluder(const Ellipsoid& ellipsoid, double depth, const RealVector& from,
                           const RealVector& to) noexcept {
    const RealVector a = toUnitSpace(ellipsoid, depth, from);
    return leastSquare(a, toUnitSpace(ellipsoid, depth, to) - a, 1) > 1;
}

bool halfLineMissesOccluder(const Ellipsoid& ellipsoid, double depth, const RealVector& from,
                            const RealVector& direction) noexcept {
    return leastSquare(toUnitSpace(ellipsoid, depth, from), toUnitSpace(ellipsoid, depth, direction),
                       std::numeric_limits<Real>::max()) > 1;
}

}  // namespace osgAnalyticBin::test
