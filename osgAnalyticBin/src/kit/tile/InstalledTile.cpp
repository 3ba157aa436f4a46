// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstalledTile.h"

namespace osgAnalyticBin {

InstalledTile::InstalledTile(const InstalledTile& other)
    : osg::Referenced(other), _culled(nullptr), _database(other._database) {}

InstalledTile::~InstalledTile() = default;

void InstalledTile::keepVisible(bool kept) {
    _isKeptVisible.store(kept, std::memory_order_relaxed);
    tellFamily();
}

void InstalledTile::needSphere() {
    _needsSphere.store(true, std::memory_order_relaxed);
    tellFamily();
}

void InstalledTile::switchOffSphere(osg::Node& node) {
    _hasSwitchedOffSphere = node.getCullingActive();
    node.setCullingActive(false);
}

void InstalledTile::restoreSphere(osg::Node& node) const {
    if (_hasSwitchedOffSphere) node.setCullingActive(true);
}

void InstalledTile::setPlates(std::unique_ptr<const core::GroundPlates> plates) {
    static std::atomic<std::uint64_t> last{0};
    _plates = std::move(plates);
    _numberOfPlates = ++last;
}

void InstalledTile::doubtMesh(bool isMoved) {
    if (isMoved) _isMoved.store(true, std::memory_order_relaxed);
    _isMeshDoubted.store(true, std::memory_order_relaxed);
    _isMeshChanged.store(true, std::memory_order_relaxed);
    _isFilled.store(false, std::memory_order_relaxed);
    tellFamily();
}

void InstalledTile::ignoreDepth() {
    _ignoresDepth.store(true, std::memory_order_relaxed);
    tellFamily();
}

void InstalledTile::setCover(const core::MeshCover& cover) {
    _place = cover.place;
    _isFilled.store(cover.isFilled, std::memory_order_relaxed);
    tellFamily();
}

void InstalledTile::trustMesh() {
    _isMeshDoubted.store(false, std::memory_order_relaxed);
    tellFamily();
}

void InstalledTile::tellFamily() {
    if (!_block) return;
    _block->believe(_slot, _isSlotFilled && !isKeptVisible() && !isMeshDoubted() && !needsSphere());
    _block->allowHiding(_slot, obeysDepth());
    _block->trust(_slot, isCertain());
}

void InstalledTile::joinFamily(TileBlock& block, std::size_t slot) {
    leaveFamily();
    _block = &block;
    _slot = slot;
}

void InstalledTile::leaveFamily() {
    emptySlot();
    _block = nullptr;
}

void InstalledTile::fillSlot(const TileBlock::Slot& tile, const TileBlock::Bins& bins) {
    if (!_block) return;
    _block->set(_slot, tile, bins);
    _isSlotFilled = true;
    tellFamily();
}

void InstalledTile::emptySlot() {
    _isSlotFilled = false;
    tellFamily();
}

}  // namespace osgAnalyticBin
