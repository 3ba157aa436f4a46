// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileFamily.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

/// The results of families that were tested before OSG traverses a database, in the order in which the traversal meets
/// them. A plan is made for one traversal of one visitor.
class TilePlan {
public:
    void clear();

    void add(const TileFamily& family, unsigned int first, core::PlaneMask undecided,
             const TileFamily::Verdicts& verdicts, std::size_t children);

    /// Searches behind the family that was found last. `undecided`: a result for other planes is not used.
    /// Returns: false where the plan has no such result; `verdicts` stays as it is then.
    [[nodiscard]] bool find(const TileFamily& family, unsigned int first, core::PlaneMask undecided,
                            TileFamily::Verdicts& verdicts);

private:
    struct Entry {
        const TileFamily* family;
        unsigned int first;
        core::PlaneMask undecided;
        std::uint64_t outside, insideAll, members, tested, hidden, separated;
        bool lacksTiles;
        std::size_t masks, end;  // in _masks
    };

    std::vector<Entry> _entries;
    std::vector<core::PlaneMask> _masks;
    std::size_t _next = 0;
};

}  // namespace osgAnalyticBin
