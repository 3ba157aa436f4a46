// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TileCounter.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinStatistics.h>

#include <osg/Billboard>
#include <osg/PagedLOD>
#include <osg/Projection>
#include <osg/TriangleIndexFunctor>

namespace osgAnalyticBin::flight {

namespace {

class StoredBinFinder : public osg::NodeVisitor {
public:
    StoredBinFinder() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    using osg::NodeVisitor::apply;
    void apply(osg::Node& node) override {
        _found = _found || hasStoredBin(node);
        if (!_found) traverse(node);
    }
    [[nodiscard]] bool found() const { return _found; }

private:
    bool _found = false;
};

struct CountTriangles {
    std::uint64_t count = 0;
    void operator()(unsigned int, unsigned int, unsigned int) { ++count; }
};

std::uint64_t trianglesOf(osg::Drawable& drawable) {
    osg::TriangleIndexFunctor<CountTriangles> counter;
    drawable.accept(counter);
    return counter.count;
}

}  // namespace

/// Takes the requests of PagedLODs, and does nothing but count them.
class TileCounter::Wanted : public osg::NodeVisitor::DatabaseRequestHandler {
public:
    void requestNodeFile(const std::string&, osg::NodePath&, float, const osg::FrameStamp*,
                         osg::ref_ptr<osg::Referenced>&, const osg::Referenced*) override {
        ++count;
    }
    std::uint64_t count = 0;
};

TileCounter::TileCounter(bool binsAreStored) : _binsAreStored(binsAreStored), _wanted(new Wanted) {
    setDatabaseRequestHandler(_wanted);
}

TileCounts TileCounter::count(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    StoredBinFinder finder;
    camera.accept(finder);
    osg::ref_ptr<TileCounter> counter = new TileCounter(finder.found());
    counter->cull(camera, frameStamp);
    return counter->result();
}

// The steps of osgUtil::SceneView::cullStage() that decide what is drawn.
void TileCounter::cull(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    const osg::ref_ptr<osgUtil::StateGraph> stateGraph = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    stage->setViewport(camera.getViewport());
    stage->setCamera(&camera);
    setStateGraph(stateGraph);
    setRenderStage(stage);
    setFrameStamp(&frameStamp);
    setTraversalNumber(frameStamp.getFrameNumber());
    inheritCullSettings(camera);
    setTraversalMask(camera.getCullMask());

    const osg::ref_ptr<osg::RefMatrix> projection = new osg::RefMatrix(camera.getProjectionMatrix());
    const osg::ref_ptr<osg::RefMatrix> modelView = new osg::RefMatrix(camera.getViewMatrix());
    pushViewport(camera.getViewport());
    pushProjectionMatrix(projection);
    pushModelViewMatrix(modelView, osg::Transform::ABSOLUTE_RF);
    traverse(camera);
    popModelViewMatrix();
    popProjectionMatrix();
    popViewport();
}

TileCounts TileCounter::result() const {
    TileCounts counts = _counts;
    counts.wanted = _wanted->count;
    if (const BinStatistics* const statistics = BinStatistics::find(*this)) {
        const BinCounts bins = statistics->counts();
        counts.binsTested = bins.tested;
        counts.binsOutside = bins.outside;
        counts.binsInside = bins.inside;
        counts.binsStraddling = bins.straddling;
    }
    return counts;
}

template <class NodeType>
void TileCounter::visit(NodeType& node) {
    noteReached();
    const bool tile = isTile(node);
    if (tile) _openTiles.emplace_back();
    osgUtil::CullVisitor::apply(node);
    if (tile) closeTile();
}

void TileCounter::apply(osg::Node& node) {
    visit(node);
}
void TileCounter::apply(osg::Geode& node) {
    visit(node);
}
void TileCounter::apply(osg::Group& node) {
    visit(node);
}
void TileCounter::apply(osg::LOD& node) {
    visit(node);
}
void TileCounter::apply(osg::Transform& node) {
    visit(node);
}
void TileCounter::apply(osg::Projection& node) {
    visit(node);
}
void TileCounter::apply(osg::Camera& node) {
    visit(node);
}

void TileCounter::apply(osg::Drawable& drawable) {
    noteReached();
    const unsigned int before = _currentReuseRenderLeafIndex;
    osgUtil::CullVisitor::apply(drawable);
    if (_currentReuseRenderLeafIndex == before) return;
    noteDrawn();
    ++_counts.drawables;
    _counts.triangles += trianglesOf(drawable);
}

// A billboard does not pass its drawables through apply().
void TileCounter::apply(osg::Billboard& node) {
    noteReached();
    const unsigned int before = _currentReuseRenderLeafIndex;
    osgUtil::CullVisitor::apply(node);
    const unsigned int leaves = _currentReuseRenderLeafIndex - before;
    if (leaves == 0) return;
    noteDrawn();
    _counts.drawables += leaves;
    for (unsigned int i = 0; i < node.getNumDrawables(); ++i) _counts.triangles += trianglesOf(*node.getDrawable(i));
}

bool TileCounter::isTile(const osg::Node& node) const {
    return _binsAreStored ? hasStoredBin(node) : dynamic_cast<const osg::PagedLOD*>(&node) != nullptr;
}

void TileCounter::noteReached() {
    if (!_openTiles.empty()) _openTiles.back().kept = true;
}

void TileCounter::noteDrawn() {
    if (!_openTiles.empty()) _openTiles.back().drawn = true;
}

void TileCounter::closeTile() {
    const Tile tile = _openTiles.back();
    _openTiles.pop_back();
    ++_counts.tested;
    if (tile.kept) ++_counts.kept;
    if (tile.drawn) ++_counts.drawn;
}

}  // namespace osgAnalyticBin::flight
