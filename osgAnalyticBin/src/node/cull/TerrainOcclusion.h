// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "EmergingTiles.h"
#include "OcclusionSearch.h"
#include "ShownDepth.h"

#include <cstddef>
#include <memory>

namespace osgAnalyticBin {

/// How many of the shown tiles terrain hides.
struct OccludedTiles {
    std::size_t hidden = 0;
    std::size_t inView = 0;  ///< hidden ones included
    bool isAwaited = false;  ///< nothing is known yet, because tiles have no plates yet
};

/// Says in the database's plan which of the shown tiles lie behind the terrain of others, seen from an eye above the
/// terrain. It does nothing for orthographic cameras, for views that look so steeply that there is no horizon in front
/// of them, where the near plane is computed or may cut into terrain, and where a tile may have a hole. `kept`: what
/// was found in the last view of this visitor; it serves again where the same tiles are shown and the eye has moved
/// little. `emerging`: of the same visitor.
/// Requires: a plan that has what is shown, and that found no hole in it and the eye above the ground
/// (eyeAboveWhatIsShown()).
/// Guarantee: every line of sight to a tile that is culled meets the mesh of another shown tile before; tests:
/// TerrainOcclusion.*. Source: doc/theory/occlusion.md, section 5.
/// Cost: a few ten nanoseconds for each shown tile; where `kept` does not serve, a sort of the shown tiles and a few
/// microseconds for each that is not hidden.
OccludedTiles cullBehindTerrain(const ShownDatabase& database, const Viewpoint& viewpoint,
                                std::shared_ptr<FoundOcclusion>& kept, EmergingTiles& emerging);

}  // namespace osgAnalyticBin
