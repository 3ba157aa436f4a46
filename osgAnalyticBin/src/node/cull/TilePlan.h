// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "../tile/TileBlock.h"

#include <osgAnalyticBin/core/Plane.h>

#include <osg/Node>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

class AnalyticBinCullCallback;
class TileFamily;

/// The results of families that were tested before OSG traverses a database, in the order in which the traversal meets
/// them. A plan is made for one traversal of one visitor.
class TilePlan {
public:
    /// The results for up to TileBlock::Part::kMost children, one bit each.
    struct Verdicts {
        Verdicts() { planes.outside = planes.insideAll = 0; }  // masks of slots without a tile are not read

        core::FamilyVerdict planes;
        std::uint64_t members = 0;    ///< the family's tiles; other children are left to their callbacks
        std::uint64_t tested = 0;     ///< slots with a bin
        std::uint64_t beyond = 0;     ///< behind the horizon
        std::uint64_t hidden = 0;     ///< of these, those that obey depth
        std::uint64_t separated = 0;  ///< proven outside by an edge of the frustum
        std::uint64_t occluded = 0;   ///< behind terrain
        bool lacksTiles = false;      ///< a tile was removed: the terrain may have a hole

        /// Slots whose bin is out of view.
        [[nodiscard]] std::uint64_t outOfView() const {
            return tested & (planes.outside | hidden | separated | occluded);
        }
    };

    void clear();

    /// Returns: the number of the result.
    std::size_t add(const TileFamily& family, unsigned int first, core::PlaneMask undecided, const Verdicts& verdicts,
                    std::size_t children);

    /// A tile that a camera's levels of detail show, whether in view or not.
    struct ShownTile {
        const AnalyticBinCullCallback* tile;
        osg::Node* mesh;
        bool isSure;         ///< false: it may be shown, or another level in its place
        bool isOnlyLevel;    ///< of the tile, that is shown or waited for
        std::size_t result;  ///< of its family; kAlone: it is tested alone
        unsigned int slot;   ///< among the result's bits
    };
    static constexpr std::size_t kAlone = ~std::size_t{0};

    void addShown(const ShownTile& tile) { _shown.push_back(tile); }
    [[nodiscard]] const std::vector<ShownTile>& shown() const { return _shown; }

    /// Whether the tile of a family is known to be out of view.
    [[nodiscard]] bool isOutOfView(const ShownTile& tile) const;

    /// Says that terrain hides one of the shown tiles.
    void addOccluded(const ShownTile& tile);
    [[nodiscard]] bool isOccluded(const AnalyticBinCullCallback& tile);

    /// Searches behind the family that was found last. `undecided`: a result that lacks one of these planes is
    /// not used; OSG may have found the sphere of a group inside some of the others.
    /// Returns: false where the plan has no such result; `verdicts` stays as it is then.
    [[nodiscard]] bool find(const TileFamily& family, unsigned int first, core::PlaneMask undecided,
                            Verdicts& verdicts);

private:
    struct Entry {
        const TileFamily* family;
        unsigned int first;
        core::PlaneMask undecided;
        std::uint64_t outside, insideAll, members, tested, hidden, separated, occluded;
        bool lacksTiles;
        std::size_t masks, end;  // in _masks
    };

    std::vector<Entry> _entries;
    std::vector<core::PlaneMask> _masks;
    std::vector<ShownTile> _shown;
    // Sorted when the first tile is asked for: families have what they ask for in their bits.
    std::vector<const AnalyticBinCullCallback*> _occluded;
    bool _isSorted = true;
    std::size_t _next = 0;
};

}  // namespace osgAnalyticBin
