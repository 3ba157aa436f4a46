// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// What plates of meshes and plates of grids have in common. Source: doc/theory/occlusion.md, section 3.

#pragma once

#include "../EarthScale.h"
#include "../kernels/OcclusionKernels.h"

#include <osgAnalyticBin/core/Ellipsoid.h>
#include <osgAnalyticBin/core/Frame.h>
#include <osgAnalyticBin/core/GeodeticBin.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace osgAnalyticBin::core {

/// The rim on each side of a cell, as a share of its width. Columns keep out of it.
inline constexpr double kRim = 1.0 / 64.0;

/// @{
/// Shares of a rim: triangles that reach no farther into a cell do not count for it; meshes are drawn no farther away
/// from their place; chords of columns bulge no farther out of the cell.
inline constexpr double kReachOfRim = 0.5, kMarginOfRim = 0.1, kBulgeOfRim = 0.4;
/// @}

/// Cells a side.
inline constexpr std::array<std::size_t, 4> kCellsOfGrids{1, 2, 4, 8};

/// What is no farther within the extents than this share of their width does not count for any cell.
inline constexpr double kBorder = kReachOfRim * kRim / static_cast<double>(kCellsOfGrids.back());

/// Of the cells of a grid in the row of all cells of all grids.
[[nodiscard]] constexpr std::size_t firstNumber(std::size_t cells) {
    return (cells * cells - 1) / 3;  // 0, 1, 5, 21
}
[[nodiscard]] constexpr std::size_t numberOf(std::size_t cells, std::size_t row, std::size_t column) {
    return firstNumber(cells) + row * cells + column;
}

/// The cells of a grid along one axis that an interval meets, first to last; first > last: none.
struct CellRange {
    std::ptrdiff_t first, last;
};

/// A cell counts where what is farther within its edges than kReachOfRim is met.
[[nodiscard]] inline CellRange cellsIn(const Interval& extents, std::size_t cells, const Interval& met) {
    constexpr double kInset = kReachOfRim * kRim;
    const auto most = static_cast<double>(cells);
    const double perCell = most / extents.width();
    const double from = (met.lower - extents.lower) * perCell + kInset;
    const double end = (met.upper - extents.lower) * perCell - kInset + 1.0;
    return {static_cast<std::ptrdiff_t>(std::clamp(from, 0.0, most)),
            static_cast<std::ptrdiff_t>(std::clamp(end, 0.0, most)) - 1};
}

/// What comes nearer to a part of the extents than this share of their width counts for it.
inline constexpr double kRoomOfPart = 0.06;

/// Calls visit(part) for each part of the extents that what lies between these latitudes and longitudes counts for.
/// Parts are numbered as in GroundPlates; the outer ones have no outer border.
template <class Visit>
void forEachPart(const Interval& latitude, const Interval& longitude, const Interval& metLatitude,
                 const Interval& metLongitude, Visit&& visit) {
    const auto metStrips = [](const Interval& extents, const Interval& met) {
        const double room = kRoomOfPart * extents.width(), quarter = 0.25 * extents.width();
        std::array<bool, 4> areMet;
        for (std::size_t i = 0; i < areMet.size(); ++i) {
            const double from = extents.lower + quarter * static_cast<double>(i);
            const bool isBelow = i + 1 < areMet.size() && met.lower > from + quarter + room;
            areMet[i] = !isBelow && !(i > 0 && met.upper < from - room);
        }
        return areMet;
    };
    const std::array<bool, 4> rows = metStrips(latitude, metLatitude), columns = metStrips(longitude, metLongitude);
    for (std::size_t part = 0; part < rows.size() * columns.size(); ++part) {
        const std::size_t quarter = part / 4, within = part % 4;
        if (rows[quarter / 2 * 2 + within / 2] && columns[quarter % 2 * 2 + within % 2]) visit(part);
    }
}

/// The sine and the cosine of the middle of some latitudes, then those of some longitudes.
[[nodiscard]] inline std::array<double, 4> sinesOfMiddle(const Interval& latitude, const Interval& longitude) {
    return {std::sin(latitude.middle()), std::cos(latitude.middle()), std::sin(longitude.middle()),
            std::cos(longitude.middle())};
}

/// What the kernel for the corners of cells reads. `sines`: sinesOfMiddle(); `depth`: metres, of the columns.
[[nodiscard]] inline kernels::CellGround cellGround(const Ellipsoid& ellipsoid, const Interval& latitude,
                                                    const Interval& longitude, const std::array<double, 4>& sines,
                                                    double depth, const InverseFrame& frame) {
    return {ellipsoid.isPlane(),
            ellipsoid.equatorialRadius(),
            ellipsoid.squaredRatio(),
            latitude.middle(),
            longitude.middle(),
            sines[0],
            sines[1],
            sines[2],
            sines[3],
            latitude.width(),
            longitude.width(),
            depth,
            {frame.x.x, frame.x.y, frame.x.z},
            {frame.y.x, frame.y.y, frame.y.z},
            {frame.z.x, frame.z.y, frame.z.z},
            {frame.origin.x, frame.origin.y, frame.origin.z}};
}

/// Metres of a point from the axis. A plane has none: as far away as it is on large ellipsoids.
[[nodiscard]] inline double axisDistanceOf(const Ellipsoid& ellipsoid, const glm::dvec3& point) {
    return ellipsoid.isPlane() ? ellipsoid.equatorialRadius() : std::sqrt(point.x * point.x + point.y * point.y);
}

/// Metres of the longest side of a triangle, and of the longest one along the horizon and along the vertical, wherever
/// in the triangle these are measured.
struct TriangleSides {
    double longest, horizontal, vertical;

    /// From what is measured at the corners. Across a triangle both directions turn by at most its width over
    /// `radius`, which is no larger than a radius of curvature of the ellipsoid.
    [[nodiscard]] static TriangleSides atAnyPoint(double longest, double horizontal, double vertical, double radius) {
        const double turn = 2.0 * longest * longest / radius;
        return {longest, horizontal + turn, vertical + turn};
    }
};

/// How far a triangle may reach beyond the altitudes, latitudes and longitudes of its corners.
struct TriangleReach {
    double sag;     ///< metres below the lowest corner
    double aside;   ///< radians of latitude
    double around;  ///< radians of longitude

    /// `radius`: no larger than a radius of curvature at any point of the triangle; `axisDistance`: no larger than that
    /// of any point.
    TriangleReach(const TriangleSides& sides, const Ellipsoid& ellipsoid, double radius, double axisDistance) {
        const double horizontal2 = sides.horizontal * sides.horizontal, mixed = 2.0 * sides.horizontal * sides.vertical;
        const double secant = 1.2 * largestCurvatureRadius(ellipsoid) / axisDistance;
        sag = horizontal2 / (6.0 * radius);
        aside = 1.1 * (mixed + secant * horizontal2) / (6.0 * radius * radius);
        around = mixed / (6.0 * axisDistance * axisDistance);
    }

    /// Whether triangles are small enough for these bounds to hold.
    [[nodiscard]] static bool holdsFor(const TriangleSides& sides, double radius, double axisDistance,
                                       double widthInLongitude, const Interval& altitude) {
        return sides.longest <= 0.05 * std::min(axisDistance, radius) && widthInLongitude < 0.2 &&
               altitude.lower > -0.1 * radius && altitude.upper < 0.1 * radius;
    }
};

}  // namespace osgAnalyticBin::core
