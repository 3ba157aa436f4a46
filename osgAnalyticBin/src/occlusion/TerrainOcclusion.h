// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../kit/tile/TerrainHider.h"
#include "NearMeshes.h"
#include "OcclusionSearch.h"

#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// Hides shown tiles behind the terrain of others, for an eye above the terrain. It finds nothing for views that look
/// so steeply that there is no horizon in front of them, if the near plane may cut into terrain, and if a tile may have
/// a hole. What a search has found is used again if the same tiles are shown and the eye has moved little. Source:
/// doc/theory/occlusion.md, section 5; tests: TerrainOcclusion.*. Cost: a few ten nanoseconds for each shown tile; if
/// there has to be a search, a sort of the shown tiles and a few microseconds for each that is not hidden.
class TerrainOcclusion final : public TerrainHider {
public:
    [[nodiscard]] Hidden find(const View& view, const std::vector<ShownTile>& shown) override;
    [[nodiscard]] bool hidesBall(const glm::dvec3& centre, double radius, bool isBehindHorizon) override;

protected:
    ~TerrainOcclusion() override = default;

private:
    std::optional<FoundOcclusion> _found;  // by the last search
    NearMeshes _nearMeshes;                // last read around the eye
};

}  // namespace osgAnalyticBin
