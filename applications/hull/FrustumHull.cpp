// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "FrustumHull.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgAnalyticBin::hull {

namespace {

// Rounding of a mixture of three planes, in units of epsilon times its terms; doc/theory/horizon.md, section 6.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
// Three planes closer to sharing a line than this have no corner.
constexpr double kSmallestDeterminant = 1e-12;
// Corners are computed without error bounds: the proofs do not depend on them.
constexpr double kCornerTolerance = 1e-9;

}  // namespace

void FrustumHull::findCorners() noexcept {
    for (std::size_t i = 0; i < _planeCount; ++i)
        for (std::size_t j = i + 1; j < _planeCount; ++j)
            for (std::size_t k = j + 1; k < _planeCount; ++k) addCorner(i, j, k);
}

void FrustumHull::addCorner(std::size_t i, std::size_t j, std::size_t k) noexcept {
    const glm::dvec3 jk = glm::cross(_planes[j].normal, _planes[k].normal);
    const glm::dvec3 ki = glm::cross(_planes[k].normal, _planes[i].normal);
    const glm::dvec3 ij = glm::cross(_planes[i].normal, _planes[j].normal);
    const double determinant = glm::dot(_planes[i].normal, jk);
    if (!(std::abs(determinant) > kSmallestDeterminant) || _cornerCount == kMostCorners) return;
    Corner corner;
    corner.planes = {i, j, k};
    corner.weights = glm::dmat3(jk / determinant, ki / determinant, ij / determinant);
    corner.point = -(_planes[i].offset * corner.weights[0] + _planes[j].offset * corner.weights[1] +
                     _planes[k].offset * corner.weights[2]);
    const double tolerance = kCornerTolerance * glm::length(corner.point);
    for (std::size_t p = 0; p < _planeCount; ++p) {
        const bool own = p == i || p == j || p == k;
        if (!own && !(_planes[p].distance(corner.point) >= -tolerance)) return;
    }
    _corners[_cornerCount++] = corner;
}

bool FrustumHull::isBehind(const core::Plane& face, double reach) const noexcept {
    for (std::size_t i = 0; i < _cornerCount; ++i)
        if (!(face.distance(_corners[i].point) < 0.0)) return false;
    for (std::size_t i = 0; i < _cornerCount; ++i)
        if (proves(_corners[i], face, reach)) return true;
    return false;
}

// The frustum is inside any mixture of its planes with weights >= 0. If the mixture's normal is the face's reversed,
// and its own side begins beyond the face, nothing before the face is in the frustum.
bool FrustumHull::proves(const Corner& corner, const core::Plane& face, double reach) const noexcept {
    core::Plane mixture{glm::dvec3(0.0), 0.0};
    double magnitude = std::abs(face.offset) + reach;
    for (std::size_t i = 0; i < 3; ++i) {
        const core::Plane& plane = _planes[corner.planes[i]];
        const double weight = -glm::dot(corner.weights[glm::length_t(i)], face.normal);
        if (!(weight >= -kCornerTolerance)) return false;
        const double share = std::max(0.0, weight);
        mixture.normal += share * plane.normal;
        mixture.offset += share * plane.offset;
        magnitude += share * (std::abs(plane.offset) + reach);
    }
    const double mismatch = glm::length(mixture.normal + face.normal) * reach;
    return mixture.offset + face.offset + mismatch + kRounding * magnitude < 0.0;
}

ReverseBin::ReverseBin(const core::ExactGeodeticBin& exact, const core::GeodeticBin& bin) noexcept
    : _reach(exact.reach()) {
    const double west = bin.longitude().lower;
    const double east = bin.longitude().upper;
    const core::Geodetic middle = bin.center();
    const glm::dvec3 radial(std::cos(middle.longitude), std::sin(middle.longitude), 0.0);
    const auto up = [&](double p) { return std::cos(p) * radial + glm::dvec3(0.0, 0.0, std::sin(p)); };
    const auto north = [&](double p) { return -std::sin(p) * radial + glm::dvec3(0.0, 0.0, std::cos(p)); };
    addFace(exact, up(middle.latitude));
    addFace(exact, -north(bin.latitude().lower));
    addFace(exact, north(bin.latitude().upper));
    if (!(bin.longitude().width() < glm::pi<double>())) return;
    addFace(exact, {std::sin(west), -std::cos(west), 0.0});
    addFace(exact, {-std::sin(east), std::cos(east), 0.0});
}

void ReverseBin::addFace(const core::ExactGeodeticBin& exact, const glm::dvec3& outward) noexcept {
    _faces[_faceCount++] = {-outward, exact.distanceRange({outward, 0.0}).upper};
}

}  // namespace osgAnalyticBin::hull
