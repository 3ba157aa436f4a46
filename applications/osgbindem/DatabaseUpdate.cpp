// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseBuilder.h"
#include "SkirtMeasure.h"
#include "TileLayout.h"

#include <algorithm>

namespace osgbindem {

namespace {

/// Tells which tiles of the finished database come out as they stand, with everything below them.
///
/// A tile's mesh depends on heights within one spacing of posts around it, or on those between the posts of a coarser
/// neighbour along the edge; its skirts depend besides on which of its neighbours, of those above them, and of those
/// below them along the edge have children. Its bin depends on the tiles below.
class Comparison final {
public:
    Comparison(SkirtMeasure& tiles, const TileLayout& layout, const TileFiles& standing, const ChangedArea& area)
        : _tiles(tiles), _layout(layout), _standing(standing), _area(area) {}

    /// Whether the tile, or one below it, may come out otherwise.
    [[nodiscard]] bool hasChanged(const TileId& tile) const {
        int coarsest =
            std::max(tile.level - 1, _layout.startLevel());  // skirts reach down to the parent's level in any case
        for (const Edge edge : kEdges) coarsest = std::min(coarsest, _tiles.coarsestAcross(tile, edge));
        if (touches(_area, tile.rect().grownBy(_layout.spacingDeg(coarsest)))) return true;
        return std::any_of(kEdges.begin(), kEdges.end(), [&](Edge edge) {
            const auto neighbour = tile.neighbour(edge);
            return neighbour && (touches(_area, neighbour->rect()) || isRefinedOtherwiseAbove(*neighbour));
        });
    }

private:
    [[nodiscard]] bool isRefinedOtherwiseAbove(const TileId& neighbour) const {
        for (int level = _layout.startLevel(); level < neighbour.level; ++level) {
            const TileId above = neighbour.ancestor(level);
            const bool hasChildren = _tiles.hasChildren(above);
            if (touches(_area, above.rect()) && hasChildren != _standing.hasChildren(above)) return true;
            if (!hasChildren) return false;
        }
        return false;
    }

    SkirtMeasure& _tiles;
    const TileLayout& _layout;
    const TileFiles& _standing;
    const ChangedArea& _area;
};

}  // namespace

std::size_t takeOverUnchanged(const Settings& settings, const TileLayout& layout, const std::vector<Task>& plan,
                              const ChangedArea& area, const DatabaseFolder& folder) {
    DemMosaic mosaic(settings, &layout);
    SkirtMeasure skirts(mosaic, layout);
    const Comparison comparison(skirts, layout, folder.standingFiles(), area);
    const auto count = std::count_if(plan.begin(), plan.end(), [&](const Task& task) {
        return !comparison.hasChanged(task.tile) && folder.takeOver(task.tile);
    });
    return static_cast<std::size_t>(count);
}

}  // namespace osgbindem
