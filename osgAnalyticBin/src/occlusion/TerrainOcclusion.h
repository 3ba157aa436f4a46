// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../kit/tile/TerrainHider.h"
#include "NearMeshes.h"
#include "OcclusionSearch.h"

#include <cstddef>
#include <future>
#include <optional>
#include <vector>

namespace osgAnalyticBin {

/// What is hidden in a view, and how far ahead the near plane reaches without it.
struct LeftOut {
    std::vector<std::size_t> tiles;  ///< by their positions among those that are shown
    double reach;                    ///< metres along the forward axis of the picture
};

/// Hides shown tiles behind the terrain of others, for an eye above the terrain. It finds nothing for views that look
/// so steeply that there is no horizon in front of them, if the near plane may cut into terrain, and if a tile may have
/// a hole. What a search has found is used again if the same tiles are shown and the eye has moved little; the next
/// search is made in a thread beside. Source:
/// doc/theory/occlusion.md, section 5; tests: TerrainOcclusion.*. Cost: a few ten nanoseconds for each shown tile; if
/// there has to be a search, a sort of the shown tiles and a few microseconds for each that is not hidden.
class TerrainOcclusion final : public TerrainHider {
public:
    [[nodiscard]] Hidden find(const View& view, const std::vector<ShownTile>& shown) override;
    [[nodiscard]] bool hidesBall(const glm::dvec3& centre, double radius, bool isBehindHorizon) override;

protected:
    ~TerrainOcclusion() override = default;

private:
    [[nodiscard]] std::optional<LeftOut> servedAhead(const View& view, const LevelView& lines,
                                                     const std::vector<ShownTile>& shown,
                                                     std::optional<PictureSpan>& spanThen);
    void searchAhead(const View& view, const LevelView& lines, const std::vector<ShownTile>& shown,
                     const std::optional<PictureSpan>& spanThen);

    FoundPtr _found;               // by the last search; null: none
    std::future<FoundPtr> _ahead;  // of a search for the views that follow those which that one serves
    NearMeshes _nearMeshes;        // last read around the eye
};

}  // namespace osgAnalyticBin
