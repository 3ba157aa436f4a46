// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "ViewerFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/CoordinateSystemNode>
#include <osgDB/DatabasePager>
#include <osgDB/ReadFile>
#include <osgText/Text>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <cmath>
#include <support/SyntheticDatabase.h>

namespace osgAnalyticBin::test {

osg::ref_ptr<osg::GraphicsContext> makeSurface() {
    const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = kSurfaceSize;
    traits->height = kSurfaceSize;
    traits->pbuffer = true;
    traits->doubleBuffer = true;
    return osg::GraphicsContext::createGraphicsContext(traits);
}

void DrawnViewer::SetUp() {
    _file = writeSyntheticDatabase(_folder.path());
    const osg::ref_ptr<osg::GraphicsContext> surface = makeSurface();
    if (!surface) GTEST_SKIP() << "no graphics context; run under xvfb-run";
    setUp(_viewer, *surface, *read(Method::Quadratic));
}

osg::ref_ptr<osg::Node> DrawnViewer::read(Method method) const {
    osg::ref_ptr<osg::Node> database = osgDB::readRefNodeFile(_file);
    CullOptions options;
    options.method = method;
    installBins(*database, options);
    return database;
}

void DrawnViewer::setUp(osgViewer::Viewer& viewer, osg::GraphicsContext& surface, osg::Node& database) {
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    osg::Camera& camera = *viewer.getCamera();
    camera.setGraphicsContext(&surface);
    camera.setViewport(0, 0, kSurfaceSize, kSurfaceSize);
    camera.setProjectionMatrixAsPerspective(40.0, 1.0, 1e3, 1e7);
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setDrawBuffer(GL_BACK);
    camera.setReadBuffer(GL_BACK);
    viewer.setSceneData(&database);
    viewer.realize();
    look(viewer, 1.0);
}

void DrawnViewer::look(osgViewer::Viewer& viewer, double side) {
    const osg::Vec3d eye(6378137.0 + 300e3, 0.0, 0.0);
    viewer.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(-1.0, side, 0.0), osg::Vec3d(1.0, 0.0, 0.0));
}

void DrawnViewer::drawUntilIdle(osgViewer::Viewer& viewer) {
    constexpr int kMostFrames = 2000;
    for (int idle = 0, frame = 0; idle < 5 && frame < kMostFrames; ++frame) {
        viewer.frame();
        osgDB::DatabasePager& pager = *viewer.getDatabasePager();
        idle = pager.getRequestsInProgress() || pager.requiresUpdateSceneGraph() ? 0 : idle + 1;
        if (idle == 0) OpenThreads::Thread::microSleep(2000);
    }
}

void DrawnViewer::press(int key) {
    _viewer.getEventQueue()->keyPress(key);
    _viewer.getEventQueue()->keyRelease(key);
    drawUntilIdle(_viewer);
}

TileCounts DrawnViewer::counts(osgViewer::Viewer& viewer) {
    return TileSurvey(*viewer.getCamera(), *viewer.getFrameStamp()).counts();
}

osg::ref_ptr<osg::Image> DrawnViewer::picture(osgViewer::Viewer& viewer) {
    struct Reader : osg::Camera::DrawCallback {
        void operator()(osg::RenderInfo&) const override {
            image->readPixels(0, 0, kSurfaceSize, kSurfaceSize, GL_RGB, GL_UNSIGNED_BYTE);
        }
        osg::ref_ptr<osg::Image> image = new osg::Image;
    };
    const osg::ref_ptr<Reader> reader = new Reader;
    viewer.getCamera()->setFinalDrawCallback(reader);
    viewer.frame();
    viewer.getCamera()->setFinalDrawCallback(nullptr);
    return reader->image;
}

std::vector<std::string> DrawnViewer::texts(osg::Node& node) {
    struct Reader : osg::NodeVisitor {
        Reader() : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) {}
        void apply(osg::Drawable& drawable) override {
            if (const auto* const text = dynamic_cast<const osgText::Text*>(&drawable))
                found.push_back(text->getText().createUTF8EncodedString());
        }
        std::vector<std::string> found;
    } reader;
    node.accept(reader);
    return reader.found;
}

namespace {

void collect(const osgUtil::StateGraph& graph, std::map<const osg::Drawable*, osg::Matrixd>& drawn) {
    for (const auto& leaf : graph._leaves) drawn[leaf->getDrawable()] = *leaf->_modelview;
    for (const auto& child : graph._children) collect(*child.second, drawn);
}

}  // namespace

ViewerScene::ViewerScene(const CullOptions& options)
    : _database(osgDB::readRefNodeFile(writeSyntheticDatabase(_folder.path()))),
      _camera(new osg::Camera),
      _stamp(new osg::FrameStamp) {
    installBins(*_database, options);
    _camera->addChild(_database);
    _camera->setViewport(0, 0, 400, 400);
    _camera->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
    _stamp->setFrameNumber(1);
}

void ViewerScene::lookFrom(double latitudeDeg, double longitudeDeg, double altitude, double pitchDeg, double fovDeg) {
    osg::Matrixd toWorld;
    const osg::EllipsoidModel wgs84;
    wgs84.computeLocalToWorldTransformFromLatLongHeight(osg::DegreesToRadians(latitudeDeg),
                                                        osg::DegreesToRadians(longitudeDeg), altitude, toWorld);
    const double pitch = osg::DegreesToRadians(pitchDeg);
    const osg::Vec3d sight(0.0, std::sin(pitch), -std::cos(pitch)), up(0.0, std::cos(pitch), std::sin(pitch));
    _camera->setViewMatrix(osg::Matrixd::inverse(toWorld) * osg::Matrixd::lookAt(osg::Vec3d(), sight, up));
    _camera->setProjectionMatrixAsPerspective(fovDeg, 1.0, 1000.0, 1e8);
}

std::map<const osg::Drawable*, osg::Matrixd> ViewerScene::cull() {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    const osg::ref_ptr<osgUtil::StateGraph> graph = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    stage->setViewport(_camera->getViewport());
    stage->setCamera(_camera);
    visitor->setStateGraph(graph);
    visitor->setRenderStage(stage);
    visitor->setFrameStamp(_stamp);
    visitor->setTraversalNumber(_stamp->getFrameNumber());
    visitor->inheritCullSettings(*_camera);
    visitor->pushViewport(_camera->getViewport());
    visitor->pushProjectionMatrix(new osg::RefMatrix(_camera->getProjectionMatrix()));
    visitor->pushModelViewMatrix(new osg::RefMatrix(_camera->getViewMatrix()), osg::Transform::ABSOLUTE_RF);
    if (osg::Callback* callback = _camera->getCullCallback())
        callback->run(_camera, visitor);
    else
        visitor->traverse(*_camera);
    visitor->popModelViewMatrix();
    visitor->popProjectionMatrix();
    visitor->popViewport();
    nearPlane = visitor->getCalculatedNearPlane();
    farPlane = visitor->getCalculatedFarPlane();
    std::map<const osg::Drawable*, osg::Matrixd> drawn;
    collect(*graph, drawn);
    return drawn;
}

}  // namespace osgAnalyticBin::test
