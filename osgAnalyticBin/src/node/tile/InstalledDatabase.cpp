// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "InstalledDatabase.h"

namespace osgAnalyticBin {

InstalledDatabase::~InstalledDatabase() = default;

bool InstalledDatabase::takes(const osg::EllipsoidModel& ellipsoid) {
    const Ground wanted = isMapPlane(ellipsoid) ? Ground::Map : Ground::Globe;
    Ground known = Ground::Open;
    return _ground.compare_exchange_strong(known, wanted, std::memory_order_relaxed) || known == wanted;
}

void InstalledDatabase::noteChanged(osg::Group& group) const {
    const std::lock_guard<std::mutex> lock(_changing);
    constexpr std::size_t kMostGroups = 4096;  // where no update traversal ever comes
    if (_changed.size() < kMostGroups) _changed.emplace_back(&group);
    requestUpdate();
}

InstalledDatabase::Groups InstalledDatabase::takeChanged() {
    const std::lock_guard<std::mutex> lock(_changing);
    Groups changed;
    changed.swap(_changed);
    return changed;
}

}  // namespace osgAnalyticBin
