// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <limits>
#include <support/GeodeticOracle.h>
#include <support/Random.h>

namespace osgAnalyticBin::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kHalfPi = 0.5 * kPi;
inline constexpr double kRadiansPerDegree = kPi / 180.0;

/// Tiles of level n are 22.5 degrees / 2^n wide: the start tiles of [JJ] and their quarters.
inline constexpr double kRootTileDeg = 22.5;
inline constexpr int kDeepestLevel = 12;

/// The lowest and highest altitudes that terrain and its exaggeration are tested with.
inline constexpr core::Interval kAllAltitudes{-11000.0, 400000.0};

/// The altitudes of the earth's terrain and sea floor, for figures of tightness.
inline constexpr core::Interval kTerrainAltitudes{-11000.0, 9000.0};

/// Kinds of bin that are hard in their own ways, besides the tiles of a quadtree.
enum class BinKind { Tile, Polar, DateLine, Equator, Sliver, Tiny, Point, NearAxis, Wide, WholeGlobe };

inline constexpr std::array<BinKind, 10> kBinKinds{
    BinKind::Tile, BinKind::Polar, BinKind::DateLine, BinKind::Equator, BinKind::Sliver,
    BinKind::Tiny, BinKind::Point, BinKind::NearAxis, BinKind::Wide,    BinKind::WholeGlobe};

[[nodiscard]] const char* nameOf(BinKind kind) noexcept;

/// Kinds of plane; all but the first and the last touch or nearly touch the bin.
enum class PlaneKind { Random, NearMaximum, NearMinimum, TangentToSurface, ThroughVertexEdgeOrFace, Far };

inline constexpr std::array<PlaneKind, 6> kPlaneKinds{PlaneKind::Random,
                                                      PlaneKind::NearMaximum,
                                                      PlaneKind::NearMinimum,
                                                      PlaneKind::TangentToSurface,
                                                      PlaneKind::ThroughVertexEdgeOrFace,
                                                      PlaneKind::Far};

[[nodiscard]] core::Ellipsoid wgs84() noexcept;

/// WGS 84 mostly; GRS 80, Mars, a sphere, flattened and prolate ones.
[[nodiscard]] core::Ellipsoid randomEllipsoid(Random& random) noexcept;

/// Any part of kAllAltitudes: thin, thick, of no thickness.
[[nodiscard]] core::Interval randomAltitude(Random& random) noexcept;

/// A tile of the quadtree; a third of them touch a pole or the date line.
[[nodiscard]] core::GeodeticBin randomTile(Random& random, int level, core::Interval altitude) noexcept;
[[nodiscard]] core::GeodeticBin randomBin(Random& random, BinKind kind) noexcept;
[[nodiscard]] inline core::GeodeticBin randomBin(Random& random) noexcept {
    return randomBin(random, random.pick(kBinKinds));
}

/// A position of the bin, one coordinate in three at an end of its interval.
[[nodiscard]] core::Geodetic randomPosition(Random& random, const core::GeodeticBin& bin) noexcept;

/// A length that stands for the size of the bin in space, in metres; never zero.
[[nodiscard]] double sizeOf(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin) noexcept;

/// A plane to test the bin with. Offsets from a tangent run from 1e-9 m to the size of the bin.
[[nodiscard]] core::Plane randomPlane(Random& random, const BinOracle& bin, PlaneKind kind) noexcept;

}  // namespace osgAnalyticBin::test
