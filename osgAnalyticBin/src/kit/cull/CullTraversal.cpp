// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullTraversal.h"

#include "../GlmBridge.h"
#include "../tile/InstalledDatabase.h"

#include <algorithm>
#include <iterator>

namespace osgAnalyticBin {

namespace {

// The visitor that traverses a database in this thread. Looking it up in the user data of visitors is slower.
thread_local std::pair<const osg::NodeVisitor*, CullTraversal*> scopeOfThread;

// Null: only the visitor's own.
const osg::Camera* innermostCamera(const osg::NodePath& path) {
    for (auto node = path.rbegin(); node != path.rend(); ++node)
        if (const osg::Camera* const camera = (*node)->asCamera()) return camera;
    return nullptr;
}

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

CullTraversal::LastView& CullTraversal::lastView(const InstalledDatabase& database, const osg::NodeVisitor& visitor) {
    constexpr std::size_t kMostDatabases = 4096;
    auto known = _lastViews.find(&database);
    if (known == _lastViews.end() || !known->second.of.valid()) {
        // what is kept of those that are gone may hold threads; the system may give one's address to another
        for (auto of = _lastViews.begin(); of != _lastViews.end();)
            of = of->second.of.valid() ? std::next(of) : _lastViews.erase(of);
        if (_lastViews.size() >= kMostDatabases) _lastViews.clear();
        known = _lastViews.try_emplace(&database).first;
        known->second.of = &database;
    }
    LastViews& last = known->second;
    const osg::Camera* const camera = innermostCamera(visitor.getNodePath());
    std::vector<LastView>& views = last.views;
    auto own = std::find_if(views.begin(), views.end(), [camera](const LastView& of) { return of.camera == camera; });
    if (own == views.end()) {
        // cameras that come and go continue where others have ended
        constexpr std::size_t kMostCameras = 8;
        if (views.size() < kMostCameras) views.emplace_back();
        own = views.end() - 1;
        own->camera = camera;
    }
    if (own != views.begin()) std::rotate(views.begin(), own, own + 1);
    return views.front();
}

}  // namespace osgAnalyticBin
