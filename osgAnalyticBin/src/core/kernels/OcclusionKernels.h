// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/bin/KernelData.h>

#include <cstddef>
#include <cstdint>
#include <limits>

/// The loops of the search for what terrain hides, compiled for several instruction sets from one source. The forms
/// agree bit for bit. Source of all formulas: doc/theory/occlusion.md.
namespace osgAnalyticBin::core::kernels {

/// The largest number of lanes of a vector.
inline constexpr std::size_t kMostLanes = 8;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kLargest = std::numeric_limits<double>::max();

/// The strips of a picture, counted from 0, and the end of the last one.
struct StripNumbers {
    static constexpr int kStrips = 256;
    double of[kStrips + 1];
    constexpr StripNumbers() : of{} {
        for (int i = 0; i <= kStrips; ++i) of[i] = i;
    }
};
inline constexpr StripNumbers kStripNumbers;

/// What the cells of a tile have in common.
struct CellGround {
    bool isPlane;
    double radius, squaredRatio;  ///< a and b2/a2; the units in a radian of a plane
    double latitude, longitude;   ///< of the tile's middle
    double sinLatitude, cosLatitude, sinLongitude, cosLongitude;
    double height, width;  ///< of the tile, radians, at most twice kFarthestFromMiddle
    double depth;          ///< metres of the columns
    /// @{
    /// The axes of ECEF and the eye's place, along the axes of the eye's frame.
    double x[3], y[3], z[3], eye[3];
    /// @}
};

/// Radians from the middle of a tile for which sines and cosines are computed.
inline constexpr double kFarthestFromMiddle = 0.5;

/// Cells, one after the other: where their columns end, in heights and widths of the tile from its middle, and the
/// altitudes of their tops.
struct CellRows {
    const double *south, *north, *west, *east, *high;
    std::size_t count;
};

/// Rows of a wall's numbers.
struct WallRow {
    enum : std::size_t { Farthest, Highest, From, To, TopSlope, TopOffset, BottomSlope, BottomOffset, kCount };
};

/// Columns of earth and the walls in them: 24 rows of coordinates, x, y and z of a corner after the other, the upper
/// corners first; a row of errors.
struct ColumnRows {
    const double* corners;
    const double* error;
    std::size_t stride, count;
};

struct Walls {
    std::uint64_t bits;  ///< of the columns that have a wall
    double nearest2;     ///< the least square of the distance of an upper corner, of columns in front of the eye
};

/// The corners of a body, kMostLanes of each coordinate.
struct BodyData {
    const double *x, *y, *z;
    double reach;
};

/// See HorizonBuffer::Outline.
struct OutlineData {
    double nearest, left, right, low, high;
    double distance2;  ///< of the nearest corner, squared
    bool isBeside;
};

struct OcclusionKernels {
    /// The corners of the cells' columns: 24 rows of `stride` numbers, as in ColumnRows.
    void (*columns)(const CellGround& ground, const CellRows& cells, double* corners, std::size_t stride);
    /// `walls`: WallRow::kCount rows of as many numbers as `columns` has.
    Walls (*walls)(const PictureData& picture, const ColumnRows& columns, double* walls);
    void (*outline)(const PictureData& picture, const BodyData& body, OutlineData& outline);
    /// Whether a height is above one of those numbered first to last - 1.
    bool (*isAbove)(const double* heights, std::size_t first, std::size_t last, double height);
    /// Adds a wall to what is covered in these strips.
    void (*raise)(const PictureData& picture, const double* wall, std::size_t first, std::size_t last, double* lower,
                  double* upper);
    /// Whether these strips cover the heights.
    bool (*covers)(const double* lower, const double* upper, std::size_t first, std::size_t last, double low,
                   double high);
};

/// One number at a time.
extern const OcclusionKernels kScalarOcclusion;

/// The scalar form until chooseKernels() has chosen.
extern OcclusionKernels activeOcclusion;

}  // namespace osgAnalyticBin::core::kernels
