// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "SearchMemory.h"

#include "CullTraversal.h"

namespace osgAnalyticBin {

SearchMemory& SearchMemory::of(osg::NodeVisitor& visitor) {
    osg::ref_ptr<osg::Referenced>& memory = CullTraversal::of(visitor).searchMemory();
    if (!memory) memory = new SearchMemory;
    return static_cast<SearchMemory&>(*memory);
}

SearchMemory::LastView& SearchMemory::lastView(const InstalledDatabase& database) {
    for (auto& [known, view] : _lastViews) {
        if (known == &database) return view;
    }
    constexpr std::size_t kMostDatabases = 64;
    if (_lastViews.size() >= kMostDatabases) _lastViews.clear();
    return _lastViews.emplace_back(&database, LastView()).second;
}

}  // namespace osgAnalyticBin
