// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileCensus.h"

#include "Nodes.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>

#include <osg/PagedLOD>
#include <osg/Transform>
#include <osg/TriangleIndexFunctor>

#include <chrono>
#include <typeinfo>

namespace osgAnalyticBin::flight {

namespace {

struct CountTriangles {
    std::uint64_t count = 0;
    void operator()(unsigned int, unsigned int, unsigned int) { ++count; }
};

// The steps of osgUtil::SceneView::cullStage() that decide what is drawn, of a visitor that has just been made or
// reset. Nothing is sorted.
void cullScene(osgUtil::CullVisitor& visitor, osg::Camera& camera, osg::FrameStamp& frameStamp,
               osgUtil::StateGraph& stateGraph, osgUtil::RenderStage& stage) {
    stage.setViewport(camera.getViewport());
    stage.setCamera(&camera);
    visitor.setStateGraph(&stateGraph);
    visitor.setRenderStage(&stage);
    visitor.setFrameStamp(&frameStamp);
    visitor.setTraversalNumber(frameStamp.getFrameNumber());
    visitor.inheritCullSettings(camera);
    visitor.setTraversalMask(camera.getCullMask());

    const osg::ref_ptr<osg::RefMatrix> projection = new osg::RefMatrix(camera.getProjectionMatrix());
    const osg::ref_ptr<osg::RefMatrix> modelView = new osg::RefMatrix(camera.getViewMatrix());
    visitor.pushViewport(camera.getViewport());
    visitor.pushProjectionMatrix(projection);
    visitor.pushModelViewMatrix(modelView, osg::Transform::ABSOLUTE_RF);
    visitor.traverse(camera);
    visitor.popModelViewMatrix();
    visitor.popProjectionMatrix();
    visitor.popViewport();
}

std::uint64_t trianglesOf(osg::Drawable& drawable) {
    osg::TriangleIndexFunctor<CountTriangles> counter;
    drawable.accept(counter);
    return counter.count;
}

bool isPaged(const osg::PagedLOD& parent, const osg::Node& child) {
    const unsigned int index = parent.getChildIndex(&child);
    return index < parent.getNumFileNames() && !parent.getFileName(index).empty();
}

// What a page may consist of besides tiles.
bool isPlainGroup(const osg::Node& node) {
    return typeid(node) == typeid(osg::Group);
}

// Whether nothing but plain groups stands between the path's last node and the PagedLOD that had it loaded.
bool isOnPage(const osg::NodePath& path) {
    for (std::size_t i = path.size(); i-- > 1;) {
        const osg::Node& parent = *path[i - 1];
        if (const auto* const lod = dynamic_cast<const osg::PagedLOD*>(&parent)) return isPaged(*lod, *path[i]);
        if (!isPlainGroup(parent)) return false;
    }
    return false;
}

const AnalyticBinCullCallback* binCallback(osg::Node& node) {
    return support::findCallback<AnalyticBinCullCallback>(node.getCullCallback());
}

// The bin of the path's last node, a tile; the kit culls a tile that is a transform in a group that stands for it.
AnalyticBin binOfTile(const osg::NodePath& path) {
    const AnalyticBinCullCallback* callback = binCallback(*path.back());
    if (!callback && path.size() > 1 && isPlainGroup(*path[path.size() - 2])) {
        osg::Group& parent = *path[path.size() - 2]->asGroup();
        if (parent.getNumChildren() == 1) callback = binCallback(parent);
    }
    return callback ? callback->shownBin() : AnalyticBin();
}

// Whether the path's last node is a tile: a node with a stored bin, a PagedLOD, or what a page brings that is no
// PagedLOD, as the leaves of VirtualPlanetBuilder are.
bool isTile(const osg::NodePath& path) {
    osg::Node& node = *path.back();
    if (node.asDrawable()) return false;
    if (hasStoredBin(node) || dynamic_cast<const osg::PagedLOD*>(&node)) return true;
    return !isPlainGroup(node) && isOnPage(path);
}

}  // namespace

double CullStage::cull(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    _visitor->reset();
    _stateGraph->clean();
    _stage->reset();
    const auto begin = std::chrono::steady_clock::now();
    cullScene(*_visitor, camera, frameStamp, *_stateGraph, *_stage);
    _stage->sort();
    _stateGraph->prune();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

CullWatcher::CullWatcher() : _wanted(new RequestCounter) {
    BinStatistics::of(*this).setTileByTile(true);
    setDrawsAsCullVisitor(*this);
    setDatabaseRequestHandler(_wanted);
}

void CullWatcher::watch(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    const osg::ref_ptr<osgUtil::StateGraph> stateGraph = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    cullScene(*this, camera, frameStamp, *stateGraph, *stage);
}

void CullWatcher::apply(osg::Drawable& drawable) {
    enter(drawable);
    const unsigned int before = _currentReuseRenderLeafIndex;
    osgUtil::CullVisitor::apply(drawable);
    if (_currentReuseRenderLeafIndex != before) draw(drawable);
}

// A billboard does not pass its drawables through apply().
void CullWatcher::apply(osg::Billboard& node) {
    enter(node);
    const unsigned int before = _currentReuseRenderLeafIndex;
    osgUtil::CullVisitor::apply(node);
    if (_currentReuseRenderLeafIndex == before) return;
    for (unsigned int i = 0; i < node.getNumDrawables(); ++i) draw(*node.getDrawable(i));
}

std::uint64_t residentTiles(osg::Node& scene) {
    std::uint64_t count = 0;
    support::visitNodes(scene, [&](osg::Node&, osg::NodeVisitor& visitor) {
        count += isTile(visitor.getNodePath()) ? 1U : 0U;
        return true;
    });
    return count;
}

std::set<std::string> Census::keys() const {
    std::set<std::string> keys;
    for (const DrawnTile& tile : tiles) keys.insert(tile.key);
    return keys;
}

Census TileCensus::take(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    const osg::ref_ptr<TileCensus> census = new TileCensus;
    census->watch(camera, frameStamp);
    Census& found = census->_census;
    found.wanted = census->wanted();
    found.drawn = found.tiles.size();
    return std::move(found);
}

void TileCensus::enter(osg::Node& node) {
    ++_census.nodes;
    if (!_openTiles.empty()) _openTiles.back().kept = true;
    if (!isTile(getNodePath())) return;
    _openTiles.emplace_back();
    _openTiles.back().node = &node;
    _openTiles.back().drawn.key = keyOfPath();
    _openTiles.back().drawn.bin = binOfTile(getNodePath());
}

void TileCensus::leave(osg::Node& node) {
    if (_openTiles.empty() || _openTiles.back().node != &node) return;
    OpenTile& tile = _openTiles.back();
    ++_census.tested;
    if (tile.kept) ++_census.kept;
    if (tile.kept && dynamic_cast<const osg::PagedLOD*>(&node)) ++_census.pagedLods;
    if (!tile.drawn.meshes.empty()) _census.tiles.push_back(std::move(tile.drawn));
    _openTiles.pop_back();
}

void TileCensus::draw(osg::Drawable& drawable) {
    ++_census.drawables;
    _census.triangles += trianglesOf(drawable);
    if (_openTiles.empty()) return;
    const osg::Matrixd localToWorld =
        *getModelViewMatrix() * osg::Matrixd::inverse(getRenderStage()->getCamera()->getViewMatrix());
    _openTiles.back().drawn.meshes.push_back({&drawable, localToWorld});
}

std::string TileCensus::keyOfPath() {
    const osg::NodePath& path = getNodePath();
    std::string key;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const osg::Group* const parent = path[i - 1]->asGroup();
        // a group that stands for its only child is there with bins, and is not without
        if (parent && isPlainGroup(*parent) && parent->getNumChildren() == 1) continue;
        if (!key.empty()) key += '/';
        key += std::to_string(parent ? parent->getChildIndex(path[i]) : 0U);
    }
    return key;
}

}  // namespace osgAnalyticBin::flight
