// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxSet.h"

#include <osg/Notify>

#include <algorithm>

namespace osgAnalyticBin {

namespace {

bool holds(const osg::BoundingSphere& sphere, const osg::BoundingBoxd& box) {
    if (!sphere.valid()) return false;
    const osg::Vec3d center = sphere.center();
    double farthest = 0.0;
    for (unsigned int i = 0; i < 8; ++i) farthest = std::max(farthest, (box.corner(i) - center).length());
    constexpr double kRounding = 1e-12;
    return farthest * (1.0 + kRounding) <= static_cast<double>(sphere.radius());
}

}  // namespace

void BoxTile::set(const MeshBox& box, bool isComplete) {
    _box = box;
    _test.isComplete = isComplete;
    _test.isTested = box.box().valid();
    // what is not loaded is where OSG's own sphere says, as far as anybody knows
    const bool isBySphere = _test.isTested && !isComplete && holds(_sphere, box.box());
    _test.asksNode = !isComplete && !isBySphere;
    if (_test.isTested) _test.box = isBySphere ? TestedBox(_sphere) : TestedBox(box.box());
    if (_slots) _slots->slots[_slot].test = _test;
}

void BoxTile::join(BoxSlots& slots, std::size_t number) {
    _slots = &slots;
    _slot = number;
    slots.slots[number].test = _test;
}

bool BoxTile::isLikeParent() const {
    constexpr double kShare = 0.9;
    const BoxTile* above = _parent.get();
    while (above && above->_followsParent) above = above->_parent.get();
    if (!above || !_test.isTested || !above->_test.isTested) return false;
    if (isBySphere() && above->isBySphere())
        return _sphere.center() == above->_sphere.center() && _sphere.radius() >= above->_sphere.radius();
    if (!_test.isComplete || !above->_test.isComplete) return false;
    const osg::Vec3d own = _box.box()._max - _box.box()._min;
    const osg::Vec3d all = above->_box.box()._max - above->_box.box()._min;
    return own.x() >= kShare * all.x() && own.y() >= kShare * all.y() && own.z() >= kShare * all.z();
}

void BoxSet::noteMisfit(const std::string& file) {
    if (_hasWarned.exchange(true)) return;
    OSG_WARN << "osgAnalyticBin: \"" << file
             << "\" does not fit the index of boxes; what it draws is kept visible. Make the index again: "
                "osgbinconv --index."
             << std::endl;
}

void BoxSet::grow(BoxTile& tile, const MeshBox& box, bool isMisfit) {
    if (box.isEmpty() && !isMisfit) return;
    const std::lock_guard<std::mutex> lock(_mutex);
    _growths.push_back({&tile, box, isMisfit});
}

bool BoxSet::isLikeParent(const BoxTile& tile) {
    const std::lock_guard<std::mutex> lock(_mutex);
    return tile.isLikeParent();
}

void BoxSet::update() {
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const Growth& growth : _growths) {
        for (BoxTile* tile = growth.tile.get(); tile; tile = tile->parent()) {
            const bool isComplete = tile->isComplete() && !growth.isMisfit;
            if (isComplete == tile->isComplete() && tile->box().contains(growth.box)) continue;
            MeshBox box = tile->box();
            box.expandBy(growth.box);
            tile->set(box, isComplete);
        }
    }
    _growths.clear();
}

}  // namespace osgAnalyticBin
