// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The shadow maps of osgShadow: tiles outside of the picture, and beyond the viewer's horizon, still cast shadows into
// it. Oracles: the same scene without a horizon; samples of the tiles, projected by the picture's matrices.

#include "KitTest.h"

#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowedScene>
#include <osgShadow/ViewDependentShadowMap>

namespace osgAnalyticBin::test {
namespace {

// A sun, and a viewer above the ground near the line between day and night.
struct Evening {
    osg::Vec3d eye, toLight;
    CullView view;

    explicit Evening(Random& random) {
        const auto direction = [&] {
            const glm::dvec3 d = random.direction();
            return osg::Vec3d(d.x, d.y, d.z);
        };
        const osg::Vec3d up = direction();
        osg::Vec3d east = up ^ direction();
        east.normalize();
        const osg::Vec3d north = up ^ east;
        eye = up * (kEarthRadius + random.logUniform(1e4, 2e5));
        const double heading = random.uniform(0, 6.28);
        const osg::Vec3d ahead = east * std::cos(heading) + north * std::sin(heading);
        view = CullView::lookAt(eye, eye + ahead - up * random.uniform(0.1, 0.5), up, random.uniform(20, 50));
        // as shadow techniques want it: an end
        view.projection = osg::Matrixd::perspective(40.0, 1.0, 1e3, 1e6);
        toLight = east + up * random.uniform(0.02, 0.3);
        toLight.normalize();
    }
};

osg::ref_ptr<osgShadow::ShadowedScene> shadowedScene(CameraGlobe& globe, osgShadow::ShadowTechnique* technique,
                                                     const osg::Vec3d& toLight) {
    osg::ref_ptr<osgShadow::ShadowedScene> scene = new osgShadow::ShadowedScene(technique);
    osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
    source->getLight()->setPosition(osg::Vec4(osg::Vec3(toLight), 0.0f));
    scene->addChild(source);
    scene->addChild(&globe.root());
    scene->setCullingActive(false);
    // the tiles of a globe without geometry have no bounds of their own
    globe.root().setInitialBound(osg::BoundingSphere(osg::Vec3(), float(kEarthRadius) + 9000.0f));
    osgUtil::UpdateVisitor update;
    scene->accept(update);
    return scene;
}

// The picture's look, then those of the shadow cameras.
std::vector<Look> looksAt(osgShadow::ShadowedScene& scene, CullView view, CameraGlobe& globe) {
    view.camera = new osg::Camera;
    view.camera->setViewMatrix(view.modelView);
    view.camera->setProjectionMatrix(view.projection);
    view.camera->setComputeNearFarMode(view.computeNearFar);
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    cull(scene, view, *visitor);
    return globe.takeLooks();
}

// The technique may have near and far planes computed for its own use: the projection stays as it is.
TEST(ShadowPasses, ShowWhereTheNearPlaneCutsTheGlobeOpen) {
    CameraGlobe globe(horizonOptions());
    Random random(122);
    LookTotals totals;
    for (int i = 0; i < 8; ++i) {
        Evening evening(random);
        evening.view.projection = osg::Matrixd::perspective(40.0, 1.0, 1e6, 2e7);
        const osg::ref_ptr<osgShadow::ViewDependentShadowMap> technique = new osgShadow::ViewDependentShadowMap;
        const osg::ref_ptr<osgShadow::ShadowedScene> scene = shadowedScene(globe, technique.get(), evening.toLight);
        scene->getShadowSettings()->setComputeNearFarModeOverride(osg::CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES);
        const std::vector<Look> looks = looksAt(*scene, evening.view, globe);
        EXPECT_TRUE(totals.add(globe, looks.at(0), NearPlane::AtMinusOne).empty()) << i;
    }
    EXPECT_GT(totals.seen, 8u);
}

}  // namespace
}  // namespace osgAnalyticBin::test
