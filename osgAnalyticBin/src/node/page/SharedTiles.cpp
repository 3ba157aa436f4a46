// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SharedTiles.h"

#include <algorithm>

namespace osgAnalyticBin {

SharedTiles& SharedTiles::instance() {
    // never destroyed: a pager that an application never deletes may still read
    static SharedTiles& tiles = *new SharedTiles;
    return tiles;
}

SharedTiles::Outcome SharedTiles::installOnce(osg::Node& node, const std::string& place, unsigned int generation,
                                              const std::function<void()>& install) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto known = _installed.find(&node);
    if (known != _installed.end() && known->second.node.valid()) {
        if (known->second.place != place) return Outcome::Elsewhere;
        if (known->second.generation == generation || node.getNumParents() > 0) return Outcome::Usable;
    }
    // In a scene already, without bins: a cull traversal may be in it just now. OSG's spheres stay in charge there.
    if (node.getNumParents() > 0) return Outcome::Usable;
    install();
    forgetDeleted();
    _installed[&node] = {osg::observer_ptr<osg::Node>(&node), place, generation};
    return Outcome::Usable;
}

void SharedTiles::forgetDeleted() {
    if (_installed.size() < _enough) return;
    for (auto entry = _installed.begin(); entry != _installed.end();) {
        entry = entry->second.node.valid() ? std::next(entry) : _installed.erase(entry);
    }
    _enough = std::max<std::size_t>(64, 2 * _installed.size());
}

}  // namespace osgAnalyticBin
