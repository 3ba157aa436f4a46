// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstalledTile.h"

#include <cmath>
#include <mutex>

namespace osgAnalyticBin {

namespace {

// Guards successors, and what tiles know of their families: some are doubted while others are settled, or while
// families are made.
[[nodiscard]] std::unique_lock<std::mutex> lockFamilies() {
    static std::mutex mutex;
    return std::unique_lock<std::mutex>(mutex);
}

}  // namespace

InstalledTile::InstalledTile(const InstalledTile& other) : osg::Referenced(other), _database(other._database) {}

InstalledTile::~InstalledTile() = default;

void InstalledTile::setSuccessor(InstalledTile& next) {
    const auto lock = lockFamilies();
    _successor = &next;
}

osg::ref_ptr<InstalledTile> InstalledTile::latest() {
    const auto lock = lockFamilies();
    osg::ref_ptr<InstalledTile> at(this);
    while (at->_successor) at = at->_successor;
    return at;
}

void InstalledTile::doubt(unsigned int reasons) {
    _reasons.fetch_or(reasons, std::memory_order_relaxed);
    const auto lock = lockFamilies();
    tellFamily();
}

void InstalledTile::settle(unsigned int reasons) {
    _reasons.fetch_and(~reasons, std::memory_order_relaxed);
    const auto lock = lockFamilies();
    tellFamily();
}

void InstalledTile::tellFamily() {
    if (!_block) return;
    _block->believe(_slot, _isSlotFilled && !has(Outgrown | NeverCulled | MeshUnread));
    _block->allowHiding(_slot, !has(IgnoresDepth));
    _block->trust(_slot, isCertain());
}

void InstalledTile::setPlates(std::shared_ptr<const core::GroundPlates> plates) {
    static std::atomic<std::uint64_t> last{0};
    const bool isWhole = plates && std::isfinite(plates->least(1, 0, 0));
    _plates = isWhole ? std::move(plates) : nullptr;
    _numberOfPlates = ++last;
}

void InstalledTile::setCover(const core::MeshCover& cover) {
    _place = cover.place;
    cover.isFilled ? settle(NotFilled) : doubt(NotFilled);
}

void InstalledTile::joinFamily(TileBlock& block, std::size_t slot) {
    leaveFamily();
    const auto lock = lockFamilies();
    _block = &block;
    _slot = slot;
}

void InstalledTile::leaveFamily() {
    emptySlot();
    const auto lock = lockFamilies();
    _block = nullptr;
}

void InstalledTile::fillSlot(const TileBlock::Slot& tile, const TileBlock::Bins& bins) {
    const auto lock = lockFamilies();
    if (!_block) return;
    _block->set(_slot, tile, bins);
    _isSlotFilled = true;
    tellFamily();
}

void InstalledTile::emptySlot() {
    const auto lock = lockFamilies();
    _isSlotFilled = false;
    tellFamily();
}

}  // namespace osgAnalyticBin
