// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Counts.h"
#include "TileTree.h"

#include <optional>

namespace osgAnalyticBin::paper {

/// Sets the verdicts of a method against what is proven of the tiles.
class VerdictCheck final {
public:
    VerdictCheck(Terrain& terrain, const TileTree& tree, const Camera& camera) noexcept
        : _terrain(terrain), _tree(tree), _camera(camera), _planes(camera.planes()) {}

    /// What the verdict adds to the counts of the tile's level.
    [[nodiscard]] Counts count(std::size_t tile, Verdict verdict);

    /// The wrong cull with the deepest witness so far, holes before others; kind and number are left open.
    [[nodiscard]] const std::optional<WrongCull>& worst() const noexcept { return _worst; }

private:
    [[nodiscard]] bool noteWrongCull(std::size_t tile);
    [[nodiscard]] bool isTrulyInside(std::size_t tile) const noexcept;

    Terrain& _terrain;
    const TileTree& _tree;
    const Camera& _camera;
    std::array<core::Plane, 4> _planes;
    std::optional<WrongCull> _worst;
};

/// A hole is worse than a tile that nobody misses, and of two of a kind the deeper one.
[[nodiscard]] bool isWorse(const WrongCull& a, const WrongCull& b) noexcept;

}  // namespace osgAnalyticBin::paper
