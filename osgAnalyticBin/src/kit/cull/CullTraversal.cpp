// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTraversal.h"

#include "../GlmBridge.h"
#include "../tile/InstalledDatabase.h"

namespace osgAnalyticBin {

namespace {

// The visitor that traverses a database in this thread. Looking it up in the user data of visitors is slower.
thread_local std::pair<const osg::NodeVisitor*, CullTraversal*> scopeOfThread;

}  // namespace

CullTraversal::DatabaseScope::DatabaseScope(osg::NodeVisitor& visitor, CullTraversal& traversal,
                                            const DatabaseView* view)
    : _view(traversal._databaseView, view),
      _leftToOsg(traversal._isLeftToOsg, !view),
      _openSelections(traversal._openSelections, traversal._openSelections + 1),
      _ofThread(scopeOfThread, {&visitor, &traversal}) {}

CullTraversal::CullTraversal(BinStatistics& statistics) : _statistics(statistics) {}

CullTraversal::~CullTraversal() = default;

TileSelection& CullTraversal::selection() {
    if (_selections.size() <= _openSelections) _selections.resize(_openSelections + 1);
    return _selections[_openSelections];
}

CullTraversal& CullTraversal::of(osg::NodeVisitor& visitor) {
    if (scopeOfThread.first == &visitor) return *scopeOfThread.second;
    BinStatistics& statistics = BinStatistics::of(visitor);
    if (!statistics._traversal) statistics._traversal = new CullTraversal(statistics);
    return static_cast<CullTraversal&>(*statistics._traversal);
}

const core::PlaneSet& CullTraversal::planes(osg::CullStack& cullStack) {
    if (_databaseView && _databaseView->modelView == cullStack.getModelViewMatrix() &&
        _databaseView->projection == cullStack.getProjectionMatrix()) {
        return _databaseView->planes;
    }
    _planes = core::PlaneSet();
    for (const osg::Plane& plane : cullStack.getCurrentCullingSet().getFrustum().getPlaneList()) {
        if (_planes.size() < core::kMaxPlanes) _planes.push_back(toCore(plane));
    }
    return _planes;
}

CullTraversal::LastView& CullTraversal::lastView(const InstalledDatabase& database) {
    // those that are gone are not told apart from those out of view
    constexpr std::size_t kMostDatabases = 4096;
    if (_lastViews.size() >= kMostDatabases && _lastViews.count(&database) == 0) _lastViews.clear();
    LastView& last = _lastViews[&database];
    if (last.of.get() != &database) {
        last = LastView();
        last.of = &database;
    }
    return last;
}

}  // namespace osgAnalyticBin
