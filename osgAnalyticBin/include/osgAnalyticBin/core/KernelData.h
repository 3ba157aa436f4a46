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
    static constexpr std::size_t kLanes = 4;

    alignas(32) double normalX[kLanes];
    alignas(32) double normalY[kLanes];
    alignas(32) double normalZ[kLanes];
    alignas(32) double offset[kLanes];
    alignas(32) double rounding[kLanes];  // 128 epsilon |offset|; NaN if the plane is not finite
};

/// A point of a meridian plane.
struct MeridianPoint {
    double axisDistance, z;
};

/// What a test of the exact geodetic bin reads. Lengths in metres, ECEF.
struct ExactBinData {
    enum Longitudes : std::int32_t {
        Narrow,  // at most half a turn: west and east
        Wide,    // two arcs of at most half a turn, which meet in the middle
        FullCircle,
    };

    // What the first test needs stands together, in one cache line.
    double center[3];
    double reach;  // no point of the bin, margin included, is farther from the centre
    double slack;  // margin, and the rounding that does not depend on the plane
    double bulge;  // no point of the bin is farther from the hull of its corners; infinite if it is not narrow
    Longitudes longitudes;
    double cosWest, sinWest, cosEast, sinEast;
    double cosSouth, sinSouth, cosNorth, sinNorth;
    MeridianPoint topSouth, bottomSouth, topNorth, bottomNorth;
    double squaredEquatorialRadius, squaredPolarRadius;
    double topAltitude;
    double cosMiddle, sinMiddle;
};

/// What a test of the quadratic bin reads: the value at the centre, and derivatives times half sizes.
struct QuadraticBinData {
    // What the first test needs stands together, in one cache line.
    double value[3];
    float reach;          // no point of the bin, margin included, is farther from the value
    float curvature;      // by so much at most the terms of second order change the distance to any plane
    double remainder;     // Taylor remainder, margin, and the rounding that does not depend on the plane
    double first[3][3];   // by u, v, w
    double second[6][3];  // by uu, vv, ww, uv, uw, vw
};

}  // namespace osgAnalyticBin::core
