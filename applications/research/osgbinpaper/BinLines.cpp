// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinLines.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace osgAnalyticBin::paper {

namespace {

constexpr int kSteps = 32;

// From one position of the unit cube straight to another.
Polyline lineBetween(const SharePoint& point, const glm::dvec3& from, const glm::dvec3& to) {
    Polyline line;
    for (int i = 0; i <= kSteps; ++i) line.push_back(point(from + (to - from) * (static_cast<double>(i) / kSteps)));
    return line;
}

void addFace(std::vector<Polyline>& lines, const SharePoint& point, double z, int parts) {
    for (int i = 0; i <= parts; ++i) {
        const double share = static_cast<double>(i) / parts;
        lines.push_back(lineBetween(point, {share, 0.0, z}, {share, 1.0, z}));
        lines.push_back(lineBetween(point, {0.0, share, z}, {1.0, share, z}));
    }
}

}  // namespace

std::vector<Polyline> frustumLines(const Camera& camera, double depth) {
    std::vector<Polyline> lines;
    Polyline end;
    for (const glm::dvec3& edge : camera.edges()) {
        lines.push_back({camera.eye, camera.eye + depth * edge});
        end.push_back(camera.eye + depth * edge);
    }
    end.push_back(end.front());
    lines.push_back(end);
    return lines;
}

std::vector<Polyline> binEdges(const SharePoint& point) {
    std::vector<Polyline> lines;
    addFace(lines, point, 0.0, 1);
    addFace(lines, point, 1.0, 1);
    for (const double x : {0.0, 1.0}) {
        for (const double y : {0.0, 1.0}) lines.push_back(lineBetween(point, {x, y, 0.0}, {x, y, 1.0}));
    }
    return lines;
}

std::vector<Polyline> binGrid(const SharePoint& point, int parts) {
    std::vector<Polyline> lines;
    addFace(lines, point, 0.0, parts);
    addFace(lines, point, 1.0, parts);
    return lines;
}

Polyline binCorners(const SharePoint& point) {
    Polyline corners;
    for (int i = 0; i < 8; ++i) corners.push_back(point({i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0}));
    return corners;
}

core::Geodetic positionIn(const core::GeodeticBin& bin, const glm::dvec3& shares) noexcept {
    return {bin.latitude().lower + shares.x * bin.latitude().width(),
            bin.longitude().lower + shares.y * bin.longitude().width(),
            bin.altitude().lower + shares.z * bin.altitude().width()};
}

LocalFrame::LocalFrame(const core::Ellipsoid& ellipsoid, const core::Geodetic& origin) noexcept
    : _origin(ellipsoid.toEcef(origin)) {
    const glm::dvec3 radial(std::cos(origin.longitude), std::sin(origin.longitude), 0.0);
    const glm::dvec3 axis(0.0, 0.0, 1.0);
    _east = glm::cross(axis, radial);
    _north = std::cos(origin.latitude) * axis - std::sin(origin.latitude) * radial;
    _up = std::cos(origin.latitude) * radial + std::sin(origin.latitude) * axis;
}

glm::dvec3 LocalFrame::toLocalKm(const glm::dvec3& ecef) const noexcept {
    const glm::dvec3 offset = (ecef - _origin) * 1e-3;
    return {glm::dot(offset, _east), glm::dot(offset, _north), glm::dot(offset, _up)};
}

std::vector<Polyline> mapped(const std::vector<Polyline>& lines,
                             const std::function<glm::dvec3(const glm::dvec3&)>& map) {
    std::vector<Polyline> result = lines;
    for (Polyline& line : result) {
        for (glm::dvec3& point : line) point = map(point);
    }
    return result;
}

}  // namespace osgAnalyticBin::paper
