// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Counts.h"
#include "Progress.h"
#include "TerrainOcclusion.h"
#include "TileTree.h"

#include <array>
#include <cstdint>
#include <optional>

namespace osgAnalyticBin::paper {

struct ExperimentSettings {
    std::size_t cameras = 400;  // of each kind
    std::uint64_t seed = 1;
    double factor = 3.0;  // tiles nearer than this many of their widths are divided
    bool isTimed = true;
    bool hidesBehindTerrain = false;  // whether TerrainOcclusion counts too
};

/// The experiment of [JJ]: every method culls the same trees from the same cameras.
struct Results {
    std::array<ViewResult, kViewKinds.size()> views{};
    /// All 0 unless asked for.
    std::array<OcclusionCounts, kViewKinds.size()> occlusion{};
    /// For each method the wrong cull with the deepest witness; holes in the picture before others.
    std::array<std::optional<WrongCull>, kMethods> worst;

    /// All kinds of view together; the times are the means of theirs.
    [[nodiscard]] ViewResult sum() const noexcept;
};

[[nodiscard]] Results runExperiment(Terrain& terrain, const ExperimentSettings& settings, Progress& progress);

}  // namespace osgAnalyticBin::paper
