// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <cstddef>
#include <cstdint>

/// Plain data that the classes of the core own and the kernels read: numbers alone, so that a kernel can be compiled
/// for several instruction sets without carrying a class along.
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

/// A point of a meridian plane.
struct MeridianPoint {
    /// @{
    /// Metres from the axis, and along it.
    double axisDistance, z;
    /// @}
};

/// What the first test needs, and how to go on. In half a cache line, at the start of every bin.
struct SphereData {
    /// Stands in `curvature` where the data are those of an exact bin.
    static constexpr float kExactForm = -1.0F;

    /// ECEF, or the frame of the mapping; metres.
    double center[3];
    float reach;      ///< no point of the bin, margin included, is farther from the centre
    float curvature;  ///< by so much at most a model's terms of second order change the distance to any plane; or
                      ///< kExactForm
};

/// What a test of the exact geodetic bin reads. Lengths in metres, ECEF.
struct ExactBinData {
    /// How the bin lies about the axis.
    enum Longitudes : std::int32_t {
        Narrow,  ///< at most half a turn: west and east
        Wide,    ///< two arcs of at most half a turn, which meet in the middle
        FullCircle,
    };

    /// What is asked first.
    SphereData sphere;
    double slack;  ///< margin, and the rounding that does not depend on the plane
    double bulge;  ///< no point of the bin is farther from the hull of its corners; infinite if it is not narrow
    /// Which form of the longitudes the next numbers have.
    Longitudes longitudes;
    /// @{
    /// Of the edges.
    double cosWest, sinWest, cosEast, sinEast;
    double cosSouth, sinSouth, cosNorth, sinNorth;
    /// @}
    /// @{
    /// The corners in the meridian plane.
    MeridianPoint topSouth, bottomSouth, topNorth, bottomNorth;
    /// @}
    /// @{
    /// Square metres.
    double squaredEquatorialRadius, squaredPolarRadius;
    /// @}
    /// Metres.
    double topAltitude;
    /// @{
    /// Of the longitude in the middle.
    double cosMiddle, sinMiddle;
    /// @}
};

/// What a test of the quadratic bin reads: the value at the centre, and derivatives times half sizes.
struct QuadraticBinData {
    SphereData sphere;    ///< about the value
    double remainder;     ///< Taylor remainder, margin, and the rounding that does not depend on the plane
    double first[3][3];   ///< by u, v, w
    double second[6][3];  ///< by uu, vv, ww, uv, uw, vw
};

/// Either of the two: a geodetic bin in the form that suits its width. Both begin with the sphere, which tells them
/// apart.
union GeodeticBinData {
    /// Read when not isExact().
    QuadraticBinData quadratic;
    /// Read when isExact().
    ExactBinData exact;

    /// Of either form.
    [[nodiscard]] const SphereData& sphere() const noexcept { return quadratic.sphere; }
    /// Which form it is.
    [[nodiscard]] bool isExact() const noexcept { return sphere().curvature < 0.0F; }
};

}  // namespace osgAnalyticBin::core
