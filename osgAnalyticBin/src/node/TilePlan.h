// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "TileFamily.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgAnalyticBin {

/// What families of tiles were found to be to the planes and to the horizon before OSG's traversal of a database, in
/// the order in which the traversal will meet them. One plan serves one traversal of one visitor.
class TilePlan {
public:
    void clear();

    void add(const TileFamily& family, unsigned int first, core::PlaneMask undecided,
             const TileFamily::Verdicts& verdicts, std::size_t children);

    /// Looks for a family from the one on that was found last. `undecided`: has to be what the family was tested with.
    /// Returns: false where the plan does not have it; `verdicts` is untouched then.
    [[nodiscard]] bool find(const TileFamily& family, unsigned int first, core::PlaneMask undecided,
                            TileFamily::Verdicts& verdicts);

private:
    struct Entry {
        const TileFamily* family;
        unsigned int first;
        core::PlaneMask undecided;
        std::uint64_t outside, insideAll, members, tested, hidden;
        bool lacksTiles;
        std::size_t masks, end;  // in _masks
    };

    std::vector<Entry> _entries;
    std::vector<core::PlaneMask> _masks;
    std::size_t _next = 0;
};

}  // namespace osgAnalyticBin
