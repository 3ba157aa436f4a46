// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "RivalBins.h"

#include "BinSamples.h"

#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <support/RandomBins.h>

namespace osgAnalyticBin::test {

using core::Ellipsoid;
using core::ExactGeodeticBin;
using core::Geodetic;
using core::GeodeticBin;
using core::Plane;

BoxWithHorizonPoint::BoxWithHorizonPoint(const GeodeticBin& bin, double scale) {
    const Ellipsoid ellipsoid = wgs84();
    const ExactGeodeticBin exact(ellipsoid, bin);
    const Geodetic middle = bin.center();
    const glm::dvec3 radial(std::cos(middle.longitude), std::sin(middle.longitude), 0.0);
    const glm::dvec3 z(0.0, 0.0, 1.0);
    _axes = {glm::cross(z, radial), std::cos(middle.latitude) * z - std::sin(middle.latitude) * radial,
             std::cos(middle.latitude) * radial + std::sin(middle.latitude) * z};
    for (std::size_t i = 0; i < 3; ++i) {
        const double most = exact.support(_axes[i]);
        const double least = -exact.support(-_axes[i]);
        _center += 0.5 * (most + least) * _axes[i];
        _half[i] = 0.5 * (most - least);
    }
    _radii = scale * glm::dvec3(ellipsoid.equatorialRadius(), ellipsoid.equatorialRadius(), ellipsoid.polarRadius());
    const glm::dvec3 direction = glm::normalize(ellipsoid.toEcef({middle.latitude, middle.longitude, 0}) / _radii);
    double farthest = 0.0;
    forSamples(bin, 8, [&](const Geodetic& position) {
        const glm::dvec3 x = ellipsoid.toEcef(position) / _radii;
        const double length = std::max(1.0, glm::length(x));
        const double cosAlpha = glm::dot(x, direction) / glm::length(x);
        const double sinAlpha = std::sqrt(std::max(0.0, 1.0 - cosAlpha * cosAlpha));
        const double inverse = (cosAlpha - sinAlpha * std::sqrt(length * length - 1.0)) / length;
        farthest = inverse > 0.0 ? std::max(farthest, 1.0 / inverse) : 1e30;
        return true;
    });
    _point = farthest < 1e29 ? farthest * direction : glm::dvec3(0.0);
}

bool BoxWithHorizonPoint::keeps(const std::vector<Plane>& planes, const glm::dvec3& eye) const {
    for (const Plane& plane : planes) {
        double reach = 0.0;
        for (std::size_t i = 0; i < 3; ++i) reach += _half[i] * std::abs(glm::dot(plane.normal, _axes[i]));
        if (plane.distance(_center) + reach < 0.0) return false;
    }
    const glm::dvec3 e = eye / _radii;
    const double e2 = glm::dot(e, e) - 1.0;
    if (e2 <= 0.0 || _point == glm::dvec3(0.0)) return true;
    const glm::dvec3 toPoint = _point - e;
    const double along = -glm::dot(toPoint, e);
    return !(along > e2 && along * along > e2 * glm::dot(toPoint, toPoint));
}

bool sphereKeeps(const GeodeticBin& bin, const std::vector<Plane>& planes) {
    const ExactGeodeticBin exact(wgs84(), bin);
    glm::dvec3 least, most;
    for (glm::length_t i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        most[i] = exact.support(axis);
        least[i] = -exact.support(-axis);
    }
    const glm::dvec3 center = 0.5 * (least + most);
    double radius = 0.0;
    forSamples(bin, 8, [&](const Geodetic& position) {
        radius = std::max(radius, glm::distance(center, wgs84().toEcef(position)));
        return true;
    });
    return std::all_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return plane.distance(center) + radius >= 0.0; });
}

}  // namespace osgAnalyticBin::test
