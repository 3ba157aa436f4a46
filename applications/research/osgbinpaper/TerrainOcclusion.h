// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileTree.h"

#include <osgAnalyticBin/core/occlusion/GroundPlates.h>

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace osgAnalyticBin::paper {

/// What terrain hides of the leaves that the exact bin keeps; sums over cameras.
struct OcclusionCounts {
    std::uint64_t cameras = 0;     // that look level enough
    std::uint64_t drawn = 0;       // leaves that the exact bin keeps
    std::uint64_t hidden = 0;      // of these, such as lie behind terrain
    std::uint64_t seenHidden = 0;  // of these, such with a point that a free line of sight leads to

    void add(const OcclusionCounts& other) noexcept;
};

/// Leaves drawn as meshes of kPosts x kPosts posts of the raster, and what is behind them, as the node kit proves it.
/// Cameras that look so steeply that a corner of the picture is not ahead of them are left out.
/// Source: doc/theory/occlusion.md, sections 1 to 4.
class TerrainOcclusion {
public:
    static constexpr std::size_t kPosts = 33;

    explicit TerrainOcclusion(Terrain& terrain) : _terrain(terrain) {}

    /// `verdicts`: of the exact bin.
    [[nodiscard]] OcclusionCounts count(const TileTree& tree, const std::vector<Verdict>& verdicts,
                                        const Camera& camera);

private:
    struct Surface {
        std::vector<double> altitudes;  // of posts, row by row from the south-west
        core::GroundPlates plates;
    };

    [[nodiscard]] const Surface& surfaceOf(const TreeTile& tile, const core::GeodeticBin& box);
    [[nodiscard]] bool isSeen(const TileTree& tree, std::size_t leaf, const Camera& camera);
    [[nodiscard]] bool isFree(const TileTree& tree, const Camera& camera, const glm::dvec3& target, double around);
    [[nodiscard]] double highestAt(const TileTree& tree, const core::Geodetic& position);

    Terrain& _terrain;
    std::map<std::tuple<int, int, int>, Surface> _surfaces;  // by level, x, y
};

}  // namespace osgAnalyticBin::paper
