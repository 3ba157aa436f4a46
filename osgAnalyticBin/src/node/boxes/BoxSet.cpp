// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxSet.h"

#include <osg/Notify>

namespace osgAnalyticBin {

void BoxTile::set(const MeshBox& box, bool isComplete) {
    _box = box;
    _isComplete = isComplete;
    _isTested = box.box().valid();
    if (_isTested) _tested = TestedBox(box.box());
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

void BoxSet::update() {
    std::vector<Growth> growths;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        growths.swap(_growths);
    }
    for (const Growth& growth : growths) {
        for (BoxTile* tile = growth.tile.get(); tile; tile = tile->parent()) {
            const bool isComplete = tile->isComplete() && !growth.isMisfit;
            if (isComplete == tile->isComplete() && tile->box().contains(growth.box)) continue;
            MeshBox box = tile->box();
            box.expandBy(growth.box);
            tile->set(box, isComplete);
        }
    }
}

}  // namespace osgAnalyticBin
