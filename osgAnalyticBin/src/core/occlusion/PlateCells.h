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
#include <cstdint>
#include <limits>
#include <tuple>

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

/// The cells of all grids together.
inline constexpr std::size_t kPlateCells = firstNumber(2 * kCellsOfGrids.back());

/// The strips of parts along one axis.
inline constexpr std::size_t kStrips = 4;
/// The part in a row and a column of strips, from the south-west. Parts are numbered as in GroundPlates.
[[nodiscard]] constexpr std::size_t partAt(std::size_t row, std::size_t column) {
    return 4 * (row / 2 * 2 + column / 2) + row % 2 * 2 + column % 2;
}

/// What comes nearer to a part of the extents than this share of their width counts for it.
inline constexpr double kRoomOfPart = 0.06;

/// What something meets along one axis of the extents: of the cells of each grid and, at last, of the strips.
struct MetCells {
    /// More than there are, for vectors.
    using Numbers = std::array<std::uint8_t, 8>;
    static constexpr std::size_t kOfParts = kCellsOfGrids.size();
    static_assert(kOfParts < std::tuple_size<Numbers>::value);

    Numbers first{}, end{};  ///< end <= first: none

    [[nodiscard]] MetCells united(const MetCells& other) const {
        MetCells both;
        for (std::size_t i = 0; i < first.size(); ++i) {
            both.first[i] = std::min(first[i], other.first[i]);
            both.end[i] = std::max(end[i], other.end[i]);
        }
        return both;
    }
};

/// Finds what is met along one axis.
class CellsAlong {
public:
    explicit CellsAlong(const Interval& extents) : _lower(extents.lower), _perWidth(1.0 / extents.width()) {}

    /// A cell counts where what is farther within its edges than kReachOfRim is met, a part where what comes nearer
    /// than kRoomOfPart is. The outer parts have no outer border. An interval meets what its ends meet, and all
    /// between.
    [[nodiscard]] MetCells met(const Interval& between) const {
        const double from = (between.lower - _lower) * _perWidth, to = (between.upper - _lower) * _perWidth;
        MetCells met;
        for (std::size_t i = 0; i < kCellsOfGrids.size(); ++i)
            set(met, i, from, to, static_cast<double>(kCellsOfGrids[i]), kReachOfRim * kRim);
        set(met, MetCells::kOfParts, std::min(from, 1.0), std::max(to, 0.0), kStrips, -kRoomOfPart * kStrips);
        return met;
    }

private:
    // `inset`: of a cell's width.
    static void set(MetCells& met, std::size_t i, double from, double to, double cells, double inset) {
        met.first[i] = static_cast<std::uint8_t>(std::min(std::max(0.0, from * cells + inset), cells));
        met.end[i] = static_cast<std::uint8_t>(std::min(std::max(0.0, to * cells - inset + 1.0), cells));
    }

    double _lower, _perWidth;
};

/// Bounds of the altitudes in each cell and each part, while they are found.
struct PlateBounds {
    std::array<double, kPlateCells> low;
    std::array<double, kStrips * kStrips> high;

    PlateBounds() {
        low.fill(std::numeric_limits<double>::infinity());
        high.fill(-std::numeric_limits<double>::infinity());
    }

    void lower(const MetCells& rows, const MetCells& columns, double altitude) {
        for (std::size_t i = 0; i < kCellsOfGrids.size(); ++i) {
            for (std::size_t row = rows.first[i]; row < rows.end[i]; ++row) {
                for (std::size_t column = columns.first[i]; column < columns.end[i]; ++column) {
                    double& bound = low[numberOf(kCellsOfGrids[i], row, column)];
                    bound = std::min(bound, altitude);
                }
            }
        }
    }
    void raise(const MetCells& rows, const MetCells& columns, double altitude) {
        constexpr std::size_t i = MetCells::kOfParts;
        for (std::size_t row = rows.first[i]; row < rows.end[i]; ++row) {
            for (std::size_t column = columns.first[i]; column < columns.end[i]; ++column) {
                double& bound = high[partAt(row, column)];
                bound = std::max(bound, altitude);
            }
        }
    }
};

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
                                       const Interval& altitude) {
        return sides.longest <= 0.05 * std::min(axisDistance, radius) && altitude.lower > -0.1 * radius &&
               altitude.upper < 0.1 * radius;
    }
};

}  // namespace osgAnalyticBin::core
