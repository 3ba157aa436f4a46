// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include <support/RandomViews.h>

namespace osgAnalyticBin::test {

namespace {

using core::Ellipsoid;
using core::Geodetic;
using core::GeodeticBin;
using core::Plane;

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
