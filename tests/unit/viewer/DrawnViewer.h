// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <gtest/gtest.h>
#include <osgDB/DatabasePager>
#include <osgDB/ReadFile>
#include <osgText/Text>
#include <osgViewer/Viewer>

#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>
#include <vector>

namespace osgAnalyticBin::test {

/// Pixels along an edge of makeSurface().
constexpr int kSurfaceSize = 128;

/// A pbuffer. Returns: nullptr where no graphics context can be made.
[[nodiscard]] inline osg::ref_ptr<osg::GraphicsContext> makeSurface() {
    const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = kSurfaceSize;
    traits->height = kSurfaceSize;
    traits->pbuffer = true;
    traits->doubleBuffer = true;
    return osg::GraphicsContext::createGraphicsContext(traits);
}

/// A whole viewer that draws a synthetic globe into a pbuffer. Needs a display (Xvfb will do); skipped where no
/// graphics context can be made.
class DrawnViewer : public ::testing::Test {
protected:
    void SetUp() override {
        const osg::ref_ptr<osg::GraphicsContext> surface = makeSurface();
        if (!surface) GTEST_SKIP() << "no graphics context; run under xvfb-run";
        setUp(_viewer, *surface, *read(Method::Quadratic));
    }

    /// The globe with bins.
    [[nodiscard]] osg::ref_ptr<osg::Node> read(Method method) const {
        osg::ref_ptr<osg::Node> database = osgDB::readRefNodeFile(_file);
        CullOptions options;
        options.method = method;
        installBins(*database, options);
        return database;
    }

    /// Lets a viewer draw a scene on a surface.
    static void setUp(osgViewer::Viewer& viewer, osg::GraphicsContext& surface, osg::Node& database) {
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

    /// 300 km above the equator, looking down at 45 degrees to the east (1) or west (-1).
    static void look(osgViewer::Viewer& viewer, double side) {
        const osg::Vec3d eye(6378137.0 + 300e3, 0.0, 0.0);
        viewer.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(-1.0, side, 0.0), osg::Vec3d(1.0, 0.0, 0.0));
    }

    static void drawUntilIdle(osgViewer::Viewer& viewer) {
        constexpr int kMostFrames = 2000;
        for (int idle = 0, frame = 0; idle < 5 && frame < kMostFrames; ++frame) {
            viewer.frame();
            osgDB::DatabasePager& pager = *viewer.getDatabasePager();
            idle = pager.getRequestsInProgress() || pager.requiresUpdateSceneGraph() ? 0 : idle + 1;
            if (idle == 0) OpenThreads::Thread::microSleep(2000);
        }
    }

    void press(int key) {
        _viewer.getEventQueue()->keyPress(key);
        _viewer.getEventQueue()->keyRelease(key);
        drawUntilIdle(_viewer);
    }

    [[nodiscard]] static TileCounts counts(osgViewer::Viewer& viewer) {
        return TileSurvey(*viewer.getCamera(), *viewer.getFrameStamp()).counts();
    }

    /// Of the next frame.
    [[nodiscard]] static osg::ref_ptr<osg::Image> picture(osgViewer::Viewer& viewer) {
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

    /// What can be read below a node, in the order of its drawables.
    [[nodiscard]] static std::vector<std::string> texts(osg::Node& node) {
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

    const TemporaryFolder _folder;
    const std::string _file = writeSyntheticDatabase(_folder.path());
    osgViewer::Viewer _viewer;
};

}  // namespace osgAnalyticBin::test
