// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewerRig.h"

#include <osg/CoordinateSystemNode>
#include <osg/GraphicsContext>
#include <osg/PagedLOD>
#include <osgDB/DatabasePager>
#include <osgTerrain/Terrain>
#include <osgTerrain/TerrainTile>
#include <osgViewer/CompositeViewer>
#include <osgViewer/Viewer>

#include <support/VisitNodes.h>

namespace osgAnalyticBin::test {

namespace {

constexpr int kSize = 64;
constexpr double kFovDeg = 40.0;

osg::ref_ptr<osg::GraphicsContext> makeContext(int width) {
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = width;
    traits->height = kSize;
    traits->pbuffer = true;
    traits->doubleBuffer = false;
    traits->readDISPLAY();
    return osg::GraphicsContext::createGraphicsContext(traits);
}

void setUp(osg::Camera& camera, osg::GraphicsContext* context, int x) {
    camera.setGraphicsContext(context);
    camera.setViewport(x, 0, kSize, kSize);
    camera.setProjectionMatrixAsPerspective(kFovDeg, 1.0, 1000.0, 1e8);
}

osg::Matrixd turned(int camera) {
    return osg::Matrixd::rotate(osg::DegreesToRadians(30.0 * camera), 0.3, 1.0, 0.0);
}

osg::ref_ptr<osgViewer::ViewerBase> makeViews(int cameras, std::vector<osgViewer::View*>& views) {
    const osg::ref_ptr<osgViewer::CompositeViewer> viewer = new osgViewer::CompositeViewer;
    for (int i = 0; i < cameras; ++i) {
        const osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
        setUp(*view->getCamera(), makeContext(kSize), 0);
        viewer->addView(view);
        views.push_back(view);
    }
    return viewer;
}

osg::ref_ptr<osgViewer::ViewerBase> makeSlaves(int cameras, std::vector<osgViewer::View*>& views) {
    const osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
    const osg::ref_ptr<osg::GraphicsContext> context = makeContext(cameras * kSize);
    viewer->getCamera()->setProjectionMatrixAsPerspective(kFovDeg, 1.0, 1000.0, 1e8);
    for (int i = 0; i < cameras; ++i) {
        const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
        setUp(*camera, context, i * kSize);
        viewer->addSlave(camera, osg::Matrixd(), turned(i));
    }
    views.push_back(viewer);
    return viewer;
}

// OSG leaves tiles of osgTerrain that are new or changed, and that the update traversal does not come to, to the cull
// traversals; where several threads cull they all make the mesh at once, and crash, bins or not.
class MeshMaker : public osg::NodeVisitor {
public:
    MeshMaker() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

    void apply(osg::Node& node) override {
        auto* tile = dynamic_cast<osgTerrain::TerrainTile*>(&node);
        if (!tile) return traverse(node);
        if (_terrain && !tile->getTerrain()) tile->setTerrain(_terrain);
        if (tile->getDirtyMask() != 0) tile->init(tile->getDirtyMask(), true);
    }

    void apply(osg::CoordinateSystemNode& node) override {
        auto* outer = _terrain;
        if (auto* terrain = dynamic_cast<osgTerrain::Terrain*>(&node)) _terrain = terrain;
        apply(static_cast<osg::Node&>(node));
        _terrain = outer;
    }

private:
    osgTerrain::Terrain* _terrain = nullptr;
};

}  // namespace

const char* nameOf(Threading threading) {
    constexpr const char* kNames[] = {"SingleThreaded", "CullDrawThreadPerContext", "DrawThreadPerContext",
                                      "CullThreadPerCameraDrawThreadPerContext", "AutomaticSelection"};
    return kNames[threading];
}

ViewerRig::ViewerRig(osg::Node& scene, Threading threading, Layout layout, int cameras)
    : _viewer(layout == Layout::Views ? makeViews(cameras, _views) : makeSlaves(cameras, _views)) {
    _viewer->setThreadingModel(threading);
    _viewer->setKeyEventSetsDone(0);
    for (osgViewer::View* view : _views) view->setSceneData(&scene);
    _viewer->realize();
    _viewer->getCameras(_cameras);
}

ViewerRig::~ViewerRig() {
    _viewer->stopThreading();
}

bool ViewerRig::canDraw() {
    const osg::ref_ptr<osg::GraphicsContext> context = makeContext(kSize);
    return context && context->realize();
}

void ViewerRig::setMostPagedLods(unsigned int count) {
    view().getDatabasePager()->setTargetMaximumNumberOfPageLOD(count);
}

void ViewerRig::look(const osg::Matrixd& view) {
    for (std::size_t i = 0; i < _views.size(); ++i) {
        _views[i]->getCamera()->setViewMatrix(view * turned(static_cast<int>(i)));
    }
}

void ViewerRig::update(double time) {
    _viewer->advance(time);
    _viewer->eventTraversal();
    _viewer->updateTraversal();
    MeshMaker maker;
    view().getSceneData()->accept(maker);
}

void ViewerRig::render() {
    _viewer->renderingTraversals();
}

osg::Matrixd viewFrom(double latitude, double longitude, double altitude, double heading, double pitch) {
    osg::Matrixd toWorld;
    osg::EllipsoidModel().computeLocalToWorldTransformFromLatLongHeight(
        osg::DegreesToRadians(latitude), osg::DegreesToRadians(longitude), altitude, toWorld);
    const osg::Matrixd turn = osg::Matrixd::rotate(osg::DegreesToRadians(pitch), 1.0, 0.0, 0.0) *
                              osg::Matrixd::rotate(osg::DegreesToRadians(-heading), 0.0, 0.0, 1.0);
    return osg::Matrixd::inverse(turn * toWorld);
}

std::size_t pagedIn(osg::Node& scene) {
    std::size_t count = 0;
    visitNodes(scene, [&](osg::Node& node) {
        const auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        if (paged && paged->getNumChildren() > 1) ++count;
    });
    return count;
}

}  // namespace osgAnalyticBin::test
