// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../kit/cull/ShownDepth.h"
#include "OcclusionSearch.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace osgAnalyticBin {

/// Number of shown tiles that terrain hides.
struct OccludedTiles {
    std::size_t hidden = 0;
    std::size_t inView = 0;  ///< hidden ones included
    bool isAwaited = false;  ///< no result yet, because tiles have no plates yet
    std::vector<TileSelection::ShownTile> withoutPlates;
};

/// Marks in the database's plan which of the shown tiles are hidden behind the terrain of others, for an eye above the
/// terrain. It does nothing for orthographic cameras, for views that look so steeply that there is no horizon in front
/// of them, if OSG computes the near plane or it may cut into terrain, and if a tile may have a hole. `kept`: the
/// result of this visitor's last search, which is used again if the same tiles are shown and the eye has moved little.
/// Requires: a plan with the shown tiles, without holes, and an eye above the ground (eyeAboveWhatIsShown()).
/// Guarantee: every line of sight to a tile that is culled meets the mesh of another shown tile before; tests:
/// TerrainOcclusion.*. Source: doc/theory/occlusion.md, section 5.
/// Cost: a few ten nanoseconds for each shown tile; if `kept` cannot be used, a sort of the shown tiles and a few
/// microseconds for each that is not hidden.
OccludedTiles cullBehindTerrain(const ShownDatabase& database, const Viewpoint& viewpoint,
                                std::shared_ptr<FoundOcclusion>& kept);

}  // namespace osgAnalyticBin
