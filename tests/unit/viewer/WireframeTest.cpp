// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

//
// The key 'w' of osgGA::StateSetManipulator in a viewer with a window: it changes the polygon mode of the camera's
// state, so that the far side of the globe is seen. Oracle: the pictures of the same viewer over the same globe without
// bins. Needs a display (Xvfb will do); skipped where no window can be made. State in the scene: ApplicationStateTest.

#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/PolygonMode>
#include <osgGA/StateSetManipulator>
#include <osgViewer/Renderer>
#include <osgViewer/Viewer>

#include <kit/DatabaseFixture.h>

namespace osgAnalyticBin {
namespace {

constexpr int kWindowSize = 256;

// One colour where tiles meet, whichever of them is drawn.
void colourByPlace(osg::MatrixTransform& tile) {
    osg::Geometry& geometry = *tile.getChild(0)->asGeode()->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec4Array> colours = new osg::Vec4Array;
    for (const osg::Vec3& vertex : dynamic_cast<const osg::Vec3Array&>(*geometry.getVertexArray())) {
        osg::Vec3d up = osg::Vec3d(vertex) * tile.getMatrix();
        up.normalize();
        colours->push_back(osg::Vec4(osg::Vec3(up * 0.4 + osg::Vec3d(0.6, 0.6, 0.6)), 1.0F));
    }
    geometry.setColorArray(colours, osg::Array::BIND_PER_VERTEX);
}

// 32 tiles of 45 degrees.
osg::ref_ptr<osg::CoordinateSystemNode> makeGlobe() {
    osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
    globe->setEllipsoidModel(new osg::EllipsoidModel);
    for (int i = 0; i < 32; ++i) {
        const double south = -90.0 + 45.0 * (i / 8);
        const double west = -180.0 + 45.0 * (i % 8);
        const auto mesh = test::makeMeshTile(test::extentsDeg(south, south + 45.0, west, west + 45.0), 0.0);
        colourByPlace(*mesh);
        globe->addChild(test::makePaged(mesh, "no.osgb", 1.0F));
    }
    return globe;
}

osg::ref_ptr<osg::GraphicsContext> makeWindow(int x) {
    const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->x = x;
    traits->width = kWindowSize;
    traits->height = kWindowSize;
    traits->windowDecoration = false;
    traits->doubleBuffer = true;
    return osg::GraphicsContext::createGraphicsContext(traits);
}

class WindowPicture : public osg::Camera::DrawCallback {
public:
    void operator()(osg::RenderInfo&) const override {
        image->readPixels(0, 0, kWindowSize, kWindowSize, GL_RGB, GL_UNSIGNED_BYTE);
    }
    osg::ref_ptr<osg::Image> image = new osg::Image;
};

/// A viewer that looks at the whole globe, with the handler that applications add to theirs.
class GlobeViewer {
public:
    GlobeViewer(osg::Node& globe, osg::GraphicsContext& window) {
        _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        _viewer.setLightingMode(osg::View::NO_LIGHT);
        osg::Camera& camera = *_viewer.getCamera();
        camera.setGraphicsContext(&window);
        camera.setViewport(0, 0, kWindowSize, kWindowSize);
        camera.setProjectionMatrixAsPerspective(40.0, 1.0, 1e6, 5e7);
        camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera.setViewMatrixAsLookAt(osg::Vec3d(2e7, 5e6, 8e6), osg::Vec3d(), osg::Vec3d(0.0, 0.0, 1.0));
        camera.setClearColor(osg::Vec4(0.0F, 0.0F, 0.0F, 1.0F));
        camera.setFinalDrawCallback(_picture);
        _viewer.addEventHandler(new osgGA::StateSetManipulator(camera.getOrCreateStateSet()));
        _viewer.setSceneData(&globe);
        _viewer.realize();
    }

    void press(int key) {
        _viewer.getEventQueue()->keyPress(key);
        _viewer.getEventQueue()->keyRelease(key);
    }

    /// Of the next frame.
    [[nodiscard]] osg::ref_ptr<osg::Image> picture() {
        _viewer.frame();
        return osg::clone(_picture->image.get(), osg::CopyOp::DEEP_COPY_ALL);
    }

    /// FILL where there is none.
    [[nodiscard]] osg::PolygonMode::Mode mode() {
        const auto* mode = dynamic_cast<const osg::PolygonMode*>(
            _viewer.getCamera()->getStateSet()->getAttribute(osg::StateAttribute::POLYGONMODE));
        return mode ? mode->getMode(osg::PolygonMode::FRONT) : osg::PolygonMode::FILL;
    }

    /// Tiles that the last traversal found behind the horizon.
    [[nodiscard]] std::uint32_t hidden() {
        auto* renderer = dynamic_cast<osgViewer::Renderer*>(_viewer.getCamera()->getRenderer());
        std::uint32_t count = 0;
        for (unsigned int i = 0; renderer && i < 2; ++i) {
            const osgUtil::SceneView* view = renderer->getSceneView(i);
            const BinStatistics* statistics = view ? BinStatistics::find(*view->getCullVisitor()) : nullptr;
            if (!statistics) continue;
            const BinCounts counts = statistics->getCounts();
            if (counts.frame == _viewer.getFrameStamp()->getFrameNumber()) count += counts.hidden;
        }
        return count;
    }

private:
    osgViewer::Viewer _viewer;
    const osg::ref_ptr<WindowPicture> _picture = new WindowPicture;
};

std::size_t coveredPixels(const osg::Image& image) {
    std::size_t count = 0;
    for (unsigned int i = 0; i < image.getTotalSizeInBytes(); i += 3) count += image.data()[i] > 0 ? 1U : 0U;
    return count;
}

std::size_t differingPixels(const osg::Image& a, const osg::Image& b) {
    std::size_t count = 0;
    for (unsigned int i = 0; i < a.getTotalSizeInBytes(); i += 3)
        count += std::equal(a.data() + i, a.data() + i + 3, b.data() + i) ? 0U : 1U;
    return count;
}

TEST(WireframeKey, ShowsWhatAViewerWithoutBinsShows) {
    const osg::ref_ptr<osg::CoordinateSystemNode> globe = makeGlobe();
    const osg::ref_ptr<osg::CoordinateSystemNode> withBins = makeGlobe();
    installBins(*withBins);
    const osg::ref_ptr<osg::GraphicsContext> window = makeWindow(0);
    const osg::ref_ptr<osg::GraphicsContext> windowWithBins = makeWindow(kWindowSize);
    if (!window || !windowWithBins) GTEST_SKIP() << "no window; run under xvfb-run";
    GlobeViewer viewer(*globe, *window);
    GlobeViewer viewerWithBins(*withBins, *windowWithBins);

    using Mode = osg::PolygonMode::Mode;
    std::size_t filled = 0;
    // once around, and to lines again
    for (const Mode expected : {Mode::FILL, Mode::LINE, Mode::POINT, Mode::FILL, Mode::LINE}) {
        for (int frame = 0; frame < 2; ++frame) {
            const auto picture = viewer.picture();
            const auto pictureWithBins = viewerWithBins.picture();
            EXPECT_EQ(differingPixels(*picture, *pictureWithBins), 0u) << expected << ", frame " << frame;
            const std::size_t covered = coveredPixels(*picture);
            EXPECT_GT(covered, 300u);
            if (expected == Mode::FILL) filled = covered;
            EXPECT_TRUE(expected != Mode::LINE || covered < filled);
        }
        ASSERT_EQ(viewer.mode(), expected);
        ASSERT_EQ(viewerWithBins.mode(), expected);
        // the horizon is there to be switched off
        EXPECT_EQ(viewerWithBins.hidden() > 0, expected == Mode::FILL);
        viewer.press('w');
        viewerWithBins.press('w');
    }
}

}  // namespace
}  // namespace osgAnalyticBin
