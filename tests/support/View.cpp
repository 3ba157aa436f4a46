// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <ccd/ccd.h>

#include <support/View.h>

namespace osgAnalyticBin::test {

namespace {

using core::Ellipsoid;
using core::Geodetic;
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

glm::dvec3 radiiOf(const Ellipsoid& ellipsoid) {
    return {ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius()};
}

double scaleOf(const Ellipsoid& ellipsoid, double depth) {
    const glm::dvec3 radii = radiiOf(ellipsoid);
    return 1.0 - depth / (depth >= 0.0 ? std::min(radii.x, radii.z) : std::max(radii.x, radii.z));
}

// Up, east, west, north or south, more or less.
glm::dvec3 awayFromAFace(Random& random, const glm::dvec3& position) {
    const glm::dvec3 up = glm::normalize(position);
    const glm::dvec3 east = glm::normalize(glm::dvec3(-up.y, up.x, 0.0) + 1e-9 * random.direction());
    const std::array<glm::dvec3, 5> faces{up, east, -east, glm::cross(up, east), glm::cross(east, up)};
    return random.pick(faces) + random.uniform(0.0, 0.5) * random.direction();
}

double randomMargin(Random& random) {
    return random.chance(0.7) ? 0.0 : random.logUniform(1e-3, 1e4);
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

    const Geodetic center = bin.center();
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

double randomDepth(Random& random) noexcept {
    switch (random.integer(0, 3)) {
        case 0:
            return random.uniform(-5000.0, 0.0);
        case 1:
            return random.logUniform(1.0, 1e5);
        default:
            return random.uniform(0.0, 12000.0);
    }
}

glm::dvec3 randomEye(Random& random, const Ellipsoid& ellipsoid, double depth) noexcept {
    glm::dvec3 direction = random.direction();
    if (random.chance(0.2)) direction = glm::normalize(glm::dvec3(0.0, 0.0, random.sign()) + 1e-6 * direction);
    const glm::dvec3 onOccluder = scaleOf(ellipsoid, depth) * radiiOf(ellipsoid) * direction;
    switch (random.integer(0, 4)) {
        case 0:
            return onOccluder * (1.0 + random.logUniform(1e-15, 1e-9));
        case 1:
            return onOccluder * (1.0 + random.logUniform(1e-9, 1e-3));
        case 2:
            return 1e9 * direction;
        case 3:
            return onOccluder * random.uniform(0.99, 1.01);
        default:
            return onOccluder * (1.0 + random.logUniform(1e-3, 1e2));
    }
}

RealVector randomPointWithin(Random& random, const Ellipsoid& ellipsoid, const GeodeticBin& bin,
                             double margin) noexcept {
    Geodetic position = randomPosition(random, bin);
    if (random.chance(0.3)) position.altitude = bin.altitude().upper;
    const RealVector point = geodeticToEcef(ellipsoid, position);
    return margin > 0.0 ? point + (margin * (1.0 - 1e-12)) * real(random.direction()) : point;
}

LineOfSight randomLineOfSight(Random& random) noexcept {
    const Ellipsoid ellipsoid = randomEllipsoid(random);
    const GeodeticBin bin = randomBin(random);
    const double margin = randomMargin(random);
    double depth = randomDepth(random);
    // Points below the occluder's surface are seen by nobody.
    if (random.chance(0.7)) depth = std::max(depth, 1.0 - 1.01 * bin.altitude().lower);
    const RealVector target = randomPointWithin(random, ellipsoid, bin, margin);
    const glm::dvec3 radii = scaleOf(ellipsoid, depth) * radiiOf(ellipsoid);
    const glm::dvec3 from = rounded(target) / radii;
    const double distance = glm::length(from);
    // A point of the occluder where a line from the target touches, lifted by next to nothing.
    const glm::dvec3 axis = from / distance;
    const glm::dvec3 any = random.direction();
    const glm::dvec3 across = glm::normalize(any - glm::dot(any, axis) * axis);
    const double cosine = std::min(1.0, 1.0 / distance);
    const glm::dvec3 touching = cosine * axis + std::sqrt(1.0 - cosine * cosine) * across;
    const glm::dvec3 lifted = touching * (1.0 + random.logUniform(1e-16, 1e-4));
    const double beyond = random.chance(0.2) ? random.uniform(0.1, 1.0) : 1.0 + random.logUniform(1e-9, 1e3);
    return {ellipsoid, bin, margin, depth, target, (from + beyond * (lifted - from)) * radii};
}

View randomView(Random& random, const Ellipsoid& ellipsoid, const GeodeticBin& bin,
                const RealVector& targetPoint) noexcept {
    const double size = sizeOf(ellipsoid, bin);
    const glm::dvec3 target = rounded(targetPoint);
    View view;
    view.eye = target + random.logUniform(0.01, 10.0) * size * random.direction();
    if (random.chance(0.3)) view.eye = randomEye(random, ellipsoid, 0.0);
    const glm::dvec3 toTarget = target - view.eye;
    view.lookAlong(toTarget + random.uniform(0.0, 1.0) * glm::length(toTarget) * random.direction(), random);
    if (random.chance(0.25)) {
        view.eye = target;
        view.lookAlong(awayFromAFace(random, target), random);
    }
    view.orthographic = random.chance(0.25);
    view.halfWidth = view.orthographic ? random.logUniform(0.01, 1.0) * size : random.logUniform(0.005, 2.0);
    if (random.chance(0.5)) view.nearDistance = random.logUniform(1e-3, 1.0) * glm::length(toTarget);
    if (random.chance(0.5)) {
        view.farDistance = std::max(view.nearDistance, 0.0) + random.logUniform(0.1, 10.0) * glm::length(toTarget);
    }
    return view;
}

void moveToHold(Random& random, const RealVector& point, double size, std::vector<Plane>& planes) noexcept {
    const double most = random.chance(0.5) ? size : std::min(size, 1e-6);
    for (Plane& plane : planes) {
        const Real distance = exactDistance(plane, point);
        if (distance >= 0 && random.chance(0.5)) continue;
        plane.offset = static_cast<double>(plane.offset - distance) + random.logUniform(1e-9, most);
        // The offset itself is rounded; one unit in its last place more makes the point a point of the frustum.
        while (exactDistance(plane, point) < 0) plane.offset += std::abs(plane.offset) * 1e-15;
    }
}

}  // namespace osgAnalyticBin::test
