// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/PlaneSet.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/Polytope>

#include <array>
#include <cstdint>
#include <optional>
#include <support/RandomBins.h>
#include <vector>

namespace osgAnalyticBin::test {

/// The four side planes of a camera, as each method wants them.
struct Frustum {
    std::array<core::Plane, 4> planes;
    core::PlaneSet set;
    osg::Polytope polytope;
    glm::dvec3 eye{0.0};
    std::optional<core::HorizonEye> horizon;
};

/// Tiles of all levels about a few places, and cameras there. As many tiles as the second-level cache of a common
/// machine holds: what is measured is the test, not the memory.
struct Scene {
    static constexpr std::size_t kTiles = 2048;
    static constexpr std::size_t kFrusta = 64;

    explicit Scene(Random& random);

    std::vector<BinOracle> tiles;
    std::vector<Frustum> frusta;
};

/// For every frustum, a sequence of tiles, a given share of them outside of it by the oracle. Some sixty thousand pairs
/// in random order: more than a branch predictor learns.
struct TileMix {
    static constexpr std::size_t kTilesPerFrustum = 1024;

    TileMix(Random& random, const Scene& scene, double outsideShare);

    std::vector<std::vector<std::uint32_t>> tilesOfFrustum;
};

/// The occluder of the horizon test: below all terrain, metres.
inline constexpr double kOccluderDepth = 12000.0;

/// Whether a point of the bin, of a grid of 2 x 5 x 5, is in the frustum and sees the eye past the occluder.
[[nodiscard]] bool seesASample(const Frustum& frustum, const BinOracle& tile);

/// By how much the bin reaches into the half space of the plane that it reaches into least; negative: it is outside.
[[nodiscard]] Real reachInto(const Frustum& frustum, const BinOracle& tile);

}  // namespace osgAnalyticBin::test
