// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/AnalyticBin.h>

namespace osgAnalyticBin {

/// What a tile's bin has to be expanded by.
struct Widening {
    AnalyticBin bin;
    bool isBoundless = false;  ///< the extents of what was found are unknown

    [[nodiscard]] bool any() const { return isBoundless || bin.valid(); }
    [[nodiscard]] bool contains(const Widening& other) const {
        if (isBoundless || !other.any()) return true;
        return !other.isBoundless && bin.valid() && bin.contains(other.bin);
    }
    void expandBy(const Widening& other) {
        isBoundless = isBoundless || other.isBoundless;
        bin.expandBy(other.bin);
    }
    /// The expanded bin. An unknown (invalid) bin stays unknown.
    [[nodiscard]] AnalyticBin widened(const AnalyticBin& known) const {
        if (isBoundless || !known.valid()) return {};
        AnalyticBin wider = known;
        wider.expandBy(bin);
        return wider;
    }
};

}  // namespace osgAnalyticBin
