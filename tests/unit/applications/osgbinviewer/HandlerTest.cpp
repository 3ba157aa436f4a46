// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The event handlers in a whole viewer that draws into a pbuffer; keys are pressed as a user would. Needs a display
// (Xvfb will do); skipped where no graphics context can be made.

#include "DrawnViewer.h"
#include "Handlers.h"
#include "Traffic.h"
#include "ViewTools.h"
#include "ViewerScene.h"

#include <osgAnalyticBin/HiddenByTerrainCallback.h>
#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/ViewerCounts.h>

#include <osg/PolygonMode>
#include <osgGA/StateSetManipulator>
#include <osgViewer/ViewerEventHandlers>

#include <algorithm>

namespace osgAnalyticBin::viewer {
namespace {

class Handlers : public test::DrawnViewer {
protected:
    void SetUp() override {
        DrawnViewer::SetUp();
        if (IsSkipped()) return;
        _methods = new MethodSwitchHandler;
        _freeze = new FreezeCullHandler;
        _bins = new BinDisplayHandler;
        _stats = new osgViewer::StatsHandler;
        for (osgGA::GUIEventHandler* handler : std::initializer_list<osgGA::GUIEventHandler*>{
                 _methods, _freeze, _bins, new BinStatsHandler(*_stats), _stats})
            _viewer.addEventHandler(handler);
    }

    // A group above the database. Returns: it.
    osg::ref_ptr<osg::Group> wrapScene() {
        const osg::ref_ptr<osg::Group> scene = new osg::Group;
        scene->addChild(_viewer.getSceneData());
        _viewer.setSceneData(scene);
        return scene;
    }

    static void expectSameCounts(const TileCounts& ours, const TileCounts& theirs, const std::string& what) {
        EXPECT_EQ(ours.tested, theirs.tested) << what;
        EXPECT_EQ(ours.kept, theirs.kept) << what;
        EXPECT_EQ(ours.drawn, theirs.drawn) << what;
    }

    osg::Group& overlay() { return CameraCulling::of(*_viewer.getCamera()).overlay(); }
    void showOverlay(bool shown) { overlay().setNodeMask(shown ? ~0U : 0U); }

    static std::size_t differingBytes(const osg::Image& a, const osg::Image& b) {
        std::size_t count = 0;
        for (unsigned int i = 0; i < a.getTotalSizeInBytes(); ++i) count += a.data()[i] != b.data()[i] ? 1U : 0U;
        return count;
    }

    osg::ref_ptr<MethodSwitchHandler> _methods;
    osg::ref_ptr<FreezeCullHandler> _freeze;
    osg::ref_ptr<BinDisplayHandler> _bins;
    osg::ref_ptr<osgViewer::StatsHandler> _stats;
};

TEST_F(Handlers, SwitchToWhatAFreshViewerShowsWithTheMethod) {
    drawUntilIdle(_viewer);
    double side = 1.0;
    for (int i = 0; i < 4; ++i) {
        press('n');
        const Method method = _methods->cullOptions().method;
        look(_viewer, side = -side);
        drawUntilIdle(_viewer);
        showOverlay(false);
        osgViewer::Viewer fresh;
        const osg::ref_ptr<osg::GraphicsContext> surface = test::makeSurface();
        setUp(fresh, *surface, *read(method));
        look(fresh, side);
        drawUntilIdle(fresh);
        expectSameCounts(counts(_viewer), counts(fresh), methodName(method));
        EXPECT_EQ(counts(_viewer).hidden, counts(fresh).hidden) << methodName(method);
        EXPECT_EQ(differingBytes(*picture(_viewer), *picture(fresh)), 0u) << methodName(method);
        showOverlay(true);
    }
    EXPECT_EQ(_methods->cullOptions().method, Method::Quadratic);
}

TEST_F(Handlers, ScatterModelsThatTerrainMayHide) {
    constexpr unsigned int kModels = 40;
    const osg::ref_ptr<osg::Group> scene = wrapScene();
    _viewer.addEventHandler(new TrafficHandler(*scene, kModels));
    look(_viewer, 1.0);
    drawUntilIdle(_viewer);
    _viewer.frame();
    const osg::Group& models = *scene->getChild(1)->asGroup();
    ASSERT_EQ(models.getNumChildren(), kModels);
    const auto asks = [&] {
        const osg::Callback* const callback = models.getChild(0)->getCullCallback();
        return dynamic_cast<const HiddenByTerrainCallback*>(callback) != nullptr;
    };
    EXPECT_TRUE(asks());
    press('G');
    EXPECT_FALSE(asks());
    press('G');
    EXPECT_TRUE(asks());
    // anew about another place
    const osg::Vec3d before = models.getBound().center();
    look(_viewer, -1.0);
    _viewer.getCamera()->setViewMatrix(osg::Matrixd::translate(0.0, 1e5, 0.0) * _viewer.getCamera()->getViewMatrix());
    press('T');
    _viewer.frame();
    ASSERT_EQ(models.getNumChildren(), kModels);
    EXPECT_GT((models.getBound().center() - before).length(), 5e4);
}

// What a frozen camera draws, and where: CameraCullingTest.cpp.
TEST_F(Handlers, FreezeWhatIsDrawn) {
    drawUntilIdle(_viewer);
    const std::size_t drawn = counts(_viewer).drawn;
    press('F');
    EXPECT_TRUE(_freeze->isFrozen());
    const BinCounts counted = binCounts(*_viewer.getCamera(), _viewer.getFrameStamp()->getFrameNumber());
    EXPECT_EQ(counted.tested - counted.outside, counts(_viewer).kept) << "the survey is not what is drawn";
    EXPECT_EQ(overlay().getNumChildren(), 1u);
    look(_viewer, -1.0);
    drawUntilIdle(_viewer);
    EXPECT_EQ(counts(_viewer).drawn, drawn);
    const auto frozen = picture(_viewer);
    press('F');
    EXPECT_EQ(overlay().getNumChildren(), 0u);
    EXPECT_GT(differingBytes(*frozen, *picture(_viewer)), 1000u);
}

TEST_F(Handlers, ShowASlabForEachBinThatTheTraversalEndsAt) {
    drawUntilIdle(_viewer);
    EXPECT_EQ(_bins->slabs().getNumChildren(), 0u);
    press('B');
    const TileSurvey survey(*_viewer.getCamera(), *_viewer.getFrameStamp());
    const auto ends = std::count_if(survey.tiles().begin(), survey.tiles().end(),
                                    [](const SurveyedTile& tile) { return tile.isCulled || tile.isDrawn; });
    EXPECT_EQ(_bins->slabs().getNumChildren(), static_cast<unsigned int>(ends));
    const TileCounts counted = survey.counts();
    const std::vector<std::string> legend = texts(overlay());
    ASSERT_EQ(legend.size(), 7u);
    EXPECT_EQ(legend[0], std::to_string(counted.tested) + " tiles tested, " + std::to_string(counted.kept) + " kept, " +
                             std::to_string(counted.drawn) + " drawn");
    EXPECT_EQ(legend[4], std::to_string(counted.hidden) + " behind the horizon");
    press('B');
    EXPECT_EQ(_bins->slabs().getNumChildren(), survey.tiles().size());
    press('B');
    EXPECT_EQ(_bins->slabs().getNumChildren(), 0u);
}

// A curtain stands where it does; else one line.
TEST_F(Handlers, SayWhatIsMissingForTerrainToHideTiles) {
    const osg::ref_ptr<CoveredPictureHandler> covered = new CoveredPictureHandler;
    _viewer.addEventHandler(covered);
    osg::Camera& camera = *_viewer.getCamera();
    const osg::ref_ptr<osg::Group> scene = wrapScene();
    const auto isCurtainShown = [&] { return overlay().containsNode(&covered->curtain()); };
    EXPECT_FALSE(isCurtainShown());
    CullOptions options;
    const auto setOptions = [&] { setCullOptions(*scene->getChild(0), options); };
    press('O');
    const auto expectNeed = [&](const std::string& need) {
        drawUntilIdle(_viewer);
        EXPECT_EQ(texts(overlay()), std::vector<std::string>{"terrain hides nothing; it needs " + need});
    };
    camera.setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES);
    expectNeed("near and far planes that OSG computes by bounding volumes, or that are set");
    // what osgbinviewer begins with
    camera.setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
    expectNeed("an eye that is not high above the terrain");
    options.occlusion = OcclusionUse::On;
    setOptions();
    struct Unknown : osg::NodeCallback {};
    const osg::ref_ptr<osg::Node> unknown = new osg::Group;
    unknown->addCullCallback(new Unknown);
    scene->addChild(unknown);
    expectNeed("near and far planes that are set, or nothing but plain nodes and the tiles in the scene");
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    const osg::ref_ptr<osg::PolygonMode> asLines =
        new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE);
    camera.getOrCreateStateSet()->setAttribute(asLines);
    expectNeed("filled and opaque terrain, and declared shaders");
    camera.getStateSet()->removeAttribute(asLines);
    camera.setViewMatrixAsLookAt(osg::Vec3d(7e6, 0.0, 0.0), osg::Vec3d(), osg::Vec3d(0.0, 0.0, 1.0));
    expectNeed("a view that is steeper than 78 degrees nowhere");
    options.occlusion = OcclusionUse::Off;
    setOptions();
    expectNeed("occlusion=on or occlusion=auto");
    options.horizonUse = HorizonUse::Off;
    setOptions();
    expectNeed("options without horizon=off");
    options.method = Method::Sphere;
    setOptions();
    expectNeed("culling by bins (key n)");
    EXPECT_TRUE(isCurtainShown());
    EXPECT_EQ(covered->curtain().getNumChildren(), 0u);
    press('O');
    EXPECT_FALSE(isCurtainShown());
}

// Past the globe, so that the scene has no lines of its own.
TEST_F(Handlers, KeepTextFilledWhereTheSceneIsShownAsLines) {
    osg::Camera& camera = *_viewer.getCamera();
    _viewer.addEventHandler(new osgGA::StateSetManipulator(camera.getOrCreateStateSet()));
    const osg::Vec3d eye(6378137.0 + 300e3, 0.0, 0.0);
    camera.setViewMatrixAsLookAt(eye, eye * 2.0, osg::Vec3d(0.0, 0.0, 1.0));
    drawUntilIdle(_viewer);
    const auto before = picture(_viewer);
    press('B');
    const auto filled = picture(_viewer);
    EXPECT_GT(differingBytes(*before, *filled), 500u);
    press('w');
    EXPECT_EQ(differingBytes(*filled, *picture(_viewer)), 0u);
}

// The second time in the model with the most threads.
TEST_F(Handlers, ComeBackToWhatWasDrawnBefore) {
    drawUntilIdle(_viewer);
    const TileCounts before = counts(_viewer);
    const auto pictureBefore = picture(_viewer);
    for (const int key : {'F', 'B', 'B'}) press(key);
    EXPECT_GT(differingBytes(*pictureBefore, *picture(_viewer)), 0u);
    for (const int key : {'F', 'B'}) press(key);
    EXPECT_EQ(differingBytes(*pictureBefore, *picture(_viewer)), 0u);
    _viewer.setThreadingModel(osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext);
    for (const int key : {'F', 'B', 'n', 'n', 'n', 'n', 'n', 'n', 'n', 'n', 'F', 'B', 'B'}) press(key);
    _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    EXPECT_EQ(_methods->cullOptions().method, Method::Quadratic);
    EXPECT_EQ(_bins->shown(), BinDisplayHandler::Shown::Nothing);
    expectSameCounts(counts(_viewer), before, "after");
    showOverlay(false);
    EXPECT_EQ(differingBytes(*pictureBefore, *picture(_viewer)), 0u);
}

TEST_F(Handlers, NameTheirKeysAndTakeNoneOfOsgs) {
    const auto bindingsOf = [](const std::vector<osg::ref_ptr<osgGA::GUIEventHandler>>& handlers) {
        const osg::ref_ptr<osg::ApplicationUsage> usage = new osg::ApplicationUsage;
        for (const auto& handler : handlers) handler->getUsage(*usage);
        return usage->getKeyboardMouseBindings();
    };
    const auto osgs = bindingsOf(
        {_stats.get(), new osgViewer::HelpHandler, new osgViewer::WindowSizeHandler, new osgViewer::ThreadingHandler,
         new osgViewer::LODScaleHandler, new osgViewer::RecordCameraPathHandler, new osgViewer::ScreenCaptureHandler,
         new osgViewer::ToggleSyncToVBlankHandler, new osgGA::StateSetManipulator(new osg::StateSet)});
    const auto ours = bindingsOf({_methods.get(), _freeze.get(), _bins.get(), new CoveredPictureHandler});
    EXPECT_EQ(ours.size(), 5u);
    EXPECT_GT(osgs.size(), 14u);
    for (const auto& [key, text] : ours) EXPECT_EQ(osgs.count(key.substr(1)), 0u) << key << ": " << text;
    EXPECT_LT(ours.rbegin()->first, osgs.begin()->first) << "first in the help";
}

TEST(HomeView, HoldsTheWholeGlobeWithRoomInWindowsOfAnyShape) {
    test::ViewerScene scene;
    const osg::EllipsoidModel ellipsoid;
    for (const double aspect : {2.4, 1.0, 0.5}) {
        const osg::Matrixd projection = osg::Matrixd::perspective(29.15, aspect, 1.0, 1e8);
        const HomeView home = homeViewOf(scene.database(), projection);
        const osg::Matrixd toPicture = osg::Matrixd::lookAt(home.eye, home.center, home.up) * projection;
        double farthest = 0.0;
        for (double latitude = -1.5; latitude < 1.6; latitude += 0.1) {
            for (double longitude = 0.0; longitude < 6.3; longitude += 0.1) {
                osg::Vec3d point;
                ellipsoid.convertLatLongHeightToXYZ(latitude, longitude, 0.0, point.x(), point.y(), point.z());
                const osg::Vec3d at = point * toPicture;
                farthest = std::max({farthest, std::abs(at.x()), std::abs(at.y())});
            }
        }
        EXPECT_LT(farthest, 0.92) << aspect;
        EXPECT_GT(farthest, 0.7) << aspect;
    }
}

}  // namespace
}  // namespace osgAnalyticBin::viewer
