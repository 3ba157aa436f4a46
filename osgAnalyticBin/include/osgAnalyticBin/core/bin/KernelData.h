// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>

// Plain data that the classes of the core own and the kernels read: numbers alone, so that a kernel can be compiled
// for several instruction sets without carrying a class along.
namespace osgAnalyticBin::core {

/// Four planes, coordinate by coordinate. A lane without a plane is zero.
struct PlaneBlock {
    /// Planes of a block.
    static constexpr std::size_t kLanes = 4;

    /// Unit normals, pointing inside.
    alignas(32) double normalX[kLanes];
    /// Unit normals, pointing inside.
    alignas(32) double normalY[kLanes];
    /// Unit normals, pointing inside.
    alignas(32) double normalZ[kLanes];
    /// Metres.
    alignas(32) double offset[kLanes];
    alignas(32) double rounding[kLanes];  ///< 128 epsilon |offset|; NaN if the plane is not usable
};

}  // namespace osgAnalyticBin::core

/// The numbers of a bin in the order in which its tests read them. A family of bins keeps one row for each number, with
/// the bins side by side. Lengths in metres; ECEF, or the frame of the mapping.
namespace osgAnalyticBin::core::row {

/// The sphere about the bin, which both forms begin with: no point of the bin, margin included, is farther than Reach
/// from the centre.
enum Sphere : std::size_t { CenterX, CenterY, CenterZ, Reach, SphereEnd };

/// The quadratic form: value at the centre, and derivatives times half sizes.
enum Quadratic : std::size_t {
    Remainder = SphereEnd,  ///< Taylor remainder, margin, and the rounding that does not depend on the plane
    Curvature,              ///< terms of second order change the distance to any plane by no more
    First,                  ///< x, y, z by u, then by v, w
    Second = First + 9,     ///< x, y, z by uu, then by vv, ww, uv, uw, vw
    QuadraticEnd = Second + 18
};

/// The exact form of a geodetic bin.
enum Exact : std::size_t {
    Slack = SphereEnd,  ///< margin, and the rounding that does not depend on the plane
    Bulge,              ///< no point of the bin is farther from the hull of its corners; infinite if it is not narrow
    CosWest,
    SinWest,
    CosEast,
    SinEast,
    Corners,  ///< distance from the axis and z: top and bottom in the south, top and bottom in the north
    CosSouth = Corners + 8,
    SinSouth,
    CosNorth,
    SinNorth,
    SquaredEquatorialRadius,
    SquaredPolarRadius,
    TopAltitude,
    Longitudes,  ///< how the bin lies about the axis: see below
    CosMiddle,   ///< of the longitude in the middle
    SinMiddle,
    ExactEnd
};

/// Values of Longitudes.
inline constexpr double kNarrow = 0.0;      ///< at most half a turn: west and east
inline constexpr double kWide = 1.0;        ///< two arcs of at most half a turn, which meet in the middle
inline constexpr double kFullCircle = 2.0;  ///< all longitudes

/// Rows of a bin in either form.
inline constexpr std::size_t kBinRows = QuadraticEnd;
static_assert(static_cast<std::size_t>(ExactEnd) <= kBinRows, "both forms share the rows");

/// What the horizon test reads, counted from its own first row. Unit space: ECEF divided by the ellipsoid's radii.
enum Horizon : std::size_t {
    CosMiddleLongitude,
    SinMiddleLongitude,
    CosSouthern,  ///< of the scaled latitudes
    SinSouthern,
    CosNorthern,
    SinNorthern,
    CosHalfWidth,
    SinHalfWidth,
    InverseRadius,  ///< of the farthest point, rounded down; zero: never hidden
    CosMargin,      ///< of the angle that the margin turns a direction by at most
    SinMargin,
    HorizonEnd
};

/// Rows that the horizon test reads.
inline constexpr std::size_t kHorizonRows = HorizonEnd;

}  // namespace osgAnalyticBin::core::row

namespace osgAnalyticBin::core {

/// What the horizon test reads of an eye.
struct HorizonEyeData {
    /// @{
    /// To the eye, unit length in unit space.
    double x, y, z;
    /// @}
    double equatorial;  ///< the length of x and y
    /// @{
    /// The angle at the centre between the eye and its horizon.
    double cosDip, sinDip;
    /// @}
    double scale;  ///< of the occluder
};

/// The most bins that a family has: one bit each.
inline constexpr std::size_t kMostSlots = 64;

/// The results of a family against a set of planes: one bit for each slot.
struct FamilyVerdict {
    std::uint64_t outside;    ///< outside of one plane at least
    std::uint64_t insideAll;  ///< inside of all planes that were undecided
    /// For each slot the planes that are still undecided; all that were given, if the slot is outside. Slots above the
    /// family's are not meaningful.
    std::uint32_t undecided[kMostSlots];
};

/// The rows of a family: kBinRows, then kHorizonRows. Slots up to the next multiple of four may be read; those without
/// a bin have a sphere that is outside of every plane.
struct FamilyData {
    const double* numbers;  ///< the first row; null for a family without slots
    std::size_t stride;     ///< from one row to the next: a multiple of four
    std::uint64_t exact;    ///< the slots in exact form
    std::uint64_t filled;   ///< the slots with a bin
    std::uint64_t empty;    ///< the other slots, up to the family's size
};

/// The picture of a HorizonBuffer.
struct PictureData {
    double eyeToCentre;  ///< metres, for rounding
    double left;         ///< the least x
    double right;        ///< the greatest x
    double step;         ///< the width of a strip
    double drawing;      ///< how far from its place a corner may be drawn
    double eyes[3];      ///< metres that the eye may be away from its place
};

}  // namespace osgAnalyticBin::core
