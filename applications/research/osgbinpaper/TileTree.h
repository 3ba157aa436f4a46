// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Camera.h"
#include "FrustumHull.h"
#include "RivalBins.h"

#include <osgAnalyticBin/core/GeodeticBin.h>
#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/bin/ExactGeodeticBin.h>
#include <osgAnalyticBin/core/bin/QuadraticOrExact.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace osgAnalyticBin::paper {

/// What a tile is tested by. `Box`: the box along the axes of ECEF, another reading of "eight corners", and a sound
/// one. `Hull`: near to the truth: the exact bin, and what is beyond a face of it or a parting plane of the frustum.
enum class Method : std::size_t { Box, Corners, Paper, Quadratic, Exact, Hull };
inline constexpr std::size_t kMethods = 6;
inline constexpr std::array<const char*, kMethods> kMethodNames{"box",       "corners", "paper",
                                                                "quadratic", "exact",   "hull"};

[[nodiscard]] constexpr std::size_t indexOf(Method method) noexcept {
    return static_cast<std::size_t>(method);
}

/// The planes of a frustum and what the search for its hull needs; made once per camera.
struct Frustum {
    explicit Frustum(const Camera& camera) noexcept;

    core::PlaneSet planes;
    hull::FrustumHull hull;
};

/// A tile as every method has it.
struct TileBins {
    TileBins(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin);

    /// Where the tile lies with respect to the frustum.
    [[nodiscard]] core::Side classify(Method method, const Frustum& frustum) const noexcept;

    rivals::BoxBin box;
    rivals::CornersBin corners;
    rivals::PaperBin paper;
    core::QuadraticOrExact quadratic;
    core::ExactGeodeticBin exact;
    hull::ReverseBin reverse;

private:
    [[nodiscard]] core::Side classify(Method method, const core::PlaneSet& planes,
                                      core::PlaneMask& undecided) const noexcept;
};

/// A point of a tile that is inside a frustum: the proof that the tile must not be culled.
struct Witness {
    core::Geodetic position;
    double depth = 0.0;  // metres from the nearest side of the frustum
};

/// The position at shares, from 0 to 1, of a bin's latitudes, longitudes and altitudes.
[[nodiscard]] core::Geodetic positionIn(const core::GeodeticBin& bin, const glm::dvec3& shares) noexcept;

/// Looks for the point of the bin that is deepest inside the frustum.
/// Returns: nullopt when no sample is inside; a thin piece of the bin may have been missed.
[[nodiscard]] std::optional<Witness> findWitness(const core::Ellipsoid& ellipsoid, const core::GeodeticBin& bin,
                                                 const Camera& camera);

/// The same on the terrain itself, and only where the globe does not hide it from the eye.
[[nodiscard]] std::optional<Witness> findTerrainWitness(Terrain& terrain, const core::GeodeticBin& bin,
                                                        const Camera& camera);

/// A tile of the quadtree as a camera's level of detail cuts it.
struct TreeTile {
    static constexpr std::size_t kNone = 0;

    TreeTile(Terrain& terrain, const TileId& tile) : id(tile), box(terrain.bin(tile)), bins(terrain.ellipsoid(), box) {}

    TileId id;
    core::GeodeticBin box;
    TileBins bins;
    std::size_t firstChild = kNone;  // four in a row; a start tile is nobody's child
    bool isOutside = false;          // proven: a plane parts the tile, or an ancestor, from the frustum
    std::optional<Witness> witness;  // proven: this point of the tile is in the frustum

    [[nodiscard]] bool isLeaf() const noexcept { return firstChild == kNone; }
};

/// The 128 start tiles and what they are divided into: a tile is divided while it is nearer to the eye than three of
/// its widths, down to the terrain's deepest level, whether it is in the frustum or not. Source: [JJ] section 4.
struct TileTree {
    static constexpr std::size_t kStartTiles = 128;

    TileTree(Terrain& terrain, const Camera& camera);

    std::vector<TreeTile> tiles;  // the start tiles first, parents before children
};

/// How a method judged a tile.
enum class Verdict : std::uint8_t { Untested, Outside, Straddling, Inside, WithinInside };

[[nodiscard]] constexpr bool isTested(Verdict verdict) noexcept {
    return verdict == Verdict::Outside || verdict == Verdict::Straddling || verdict == Verdict::Inside;
}
[[nodiscard]] constexpr bool isKept(Verdict verdict) noexcept {
    return verdict != Verdict::Untested && verdict != Verdict::Outside;
}

/// The recursion of [JJ]: outside ends it, inside keeps all below without a test, else the children are tested.
/// Returns: a verdict for every tile.
[[nodiscard]] std::vector<Verdict> cull(const TileTree& tree, const Frustum& frustum, Method method);

}  // namespace osgAnalyticBin::paper
