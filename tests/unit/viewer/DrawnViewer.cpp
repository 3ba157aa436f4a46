// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "DrawnViewer.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osgDB/DatabasePager>
#include <osgDB/ReadFile>
#include <osgText/Text>

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

}  // namespace osgAnalyticBin::test
