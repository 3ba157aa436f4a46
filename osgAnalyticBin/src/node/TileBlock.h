// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/core/Horizon.h>
#include <osgAnalyticBin/core/KernelData.h>

#include <osg/BoundingSphere>
#include <osg/Referenced>

#include <atomic>
#include <cstddef>
#include <vector>

namespace osgAnalyticBin {

/// What is asked first of tiles that are siblings, side by side in memory: most of those that are culled are culled by
/// these numbers, and nothing of themselves is touched. A slot is a child of the group that they hang on; ECEF.
/// Threads: believe() and isBelieved() at any time; set() where no cull traversal runs.
class TileBlock final : public osg::Referenced {
public:
    /// Metres and ECEF.
    struct Slot {
        core::SphereData sphere{};   ///< about the bin, with which all tests of bins begin
        osg::BoundingSphere bound;   ///< what OSG's test of small features takes
        osg::BoundingSphere column;  ///< about the bin, and what is above it up to the ellipsoid
        double binHigh = 0.0;        ///< see AnalyticBinCullCallback
        double binLow = 0.0;         ///< likewise
        double surfaceHigh = 0.0;    ///< likewise
        double surfaceLow = 0.0;     ///< likewise
    };

    /// What the horizon test takes of a tile; null: it is never hidden.
    struct Horizons {
        const core::HorizonBin* bin;
        const core::HorizonBin* column;
    };

    explicit TileBlock(std::size_t slots);

    [[nodiscard]] std::size_t size() const { return _slots.size(); }
    [[nodiscard]] const Slot& operator[](std::size_t slot) const { return _slots[slot]; }

    /// Takes over what a tile is culled by.
    void set(std::size_t slot, const Slot& tile, const Horizons& horizons);

    /// Whether the tile of a slot may be culled without its own callback being asked.
    [[nodiscard]] bool isBelieved(std::size_t slot) const { return _believed[slot].load(std::memory_order_relaxed); }
    void believe(std::size_t slot, bool is) { _believed[slot].store(is, std::memory_order_relaxed); }

    /// Whether the horizon hides the tile.
    [[nodiscard]] bool isHidden(std::size_t slot, const core::HorizonEye& eye) const {
        return eye.hides(_horizons[slot]);
    }

    /// Whether it hides the tile's column.
    [[nodiscard]] bool isColumnHidden(std::size_t slot, const core::HorizonEye& eye) const {
        return eye.hides(_columns.empty() ? _horizons[slot] : _columns[slot]);
    }

protected:
    ~TileBlock() override;

private:
    std::vector<Slot> _slots;
    std::vector<core::HorizonBin> _horizons;
    std::vector<core::HorizonBin> _columns;  // empty: those of the bins
    std::vector<std::atomic<bool>> _believed;
};

}  // namespace osgAnalyticBin
