// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Viewers that draw on demand alone. Oracle: the same viewer without bins. OSGANALYTICBIN_REST_SECONDS has them watched
// for longer.

#include "DatabaseFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <OpenThreads/Thread>
#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/Timer>
#include <osgDB/WriteFile>
#include <osgViewer/Viewer>

#include <cstdlib>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin::test {
namespace {

constexpr int kSize = 64;

double seconds() {
    const char* const text = std::getenv("OSGANALYTICBIN_REST_SECONDS");
    return text ? std::atof(text) : 4.0;
}

// 24 tiles around the eye: every third file is not there.
osg::ref_ptr<osg::CoordinateSystemNode> makeGlobe(const TemporaryFolder& folder) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->setEllipsoidModel(new osg::EllipsoidModel);
    for (int i = 0; i < 24; ++i) {
        const double south = 0.2 * (i / 6), west = 0.2 * (i % 6);
        const core::GeodeticBin extents = extentsDeg(south, south + 0.2, west, west + 0.2);
        const std::string file = "fine" + std::to_string(i) + ".osgb";
        if (i % 3 != 0) {
            const osg::ref_ptr<osg::Node> fine = makeMeshTile(extents, 100.0);
            EXPECT_TRUE(osgDB::writeNodeFile(*fine, folder / file));
        }
        const osg::ref_ptr<osg::PagedLOD> tile = makePaged(makeMeshTile(extents, 0.0), file, 1e6F);
        tile->setDatabasePath(folder.path() + "/");
        root->addChild(tile);
    }
    return root;
}

/// A viewer that draws into a pbuffer. Without a display it has no context.
struct Resting {
    explicit Resting(osg::Node& scene) {
        const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
        traits->readDISPLAY();
        traits->setUndefinedScreenDetailsToDefaultScreen();
        traits->width = traits->height = kSize;
        traits->pbuffer = true;
        traits->doubleBuffer = false;
        context = osg::GraphicsContext::createGraphicsContext(traits);
        if (!context) return;
        osg::Camera& camera = *viewer.getCamera();
        camera.setGraphicsContext(context);
        camera.setViewport(0, 0, kSize, kSize);
        camera.setDrawBuffer(GL_FRONT);
        camera.setReadBuffer(GL_FRONT);
        camera.setProjectionMatrix(osg::Matrixd::perspective(60.0, 1.0, 10.0, 1e7));
        camera.setViewMatrix(osg::Matrixd::lookAt(ecefDeg(-0.1, 0.6, 20000.0), ecefDeg(0.4, 0.6, 0.0), {0, 0, 1}));
        viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        viewer.setRunFrameScheme(osgViewer::ViewerBase::ON_DEMAND);
        viewer.setSceneData(&scene);
        viewer.realize();
    }

    /// Returns: the number of frames that the viewer asks for in some seconds.
    int run(double time) {
        const osg::Timer_t start = osg::Timer::instance()->tick();
        int frames = 0;
        while (osg::Timer::instance()->delta_s(start, osg::Timer::instance()->tick()) < time) {
            if (viewer.checkNeedToDoFrame()) {
                viewer.frame();
                ++frames;
            } else {
                OpenThreads::Thread::microSleep(5000);
            }
        }
        return frames;
    }

    osg::ref_ptr<osg::GraphicsContext> context;
    osgViewer::Viewer viewer;
};

std::size_t filesIn(const osg::Group& root) {
    std::size_t count = 0;
    for (unsigned int i = 0; i < root.getNumChildren(); ++i) count += root.getChild(i)->asGroup()->getNumChildren() - 1;
    return count;
}

TEST(OnDemand, RestsWhereFilesAreMissing) {
    const TemporaryFolder folder;
    const auto stock = makeGlobe(folder), globe = makeGlobe(folder);
    ASSERT_GT(installBins(*globe), 0u);
    Resting without(*stock);
    if (!without.context) GTEST_SKIP() << "no graphics context";
    const int before = without.run(seconds());
    Resting with(*globe);
    const int now = with.run(seconds());
    EXPECT_LE(now, before + 3);
    EXPECT_EQ(filesIn(*globe), filesIn(*stock));
    EXPECT_GT(filesIn(*globe), 8u);
}

}  // namespace
}  // namespace osgAnalyticBin::test
