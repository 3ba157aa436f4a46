// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstalledTile.h"

#include "Database.h"

namespace osgAnalyticBin {

InstalledTile::InstalledTile(const osg::Node& culled, Database& database) : _culled(&culled), _database(&database) {}

InstalledTile::InstalledTile(const InstalledTile& other)
    : osg::Referenced(other), _culled(nullptr), _database(other._database), _wasActive(other._wasActive) {}

InstalledTile::~InstalledTile() = default;

void InstalledTile::suspendSphere(osg::Node& node) {
    _wasActive.push_back(node.getCullingActive());
    if (!_wasActive.back()) return;
    node.setCullingActive(false);
    if (isFor(&node)) {
        _wasCulledActive = true;
    } else {
        _suspended.emplace_back(&node);
    }
}

void InstalledTile::resumeSpheres(osg::Node& culled) {
    if (_wasCulledActive) culled.setCullingActive(true);
    for (const auto& node : _suspended) node->setCullingActive(true);
    _wasCulledActive = false;
    _suspended.clear();
}

}  // namespace osgAnalyticBin
