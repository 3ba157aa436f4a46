// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileBlock.h"

#include <algorithm>

namespace osgAnalyticBin {

namespace {

const core::HorizonBin& neverHidden() {
    static const core::HorizonBin bin(core::Ellipsoid(1.0, 1.0), core::GeodeticBin());
    return bin;
}

// Returns: whether it was set otherwise.
bool setBit(std::atomic<std::uint64_t>& bits, std::size_t number, bool is) {
    const std::uint64_t bit = std::uint64_t{1} << number;
    const std::uint64_t before =
        is ? bits.fetch_or(bit, std::memory_order_relaxed) : bits.fetch_and(~bit, std::memory_order_relaxed);
    return ((before & bit) != 0) != is;
}

}  // namespace

TileBlock::TileBlock(std::size_t slots) : _slots(slots) {
    for (std::size_t first = 0; first < slots; first += Part::kMost) {
        _parts.push_back(std::make_unique<Part>(std::min<std::size_t>(Part::kMost, slots - first)));
    }
}

TileBlock::~TileBlock() = default;

void TileBlock::set(std::size_t slot, const Slot& tile, const Bins& bins) {
    _slots[slot] = tile;
    Part& part = *_parts[slot / Part::kMost];
    const std::size_t i = slot % Part::kMost;
    const std::uint64_t bit = std::uint64_t{1} << i;
    part.withOwnColumns = tile.hasOwnColumn ? part.withOwnColumns | bit : part.withOwnColumns & ~bit;
    part.withSpheres = tile.testsSphere ? part.withSpheres | bit : part.withSpheres & ~bit;
    part.highest = std::max(part.highest, tile.altitude.upper);
    part.lowest = std::min(part.lowest, tile.altitude.lower);
    if (tile.column.valid()) {
        const osg::BoundingSphered column(tile.column.center(), tile.column.radius());
        _columnUnion->expandBy(column);
        part.columns.expandBy(column);
    }
    part.bins.clear(i);
    if (bins.quadratic) part.bins.set(i, *bins.quadratic);
    if (bins.exact) part.bins.set(i, *bins.exact);
    if (bins.horizon) part.bins.setHorizon(i, *bins.horizon);
    if (tile.hasOwnColumn && _columns.empty()) _columns.assign(size(), neverHidden());
    if (!_columns.empty()) _columns[slot] = bins.column ? *bins.column : neverHidden();
}

void TileBlock::believe(std::size_t slot, bool is) {
    if (setBit(_parts[slot / Part::kMost]->believed, slot % Part::kMost, is)) _columnUnion->addDoubts(is ? -1 : 1);
}

void TileBlock::allowHiding(std::size_t slot, bool is) {
    (void)setBit(_parts[slot / Part::kMost]->hideable, slot % Part::kMost, is);
}

void TileBlock::trust(std::size_t slot, bool is) {
    (void)setBit(_parts[slot / Part::kMost]->certain, slot % Part::kMost, is);
}

}  // namespace osgAnalyticBin
