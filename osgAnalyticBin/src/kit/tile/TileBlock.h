// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ColumnUnion.h"

#include <osgAnalyticBin/core/bin/BinFamily.h>
#include <osgAnalyticBin/core/horizon/Horizon.h>

#include <osg/BoundingSphere>
#include <osg/Referenced>
#include <osg/ref_ptr>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace osgAnalyticBin {

/// The numbers of sibling tiles that culling and the search for the lowest surface read, side by side in memory, so
/// that nothing else of a tile out of view is read. Each child of the group has a slot. Frame: ECEF, metres. Threads:
/// believe(), allowHiding() and trust() at any time; set() where no cull traversal runs.
class TileBlock final : public osg::Referenced {
public:
    struct Slot {
        osg::BoundingSphere bound;   ///< what OSG's test of small features takes
        osg::BoundingSphere column;  ///< about the bin, and what is above it up to the ellipsoid
        core::Interval altitude{};   ///< metres, of all that the tile and its descendants draw
        core::Interval surface{};    ///< metres, of what the tile draws by itself
        bool hasOwnColumn = true;    ///< the column is more than the bin
        bool testsSphere = false;    ///< see InstalledTile
    };

    /// What a tile is tested by; null: that test is left out.
    struct Bins {
        const core::QuadraticBin* quadratic = nullptr;
        const core::ExactGeodeticBin* exact = nullptr;
        const core::HorizonBin* horizon = nullptr;
        const core::HorizonBin* column = nullptr;
    };

    /// Up to kMost slots, one bit each.
    struct Part {
        static constexpr unsigned int kMost = core::BinFamily::kMostSlots;

        explicit Part(std::size_t slots) : bins(slots) {}

        core::BinFamily bins;
        std::uint64_t members = 0;               ///< slots of tiles
        std::atomic<std::uint64_t> believed{0};  ///< tiles that may be culled without their own callbacks being asked
        std::atomic<std::uint64_t> hideable{0};  ///< tiles that may be hidden, by the horizon or behind terrain
        std::atomic<std::uint64_t> certain{0};   ///< tiles of which nothing is in doubt: see InstalledTile::isCertain
        std::uint64_t withOwnColumns = 0;        ///< see Slot::hasOwnColumn
        std::uint64_t withSpheres = 0;           ///< see Slot::testsSphere
        double highest = -std::numeric_limits<double>::infinity();  ///< no tile is above
        double lowest = std::numeric_limits<double>::infinity();    ///< no tile is below
        osg::BoundingSphered columns;                               ///< about all columns
    };

    explicit TileBlock(std::size_t slots);

    [[nodiscard]] std::size_t size() const { return _slots.size(); }
    [[nodiscard]] const Slot& operator[](std::size_t slot) const { return _slots[slot]; }
    /// The one that begins with the slot `first`, a multiple of kMost. Requires: first < size().
    [[nodiscard]] const Part& partFrom(std::size_t first) const { return *_parts[first / Part::kMost]; }

    /// Its column is in doubt until the tile is believed.
    void addMember(std::size_t slot) {
        _parts[slot / Part::kMost]->members |= std::uint64_t{1} << (slot % Part::kMost);
        _columnUnion->addDoubts(1);
    }

    /// Copies what a tile is tested by.
    void set(std::size_t slot, const Slot& tile, const Bins& bins);

    /// Says whether the tile of a slot may be culled without its own callback being asked.
    void believe(std::size_t slot, bool is);
    /// Says whether the tile of a slot may be hidden. At any time.
    void allowHiding(std::size_t slot, bool is);
    /// Says whether something about the tile of a slot is in doubt. At any time.
    void trust(std::size_t slot, bool is);

    /// Holds the columns of all tiles.
    [[nodiscard]] ColumnUnion& columnUnion() const { return *_columnUnion; }

    /// Whether the horizon hides the bin of a tile.
    [[nodiscard]] bool isHidden(std::size_t slot, const core::HorizonEye& eye) const {
        return partFrom(slot).bins.hiddenFrom(eye, std::uint64_t{1} << (slot % Part::kMost)) != 0;
    }
    /// Whether the horizon hides the column of a tile that has its own.
    [[nodiscard]] bool isColumnHidden(std::size_t slot, const core::HorizonEye& eye) const {
        return slot < _columns.size() && eye.hides(_columns[slot]);
    }

protected:
    ~TileBlock() override;

private:
    std::vector<std::unique_ptr<Part>> _parts;
    std::vector<Slot> _slots;
    std::vector<core::HorizonBin> _columns;
    const osg::ref_ptr<ColumnUnion> _columnUnion = new ColumnUnion;
};

}  // namespace osgAnalyticBin
