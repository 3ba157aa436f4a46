// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Cameras in the scene: their depth buffers, their settings, those that draw shadow maps, those between a database and
// its tiles, and the two eyes of a stereo view. Oracle of these: samples of the tiles. Cameras of all frames and
// orders: tests/long/scenes.

#include "KitTest.h"

#include <osg/DisplaySettings>
#include <osg/State>
#include <osgUtil/SceneView>
#include <osgViewer/GraphicsWindow>

namespace osgAnalyticBin::test {
namespace {

using osg::Camera;
using osg::CullSettings;
using osg::Transform;

// A camera's look from outside of the globe.
CullView fromAfar() {
    return CullView::lookAt({3e7, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
}

std::vector<Look> looksAt(osg::Node& scene, const CullView& view, CameraGlobe& globe) {
    (void)cull(scene, view);
    return globe.takeLooks();
}

std::size_t reachedBy(osg::Node& scene, CameraGlobe& globe, osg::State* state = nullptr) {
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    visitor->setState(state);
    cull(scene, fromAfar(), *visitor);
    const std::vector<Look> looks = globe.takeLooks();
    return looks.empty() ? 0 : looks.back().reached.size();
}

TEST(DepthBuffers, OfTexturesHaveToBeFineForAHorizon) {
    CameraGlobe globe(horizonOptions());
    const std::size_t hidden = reachedBy(globe.root(), globe);
    const auto reachedWith = [&](const auto& setUp) {
        const osg::ref_ptr<Camera> camera =
            makeCamera("texture", globe, Transform::RELATIVE_RF, Camera::PRE_RENDER, osg::Matrixd(), osg::Matrixd());
        camera->setRenderTargetImplementation(Camera::FRAME_BUFFER_OBJECT);
        camera->attach(Camera::COLOR_BUFFER, new osg::Texture2D);
        setUp(*camera);
        return reachedBy(*camera, globe);
    };
    for (const GLenum format : std::array<GLenum, 3>{GL_DEPTH_COMPONENT, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F})
        EXPECT_EQ(reachedWith([&](Camera& camera) { camera.attach(Camera::DEPTH_BUFFER, format); }), hidden) << format;
    EXPECT_EQ(reachedWith([](Camera&) {}), hidden) << "OSG adds one of 24 bits";
    EXPECT_GT(reachedWith([](Camera& camera) { camera.attach(Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT16); }), hidden);
    EXPECT_GT(reachedWith([](Camera& camera) { camera.setImplicitBufferAttachmentMask(0, 0); }), hidden);
    EXPECT_GT(reachedWith([](Camera& camera) {
                  const osg::ref_ptr<osg::Texture2D> depth = new osg::Texture2D;
                  depth->setInternalFormat(GL_DEPTH_COMPONENT16);
                  camera.attach(Camera::DEPTH_BUFFER, depth);
              }),
              hidden);
}

TEST(DepthBuffers, OfWindowsHaveToBeFineForAHorizon) {
    CameraGlobe globe(horizonOptions());
    const std::size_t hidden = reachedBy(globe.root(), globe);
    for (const unsigned int bits : {16u, 24u, 32u}) {
        const osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
        traits->depth = bits;
        const osg::ref_ptr<osg::GraphicsContext> window = new osgViewer::GraphicsWindowEmbedded(traits);
        const osg::ref_ptr<osg::State> state = new osg::State;
        state->setGraphicsContext(window);
        EXPECT_EQ(reachedBy(globe.root(), globe, state) > hidden, bits < 24) << bits;
    }
}

// What is behind the horizon of a light may still be what a shadow map needs: its back faces are drawn.
TEST(NestedCameras, NoHorizonInShadowPassesHoweverTheyAreMade) {
    CameraGlobe globe(horizonOptions());
    CullOptions asked = horizonOptions();
    asked.inheritViewpoint = true;
    CameraGlobe forShadows(asked);
    const CullView view = fromAfar();
    const auto reached = [&](CameraGlobe& scene, Transform::ReferenceFrame frame, bool depthMap, bool colours,
                             bool relativeInside) {
        const osg::ref_ptr<Camera> camera =
            makeCamera("pass", scene, frame, Camera::PRE_RENDER, view.modelView, view.projection);
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
        if (depthMap) camera->attach(Camera::DEPTH_BUFFER, texture.get());
        if (colours) camera->attach(Camera::COLOR_BUFFER, texture.get());
        if (relativeInside) {
            camera->removeChildren(0, 1);
            camera->addChild(makeCamera("inside", scene, Transform::RELATIVE_RF, Camera::PRE_RENDER, osg::Matrixd(),
                                        osg::Matrixd()));
        }
        return looksAt(*camera, view, scene).at(0).reached.size();
    };
    const auto absolute = Transform::ABSOLUTE_RF;
    const auto inheriting = Transform::ABSOLUTE_RF_INHERIT_VIEWPOINT;
    EXPECT_EQ(reached(globe, inheriting, true, false, false), 128u);
    EXPECT_EQ(reached(globe, inheriting, false, true, false), 128u);
    EXPECT_EQ(reached(globe, inheriting, true, true, true), 128u);
    EXPECT_EQ(reached(globe, absolute, true, false, false), 128u);  // as ParallelSplitShadowMap has it
    EXPECT_EQ(reached(globe, absolute, true, false, true), 128u);
    EXPECT_LT(reached(globe, absolute, false, false, false), 100u);
    EXPECT_LT(reached(globe, absolute, true, true, false), 100u);
    EXPECT_LT(reached(globe, absolute, false, true, true), 100u);
    EXPECT_LT(reached(forShadows, inheriting, true, false, false), 100u);
    EXPECT_LT(reached(forShadows, absolute, true, false, true), 100u);
}

// Below the database's root the eye may change and the model-view matrix stay: from 500 km above the ground an eye sees
// 22 degrees far, an orthographic view from there half of the globe. A projection leaves even that matrix's place as it
// is. The tile, or the family that it is in, stays where it is, too: one that is missing would be a hole.
TEST(NestedCameras, BetweenADatabaseAndItsTilesDoNotSeeWithTheDatabasesEye) {
    const CullView view = MeshGlobe::fromAbove();
    constexpr double kHalf = 7e6;
    const osg::Matrixd orthographic = osg::Matrixd::ortho(-kHalf, kHalf, -kHalf, kHalf, -1e5, 2e7);
    const auto makeCamera = [&](bool isAbsolute) -> osg::ref_ptr<osg::Group> {
        const osg::ref_ptr<Camera> camera = new Camera;
        camera->setReferenceFrame(isAbsolute ? Transform::ABSOLUTE_RF : Transform::RELATIVE_RF);
        camera->setRenderOrder(Camera::NESTED_RENDER);
        camera->setComputeNearFarMode(CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setViewMatrix(isAbsolute ? view.modelView : osg::Matrixd());
        camera->setProjectionMatrix(isAbsolute ? orthographic : orthographic * osg::Matrixd::inverse(view.projection));
        return camera;
    };
    const osg::ref_ptr<osg::Projection> projection = new osg::Projection(orthographic);
    projection->setCullingActive(false);
    for (const auto& between : {makeCamera(true), makeCamera(false), osg::ref_ptr<osg::Group>(projection)}) {
        for (const bool isFamily : {false, true}) {
            MeshGlobe globe;
            // 45 degrees and more from the eye
            const osg::ref_ptr<osg::PagedLOD> tile = globe.tiles[21];
            const osg::ref_ptr<osg::Group> family = new osg::Group;
            globe.root->replaceChild(tile, family);
            family->addChild(tile);
            installBins(*globe.root);
            EXPECT_FALSE(globe.draws(*tile, view));
            between->addChild(isFamily ? family->asNode() : tile->asNode());
            globe.root->addChild(between);
            EXPECT_TRUE(globe.draws(*tile, view)) << between->className() << isFamily;
            between->removeChildren(0, 1);
        }
    }
}

// As osgUtil::SceneView culls it: once for each eye, each with a visitor and matrices of its own.
TEST(Stereo, EachEyeKeepsWhatItSees) {
    CameraGlobe globe(horizonOptions());
    const osg::ref_ptr<osg::DisplaySettings> settings = new osg::DisplaySettings;
    settings->setStereo(true);
    const osg::ref_ptr<osgUtil::SceneView> view = new osgUtil::SceneView;
    view->setDefaults();
    view->setDisplaySettings(settings);
    view->setViewport(0, 0, 640, 480);
    view->setSceneData(&globe.root());
    view->setComputeNearFarMode(CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    // a planet on the table, on a screen at 0.5 m
    view->setFusionDistance(osgUtil::SceneView::USE_FUSION_DISTANCE_VALUE, 2e6f * settings->getScreenDistance());
    view->setFrameStamp(new osg::FrameStamp);
    Random random(110);
    LookTotals totals;
    for (int i = 0; i < 6; ++i) {
        view->setViewMatrix(randomViewMatrix(random, 2e5));
        view->setProjectionMatrix(osg::Matrixd::perspective(random.uniform(20, 60), 1.3, 1.0, 1e8));
        view->cull();
        const std::vector<Look> looks = globe.takeLooks();
        ASSERT_EQ(looks.size(), 2u);
        EXPECT_NE(looks[0].modelView, looks[1].modelView);
        for (const Look& look : looks)
            EXPECT_TRUE(totals.add(globe, look, NearPlane::AtMinusOne, kOccluderDepth).empty()) << i;
    }
    EXPECT_LT(totals.reached, totals.tiles / 2);
}

TEST(CameraSettings, ACameraWithoutCullingReachesEverythingAndTheOthersDoNot) {
    // Without frustum culling the frustum says nothing of what is drawn, and so the eye does not either: no horizon.
    CameraGlobe globe(horizonOptions());
    const CullView view = CullView::lookAt({kEarthRadius + 1e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 20.0);
    const osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->setCullingActive(false);
    const auto add = [&](const char* name) {
        const osg::ref_ptr<Camera> camera =
            makeCamera(name, globe, Transform::ABSOLUTE_RF, Camera::PRE_RENDER, view.modelView, view.projection);
        scene->addChild(camera);
        return camera;
    };
    add("inherits");
    add("none")->setCullingMode(CullSettings::NO_CULLING);
    add("small features")->setCullingMode(CullSettings::SMALL_FEATURE_CULLING);
    const osg::ref_ptr<Camera> masked = add("set, but inherits");
    masked->setCullingMode(CullSettings::NO_CULLING);
    masked->setInheritanceMask(CullSettings::ALL_VARIABLES);
    add("inherits again");
    std::map<std::string, std::size_t> reached;
    for (const Look& look : looksAt(*scene, view, globe)) reached[look.camera] = look.reached.size();
    EXPECT_EQ(reached["none"], 128u);
    EXPECT_EQ(reached["small features"], 128u);
    EXPECT_LT(reached["inherits"], 20u);
    EXPECT_EQ(reached["set, but inherits"], reached["inherits"]);
    EXPECT_EQ(reached["inherits again"], reached["inherits"]);
    // and the other way round
    CullView open = view;
    open.cullingMode = CullSettings::NO_CULLING;
    scene->getChild(1)->asCamera()->setCullingMode(CullSettings::VIEW_FRUSTUM_SIDES_CULLING);
    for (const Look& look : looksAt(*scene, open, globe)) reached[look.camera] = look.reached.size();
    EXPECT_EQ(reached["inherits"], 128u);
    EXPECT_LT(reached["none"], 20u);
}

// As by osgShadow::ViewDependentShadowMap: the camera's projection stays as it is.
TEST(CameraSettings, WherePlanesAreComputedForShadowsAloneTheNearPlaneMayCutTheGlobeOpen) {
    CameraGlobe globe(horizonOptions());
    CullView view = fromAfar();
    view.camera = new Camera;
    view.camera->setComputeNearFarMode(CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    view.computeNearFar = CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES;
    for (const double near : {1.0, 2.8e7}) {
        view.projection = osg::Matrixd::perspective(40.0, 1.0, near, 1e8);
        EXPECT_EQ(looksAt(globe.root(), view, globe).at(0).reached.size() < 128u, near == 1.0);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
