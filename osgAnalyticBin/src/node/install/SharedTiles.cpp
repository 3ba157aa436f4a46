// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SharedTiles.h"

#include <algorithm>

namespace osgAnalyticBin {

SharedTiles& SharedTiles::instance() {
    static SharedTiles tiles;
    return tiles;
}

SharedTiles::Outcome SharedTiles::treatOnce(osg::Node& node, const std::string& place, unsigned int generation,
                                            const std::function<void()>& treat) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto known = _treated.find(&node);
    if (known != _treated.end() && known->second.node.valid()) {
        if (known->second.place != place) return Outcome::Elsewhere;
        if (known->second.generation == generation || node.getNumParents() > 0) return Outcome::Usable;
    }
    // In a scene already, without bins: a cull traversal may be in it just now. OSG's spheres stay in charge there.
    if (node.getNumParents() > 0) return Outcome::Usable;
    treat();
    forgetDeleted();
    _treated[&node] = {osg::observer_ptr<osg::Node>(&node), place, generation};
    return Outcome::Usable;
}

void SharedTiles::forgetDeleted() {
    if (_treated.size() < _enough) return;
    for (auto entry = _treated.begin(); entry != _treated.end();) {
        entry = entry->second.node.valid() ? std::next(entry) : _treated.erase(entry);
    }
    _enough = std::max<std::size_t>(64, 2 * _treated.size());
}

}  // namespace osgAnalyticBin
