// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Camera.h"
#include "Gnuplot.h"

#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/vec3.hpp>

#include <functional>
#include <vector>

namespace osgAnalyticBin::paper {

/// Where a point of a bin is drawn: its shares of the bin's latitudes, longitudes and altitudes, from 0 to 1.
using SharePoint = std::function<glm::dvec3(const glm::dvec3& shares)>;

/// The pyramid of sight of a camera: its four edges, and its end in a depth of so many metres.
[[nodiscard]] std::vector<Polyline> frustumLines(const Camera& camera, double depth);

/// The twelve edges of a bin as polylines.
[[nodiscard]] std::vector<Polyline> binEdges(const SharePoint& point);

/// Lines across the top and the bottom, so many parts each way, its edges among them.
[[nodiscard]] std::vector<Polyline> binGrid(const SharePoint& point, int parts);

/// The eight corners.
[[nodiscard]] Polyline binCorners(const SharePoint& point);

/// The position at shares of a bin. Requires: not empty.
[[nodiscard]] core::Geodetic positionIn(const core::GeodeticBin& bin, const glm::dvec3& shares) noexcept;

/// East, north and up in km, as seen from a point of the globe.
class LocalFrame final {
public:
    LocalFrame(const core::Ellipsoid& ellipsoid, const core::Geodetic& origin) noexcept;

    [[nodiscard]] glm::dvec3 toLocalKm(const glm::dvec3& ecef) const noexcept;

private:
    glm::dvec3 _origin, _east, _north, _up;
};

/// The same for points of polylines.
[[nodiscard]] std::vector<Polyline> mapped(const std::vector<Polyline>& lines,
                                           const std::function<glm::dvec3(const glm::dvec3&)>& map);

}  // namespace osgAnalyticBin::paper
