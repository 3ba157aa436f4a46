// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BenchViewer.h"

#include "Failure.h"

#include <OpenThreads/Thread>
#include <osg/Timer>
#include <osgDB/DatabasePager>

#include <chrono>
#include <cstring>

namespace osgAnalyticBin::bench {

using support::Failure;

namespace {

constexpr int kMostPictureFrames = 20;

osg::ref_ptr<osg::GraphicsContext> makeDrawingSurface(int width, int height) {
    const osg::ref_ptr<osg::GraphicsContext::Traits> traits =
        new osg::GraphicsContext::Traits(osg::DisplaySettings::instance());
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = width;
    traits->height = height;
    traits->pbuffer = true;
    traits->doubleBuffer = true;
    traits->depth = 24;
    traits->samples = 0;
    traits->sampleBuffers = 0;
    traits->vsync = false;
    osg::ref_ptr<osg::GraphicsContext> surface = osg::GraphicsContext::createGraphicsContext(traits);
    if (!surface) throw Failure("no display to draw on; set DISPLAY or run under \"xvfb-run -a\"");
    return surface;
}

// A software renderer draws while the program goes on: a frame's time is to hold all of it.
class FinishDrawing : public osg::Camera::DrawCallback {
public:
    void operator()(osg::RenderInfo&) const override { glFinish(); }
};

// So many frames later a frame has been drawn, in whatever threading model.
constexpr unsigned int kFramesBehind = 3;

void prepareCamera(osg::Camera& camera, osg::GraphicsContext& surface) {
    camera.setGraphicsContext(&surface);
    camera.setViewport(new osg::Viewport(0, 0, surface.getTraits()->width, surface.getTraits()->height));
    const GLenum buffer = surface.getTraits()->doubleBuffer ? GL_BACK : GL_FRONT;
    camera.setDrawBuffer(buffer);
    camera.setReadBuffer(buffer);
    flight::makeComparable(camera);
    camera.getOrCreateStateSet()->setMode(GL_DITHER, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
}

std::string sizeOf(const osg::Image& image) {
    return std::to_string(image.s()) + "x" + std::to_string(image.t());
}

}  // namespace

std::uint64_t differingPixels(const osg::Image& first, const osg::Image& second) {
    if (first.s() != second.s() || first.t() != second.t())
        throw Failure("sizes differ: " + sizeOf(first) + " and " + sizeOf(second));
    if (first.getPixelFormat() != second.getPixelFormat() || first.getDataType() != GL_UNSIGNED_BYTE ||
        second.getDataType() != GL_UNSIGNED_BYTE)
        throw Failure("formats differ, or are not 8 bits per channel");
    const std::size_t channels = first.getPixelSizeInBits() / 8u;
    std::uint64_t pixels = 0;
    for (unsigned int row = 0; row < static_cast<unsigned int>(first.t()); ++row)
        for (unsigned int column = 0; column < static_cast<unsigned int>(first.s()); ++column)
            pixels += std::memcmp(first.data(column, row), second.data(column, row), channels) != 0;
    return pixels;
}

BenchViewer::BenchViewer(int width, int height, osgViewer::ViewerBase::ThreadingModel threading)
    : _capture(new flight::FrameCapture) {
    _viewer.setThreadingModel(threading);
    prepareCamera(*_viewer.getCamera(), *makeDrawingSurface(width, height));
    _viewer.getCamera()->addFinalDrawCallback(_capture);
    _viewer.setRealizeOperation(new flight::WithoutAnisotropy);
    _viewer.setKeyEventSetsDone(0);
    _viewer.setQuitEventSetsDone(false);
}

void BenchViewer::show(osg::Node& root, osg::CullSettings::CullingMode culling) {
    rest();
    _viewer.getCamera()->setCullingMode(culling);
    // As long as somebody has the scene shown before, OSG does not put another root into it.
    const osg::ref_ptr<osgViewer::Scene> before = _viewer.getScene();
    _viewer.setSceneData(&root);
    if (!_viewer.isRealized()) _viewer.realize();
}

void BenchViewer::setView(const osg::Camera& other) {
    osg::Camera& camera = *_viewer.getCamera();
    camera.setViewMatrix(other.getViewMatrix());
    camera.setProjectionMatrix(other.getProjectionMatrix());
    camera.setComputeNearFarMode(other.getComputeNearFarMode());
}

void BenchViewer::drawFrame() {
    const bool threaded = _viewer.getThreadingModel() != osgViewer::ViewerBase::SingleThreaded;
    if (threaded && !_viewer.areThreadsRunning()) _viewer.startThreading();
    _viewer.frame();
    // the viewer keeps the times of some frames alone
    const unsigned int frame = _viewer.getFrameStamp()->getFrameNumber();
    if (frame > kFramesBehind) collectTimes(frame - kFramesBehind);
}

osg::ref_ptr<osg::Image> BenchViewer::pictureOf(osg::Node& root, const osg::Camera& view,
                                                osg::CullSettings::CullingMode culling) {
    show(root, culling);
    setView(view);
    _capture->request(_viewer.getFrameStamp()->getFrameNumber() + 1);
    osg::ref_ptr<osg::Image> picture;
    for (int i = 0; i < kMostPictureFrames && !picture; ++i) {
        drawFrame();
        picture = _capture->take();
    }
    rest();
    if (picture) return picture;
    throw Failure("a picture was never drawn; try --threading SingleThreaded");
}

void BenchViewer::sortByState() {
    _viewer.getCamera()->getOrCreateStateSet()->setRenderBinToInherit();
}

void BenchViewer::startTimes() {
    osg::Camera& camera = *_viewer.getCamera();
    osg::Stats& stats = *camera.getStats();
    if (!stats.collectStats("rendering")) camera.addFinalDrawCallback(new FinishDrawing);
    stats.collectStats("rendering", true);
    _times.clear();
    _timed.clear();
    _read = 0;
}

bool BenchViewer::drawUntilLoaded(double seconds) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    const osgDB::DatabasePager& pager = *_viewer.getDatabasePager();
    do {
        drawFrame();
        if (!pager.requiresUpdateSceneGraph() && !pager.getRequestsInProgress()) return true;
        OpenThreads::Thread::microSleep(1000);
    } while (Clock::now() < end);
    return false;
}

void BenchViewer::timeFrame() {
    const osg::ElapsedTime begin;
    drawFrame();
    _times.push_back({0.0, 0.0, begin.elapsedTime_m()});
    _timed.push_back(_viewer.getFrameStamp()->getFrameNumber());
}

void BenchViewer::collectTimes(unsigned int last) {
    for (; _read < _timed.size() && _timed[_read] <= last; ++_read) {
        const auto read = [&](const char* name, double& ms) {
            if (_viewer.getCamera()->getStats()->getAttribute(_timed[_read], name, ms)) ms *= 1000.0;
        };
        read("Cull traversal time taken", _times[_read].cullMs);
        read("Draw traversal time taken", _times[_read].drawMs);
    }
}

std::vector<FrameTimes> BenchViewer::takeTimes() {
    for (unsigned int i = 0; i < kFramesBehind; ++i) drawFrame();
    collectTimes(_viewer.getFrameStamp()->getFrameNumber());
    return std::move(_times);
}

void BenchViewer::rest() {
    if (_viewer.areThreadsRunning()) _viewer.stopThreading();
}

}  // namespace osgAnalyticBin::bench
