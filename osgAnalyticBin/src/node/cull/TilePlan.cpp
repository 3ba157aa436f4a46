// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TilePlan.h"

#include "../../core/Bits.h"

#include <algorithm>
#include <functional>

namespace osgAnalyticBin {

void TilePlan::clear() {
    _entries.clear();
    _masks.clear();
    _shown.clear();
    _occluded.clear();
    _next = 0;
}

std::size_t TilePlan::add(const TileFamily& family, unsigned int first, core::PlaneMask undecided,
                          const Verdicts& verdicts, std::size_t children) {
    const core::PlaneMask* const masks = verdicts.planes.undecided;
    const std::size_t begin = _masks.size();
    _masks.insert(_masks.end(), masks, masks + std::min<std::size_t>(children, TileBlock::Part::kMost));
    _entries.push_back({&family, first, undecided, verdicts.planes.outside, verdicts.planes.insideAll, verdicts.members,
                        verdicts.tested, verdicts.hidden, verdicts.separated, 0, verdicts.lacksTiles, begin,
                        _masks.size()});
    return _entries.size() - 1;
}

bool TilePlan::isOutOfView(const ShownTile& tile) const {
    if (tile.result == kAlone) return false;
    const Entry& entry = _entries[tile.result];
    return hasBit(entry.tested & (entry.outside | entry.hidden | entry.separated), tile.slot);
}

void TilePlan::addOccluded(const ShownTile& tile) {
    if (tile.result != kAlone) _entries[tile.result].occluded |= std::uint64_t{1} << tile.slot;
    _occluded.push_back(tile.tile);
    _isSorted = false;
}

bool TilePlan::isOccluded(const AnalyticBinCullCallback& tile) {
    if (!_isSorted) std::sort(_occluded.begin(), _occluded.end(), std::less<>());
    _isSorted = true;
    return std::binary_search(_occluded.begin(), _occluded.end(), &tile, std::less<>());
}

bool TilePlan::find(const TileFamily& family, unsigned int first, core::PlaneMask undecided, Verdicts& verdicts) {
    // the plan also has families that the traversal does not enter: those below tiles of which only the column is seen
    constexpr std::size_t kFarthest = 32;
    const std::size_t end = std::min(_entries.size(), _next + kFarthest);
    for (std::size_t i = _next; i < end; ++i) {
        const Entry& entry = _entries[i];
        if (entry.family != &family || entry.first != first) continue;
        _next = i + 1;
        if ((undecided & ~entry.undecided) != 0) return false;
        verdicts.planes.outside = entry.outside;
        verdicts.planes.insideAll = entry.insideAll;
        verdicts.members = entry.members;
        verdicts.tested = entry.tested;
        verdicts.hidden = entry.hidden;
        verdicts.separated = entry.separated;
        verdicts.occluded = entry.occluded;
        verdicts.lacksTiles = entry.lacksTiles;
        std::transform(_masks.data() + entry.masks, _masks.data() + entry.end, verdicts.planes.undecided,
                       [undecided](core::PlaneMask mask) { return mask & undecided; });
        return true;
    }
    return false;
}

}  // namespace osgAnalyticBin
