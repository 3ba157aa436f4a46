// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Methods.h"
#include "Witness.h"

#include <optional>
#include <vector>

namespace osgAnalyticBin::paper {

/// A tile of the quadtree as a camera's level of detail cuts it.
struct TreeTile {
    static constexpr std::size_t kNone = 0;

    TreeTile(const Terrain& terrain, const TileId& tile)
        : id(tile), box(terrain.bin(tile)), bins(terrain.ellipsoid(), box) {}

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

    TileTree(const Terrain& terrain, const Camera& camera);

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
