// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BoxSet.h"

#include <osg/Notify>

#include <algorithm>

namespace osgAnalyticBin {

void BoxTile::set(const MeshBox& box, bool isComplete) {
    _box = box;
    _test.isComplete = isComplete;
    _test.isTested = box.box().valid();
    if (_test.isTested) _test.box = TestedBox(box.box());
    if (_slots) _slots->slots[_slot].test = _test;
}

void BoxTile::join(BoxSlots& slots, std::size_t number) {
    _slots = &slots;
    _slot = number;
    slots.slots[number].test = _test;
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

void BoxSet::awaitIndex(osg::Node& root, const std::string& file, BoxTile* parent,
                        const std::vector<osg::ref_ptr<BoxTile>>& tiles) {
    // where no update traversal ever comes
    constexpr std::size_t kMostContents = 65536;
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto isGone = [](const Awaiting& content) { return !content.root.valid(); };
    _awaiting.erase(std::remove_if(_awaiting.begin(), _awaiting.end(), isGone), _awaiting.end());
    if (!making() || _awaiting.size() > kMostContents) return;
    _awaiting.push_back({&root, file, parent, tiles});
}

void BoxSet::adopt(const Awaiting& content, const BinIndex& index) {
    osg::ref_ptr<osg::Node> root;
    if (!content.root.lock(root)) return;
    const auto found = index.files().find(content.file);
    const bool isKnown = found != index.files().end() && found->second.size() == content.tiles.size();
    if (!isKnown) {
        noteMisfit(content.file);
        if (content.parent) _growths.push_back({content.parent, {}, true});
        for (const osg::ref_ptr<BoxTile>& tile : content.tiles) tile->setMisfit();
    }
    for (std::size_t i = 0; isKnown && i < content.tiles.size(); ++i) {
        BoxTile& tile = *content.tiles[i];
        const MeshBox whole(found->second[i].bin);
        if (!tile.isMisfit() && whole.contains(tile.box())) {
            tile.set(whole, true);
        } else {
            noteMisfit(content.file);
            _growths.push_back({&tile, {}, true});
        }
    }
}

void BoxSet::adoptIndex() {
    const osg::ref_ptr<const BinIndex> whole = making() ? making()->whole() : nullptr;
    if (!whole) return;
    for (const Awaiting& content : _awaiting) adopt(content, *whole);
    _awaiting.clear();
}

void BoxSet::update() {
    if (making()) making()->showNotes();
    const std::lock_guard<std::mutex> lock(_mutex);
    adoptIndex();
    for (const Growth& growth : _growths) {
        for (BoxTile* tile = growth.tile.get(); tile; tile = tile->parent()) {
            if (growth.isMisfit) tile->setMisfit();
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
