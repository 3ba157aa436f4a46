// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DatabaseCallbacks.h"

#include "../CallbackChain.h"
#include "../Classes.h"
#include "../GlmBridge.h"
#include "../cull/CullCallbacks.h"
#include "../cull/CullScopes.h"
#include "../cull/CullTraversal.h"
#include "../cull/DrawnState.h"
#include "../cull/TileFamily.h"
#include "../tile/BoundWatch.h"
#include "HiddenInView.h"

#include <osg/CoordinateSystemNode>
#include <osg/CullStack>
#include <osgDB/DatabasePager>
#include <osgTerrain/Terrain>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>

namespace osgAnalyticBin {

namespace {

// Whether a callback of the application's at the database's root or above may leave tiles out, or have them drawn
// otherwise; or the root's class may.
bool isAltered(const osg::NodePath& path) {
    const auto isOurs = [](const osg::Callback& callback) { return isExactly<DatabaseCullCallback>(callback); };
    return path.empty() || !drawsAllChildren(*path.back()) ||
           std::any_of(path.begin(), path.end(), [&](const osg::Node* node) {
               return node->getCullCallback() && CullCallbacks(*node, isOurs).mayLeaveOut;
           });
}

// Whether osgTerrain tiles of the database follow another Terrain: the nearest one above them.
bool isBelowOtherTerrain(const osg::NodePath& path, const Database& database) {
    for (auto node = path.rbegin(); node != path.rend(); ++node) {
        if (const auto* const terrain = dynamic_cast<const osgTerrain::Terrain*>(*node))
            return !database.follows(terrain);
    }
    return false;
}

// Whether a visitor may leave the database to OSG where bins gain nothing: others watch what becomes of tiles, or ask
// what the database hides. OSG's spheres of osgTerrain tiles follow neither the vertical scale nor another technique.
bool mayRest(osg::NodeVisitor& visitor, const CullTraversal& traversal, const TerrainShape& shape) {
    return visitor.getVisitorType() == osg::NodeVisitor::CULL_VISITOR && !traversal.statistics().isTileByTile() &&
           !traversal.hiding.isInUse(visitor) && shape.verticalScale == 1.0 && shape.techniqueMargin == 0.0;
}

// While it exists, all planes are undecided: culled or kept siblings before the database leave a part of them behind.
class WithAllPlanes {
public:
    explicit WithAllPlanes(osg::CullStack& cullStack) : _cullStack(cullStack), _before(frustum().getCurrentMask()) {
        setUndecided(frustum(),
                     static_cast<core::PlaneMask>((std::uint64_t{1} << frustum().getPlaneList().size()) - 1));
    }
    // for callbacks in front
    ~WithAllPlanes() { frustum().getCurrentMask() = _before; }
    WithAllPlanes(const WithAllPlanes&) = delete;
    WithAllPlanes& operator=(const WithAllPlanes&) = delete;

private:
    [[nodiscard]] osg::Polytope& frustum() const { return _cullStack.getCurrentCullingSet().getFrustum(); }

    osg::CullStack& _cullStack;
    const core::PlaneMask _before;
};

// In a cull traversal, which others may run at the same time. The next update traversal comes after all of them.
void putUpdateCallback(osg::Node& node, Database& database, const osg::Node* attachedTo) {
    // for all databases: nodes above count what is below them
    static std::mutex attaching;
    const std::lock_guard<std::mutex> lock(attaching);
    if (!findCallback<DatabaseUpdateCallback>(node.getUpdateCallback()))
        node.addUpdateCallback(new DatabaseUpdateCallback(&database, attachedTo));
}

// Clones of a node may share its callbacks.
void takeOffUpdate(osg::Node& node, const osg::ref_ptr<osg::Callback>& update) {
    const osg::ref_ptr<osg::Callback> nested = update->getNestedCallback();
    const bool isFirst = node.getUpdateCallback() == update;
    constexpr int kOwn = 2;  // references: the node's and the caller's
    if (isFirst && update->referenceCount() > kOwn) return node.setUpdateCallback(nested.get());
    node.removeUpdateCallback(update.get());
}

// Whether the callback behind the database's draws all that is selected, before any code of the application runs.
bool isDrawnNext(const TileSelection& selection, const osg::Group& root, const osg::Callback* next) {
    const TileFamily* const family = TileFamily::of(root);
    return family && family == next && !family->getNestedCallback() && selection.isAllBelow(*family);
}

}  // namespace

DatabaseCullCallback::DatabaseCullCallback(const DatabaseCullCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _database(other._database),
      _node(nullptr) {}

void DatabaseCullCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    osg::CullStack* cullStack = nv->asCullStack();
    osg::Group* group = node->asGroup();
    const bool isCulling = cullStack && group && _database->isCulling() && node == _node;
    const TerrainShape shape = _database->shape(_database->optionsOfCull());
    const CullComparison::View compared(isCulling ? _comparison.get() : nullptr, *node, *nv);
    std::optional<WithoutClusterCulling> clusters;
    if (cullStack && node == _node && !compared.isStock() && _database->replacesClusters())
        clusters.emplace(*cullStack);
    if (compared.isStock()) {
        leaveToOsg(*node, *nv);
    } else if (isCulling) {
        cull(*group, *nv, *cullStack, shape);
    } else {
        traverse(node, nv);
    }
    _database->noteCull();
    if (node == _node && _database->needsUpdate(shape)) putUpdateCallback(*node, *_database, node);
    // a clone
    if (!_node) putUpdateCallback(*node, *_database, nullptr);
}

void DatabaseCullCallback::leaveToOsg(osg::Node& node, osg::NodeVisitor& nv) {
    CullTraversal& traversal = CullTraversal::of(nv);
    BinCounts none;
    none.frame = static_cast<unsigned int>(nv.getTraversalNumber());
    if (nv.getVisitorType() == osg::NodeVisitor::CULL_VISITOR) traversal.statistics().add(none);
    const CullTraversal::DatabaseScope scope(nv, traversal, nullptr);
    traverse(&node, &nv);
}

void DatabaseCullCallback::cull(osg::Group& node, osg::NodeVisitor& nv, osg::CullStack& cullStack,
                                const TerrainShape& shape) {
    // makes tiles notice what was added below them
    (void)node.getBound();
    if (!BoundWatch::isOn(node)) {
        // the application has replaced the watch, and perhaps others: the next update places them anew
        _database->requestRefit();
        return leaveToOsg(node, nv);
    }
    if (isBelowOtherTerrain(nv.getNodePath(), *_database)) return leaveToOsg(node, nv);
    CullTraversal& traversal = CullTraversal::of(nv);
    const CullOptions& options = _database->optionsOfCull();
    const DatabaseRest::Turn turn = mayRest(nv, traversal, shape)
                                        ? traversal.lastView(*_database, nv).databaseRest.next(_database->arrivals())
                                        : DatabaseRest::Turn::Bins;
    if (turn == DatabaseRest::Turn::Osg) return leaveToOsg(node, nv);
    const WithAllPlanes planes(cullStack);
    DatabaseView view{node,
                      nv,
                      traversal,
                      cullStack,
                      cullStack.getModelViewMatrix(),
                      cullStack.getProjectionMatrix(),
                      traversal.planes(cullStack),
                      _database.get(),
                      toCore(*_database->ellipsoid()),
                      shape,
                      &traversal.selection(),
                      &traversal.selection(),
                      StateRules::of(nv, options.plainShaders)};
    if (osgUtil::CullVisitor* const visitor = nv.asCullVisitor()) view.states = visitor->getCurrentStateGraph();
    const auto* const files = nv.getDatabaseRequestHandler();
    if (files && isExactly<osgDB::DatabasePager>(*files)) view.pager = files;
    Gain gain;
    if (turn == DatabaseRest::Turn::BinsCounted) view.gain = &gain;
    view.isCold = _database->isCold();
    const auto region = _database->region();
    if (region) view.region = &*region;
    const HiddenInView hidden = hasActiveOccluders(cullStack)
                                    ? HiddenInView()
                                    : findHidden(view, *_database, options, isAltered(nv.getNodePath()));
    // callbacks of the application's run before what is drawn is selected then
    if (!hidden.isSelected) view.selection->clear();
    if (hidden.isSelected && !isDrawnNext(*view.selection, node, getNestedCallback())) view.selection->hold();
    if (hidden.isSelected) tellOthers(view, hidden);
    if (hidden.eye) view.eye = &*hidden.eye;
    if (hidden.fileEye) view.fileEye = &*hidden.fileEye;
    {
        const CullTraversal::DatabaseScope scope(nv, traversal, &view);
        traverse(&node, &nv);
    }
    view.selection->clear();
    if (view.gain) traversal.lastView(*_database, nv).databaseRest.note(gain);
}

void bringUpToDate(osg::Node& node, Database& database) {
    database.update();
    if (database.takeShapeChange()) database.refit(node);
}

DatabaseUpdateCallback::DatabaseUpdateCallback(const DatabaseUpdateCallback& other, const osg::CopyOp& copyop)
    : osg::Object(other, copyop),
      osg::Callback(other, copyop),
      osg::NodeCallback(other, copyop),
      _database(other._database),
      _node(nullptr) {}

// A copied callback gives its node a database of its own, and another callback in its place. One that is shared belongs
// to the original.
void DatabaseUpdateCallback::runOnClone(osg::Node& node, osg::NodeVisitor& nv) {
    const osg::ref_ptr<DatabaseUpdateCallback> self(this);
    const osg::ref_ptr<osg::Callback> nested = getNestedCallback();
    if (!_node) _database->installOnClone(node);
    if (nested) {
        nested->run(&node, &nv);
    } else {
        nv.traverse(node);
    }
}

void DatabaseUpdateCallback::operator()(osg::Node* node, osg::NodeVisitor* nv) {
    const osg::ref_ptr<osg::Callback> self(this);
    if (node != _node) return runOnClone(*node, *nv);
    bringUpToDate(*node, *_database);
    traverse(node, nv);
    const TerrainShape shape = _database->shape(_database->options());
    // a database that nobody looks at waits for the view that does
    constexpr unsigned int kMostUnseen = 16;
    _unseen = _database->takeCull() ? kMostUnseen : _unseen + 1;
    if (_unseen >= kMostUnseen && !_database->needsUpdate(shape)) takeOffUpdate(*node, self);
}

void attachDatabase(osg::Node& node, Database& database, bool isCulling) {
    detachDatabase(node);
    database.setRoot(node);
    database.setCulling(isCulling);
    // in front: what is nested runs in the scope of the database
    const osg::ref_ptr<DatabaseCullCallback> cull = new DatabaseCullCallback(&database, &node);
    putInFront(node, *cull);
    node.addUpdateCallback(new DatabaseUpdateCallback(&database, &node));
}

Database* attachedDatabase(osg::Node& node) {
    const auto* cull = findCallback<DatabaseCullCallback>(node.getCullCallback());
    return cull && cull->database()->isAttachedTo(node) ? cull->database() : nullptr;
}

void detachDatabase(osg::Node& node) {
    takeOffFirst<DatabaseCullCallback>(node);
    if (const osg::ref_ptr<osg::Callback> update = findCallback<DatabaseUpdateCallback>(node.getUpdateCallback()))
        takeOffUpdate(node, update);
}

void removeDatabase(osg::Node& node) {
    if (Database* const database = attachedDatabase(node)) database->setRemoved();
    detachDatabase(node);
}

}  // namespace osgAnalyticBin
