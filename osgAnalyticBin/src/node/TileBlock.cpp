// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileBlock.h"

namespace osgAnalyticBin {

namespace {

const core::HorizonBin& neverHidden() {
    static const core::HorizonBin bin(core::Ellipsoid(1.0, 1.0), core::GeodeticBin());
    return bin;
}

}  // namespace

TileBlock::TileBlock(std::size_t slots) : _slots(slots), _horizons(slots, neverHidden()), _believed(slots) {}

TileBlock::~TileBlock() = default;

void TileBlock::set(std::size_t slot, const Slot& tile, const Horizons& horizons) {
    _slots[slot] = tile;
    if (horizons.column != horizons.bin && _columns.empty()) _columns = _horizons;
    _horizons[slot] = horizons.bin ? *horizons.bin : neverHidden();
    if (!_columns.empty()) _columns[slot] = horizons.column ? *horizons.column : neverHidden();
}

}  // namespace osgAnalyticBin
