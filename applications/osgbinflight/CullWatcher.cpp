// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CullWatcher.h"

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>

#include <osg/TriangleIndexFunctor>

#include <chrono>

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

std::uint64_t trianglesOf(osg::Drawable& drawable) {
    osg::TriangleIndexFunctor<CountTriangles> counter;
    drawable.accept(counter);
    return counter.count;
}

}  // namespace osgAnalyticBin::flight
