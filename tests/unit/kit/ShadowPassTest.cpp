// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The shadow techniques of osgShadow: tiles outside of the picture, and beyond the viewer's horizon, still cast shadows
// into it. Oracle: samples of the tiles, followed along the light until they are in the picture's frustum, or projected
// by the matrices of the shadow camera.

#include "CameraGlobe.h"

#include <gtest/gtest.h>
#include <osg/LightSource>
#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/ShadowMap>
#include <osgShadow/ShadowSettings>
#include <osgShadow/ShadowedScene>
#include <osgShadow/ViewDependentShadowMap>
#include <osgUtil/UpdateVisitor>

#include <algorithm>
#include <cmath>
#include <support/Random.h>

namespace osgAnalyticBin {
namespace {

using test::CameraGlobe;
using test::CullView;
using test::kEarthRadius;
using test::Look;
using test::LookTotals;

// A sun, and a viewer above the ground near the line between day and night.
struct Evening {
    osg::Vec3d eye, toLight;
    CullView view;

    explicit Evening(test::Random& random) {
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
    test::cull(scene, view, *visitor);
    return globe.takeLooks();
}

// Whether the light that passes a point enters the frustum behind it.
bool castsIntoThePicture(const osg::Vec3d& point, const osg::Vec3d& toLight, const osg::Matrixd& toClip) {
    // the frustum, less a little, between parallel planes for each axis of clip space: a linear program in one unknown
    double from = 0.0;
    double to = 1e8;
    const osg::Vec4d start = osg::Vec4d(point, 1.0) * toClip;
    const osg::Vec4d step = osg::Vec4d(-toLight, 0.0) * toClip;
    for (unsigned int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            const double a = 0.999 * start.w() + sign * start[axis];
            const double b = 0.999 * step.w() + sign * step[axis];
            if (b > 0.0) from = std::max(from, -a / b);
            if (b < 0.0) to = std::min(to, -a / b);
            if (b == 0.0 && a < 0.0) return false;
        }
    }
    return from < to;
}

std::set<std::size_t> casters(const CameraGlobe& globe, const Look& picture, const osg::Vec3d& toLight) {
    std::set<std::size_t> tiles;
    const osg::Matrixd toClip = picture.modelView * picture.projection;
    for (std::size_t i = 0; i < globe.size(); ++i) {
        const auto& points = globe.samplesOf(i);
        if (std::any_of(points.begin(), points.end(),
                        [&](const osg::Vec3d& point) { return castsIntoThePicture(point, toLight, toClip); })) {
            tiles.insert(i);
        }
    }
    return tiles;
}

std::vector<AnalyticBin> shadowTiles() {
    std::vector<AnalyticBin> tiles;
    for (const AnalyticBin& tile : test::startTiles()) {
        for (const core::GeodeticBin& quarter : tile.bin().quarters()) tiles.emplace_back(quarter);
    }
    return tiles;
}

TEST(ShadowPasses, EveryCasterOfAViewDependentShadowMapIsDrawn) {
    for (const unsigned int maps : {1u, 2u}) {
        CameraGlobe globe(test::horizonOptions(), shadowTiles());
        test::Random random(120);
        std::size_t outside = 0, drawn = 0, passes = 0;
        for (int i = 0; i < 16; ++i) {
            const Evening evening(random);
            const osg::ref_ptr<osgShadow::ViewDependentShadowMap> technique = new osgShadow::ViewDependentShadowMap;
            const osg::ref_ptr<osgShadow::ShadowedScene> scene = shadowedScene(globe, technique.get(), evening.toLight);
            scene->getShadowSettings()->setNumShadowMapsPerLight(maps);
            scene->getShadowSettings()->setComputeNearFarModeOverride(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
            const std::vector<Look> looks = looksAt(*scene, evening.view, globe);
            ASSERT_EQ(looks.size(), 1u + maps);
            std::set<std::size_t> inShadowMaps = looks[1].reached;
            for (const Look& look : looks) {
                if (&look != &looks[0]) inShadowMaps.insert(look.reached.begin(), look.reached.end());
            }
            for (const std::size_t tile : casters(globe, looks[0], evening.toLight)) {
                EXPECT_TRUE(inShadowMaps.count(tile)) << "view " << i << ", tile " << tile;
                if (!looks[0].reached.count(tile)) ++outside;
            }
            drawn += inShadowMaps.size();
            ++passes;
        }
        EXPECT_GT(outside, 8u);                       // casters that the picture itself has not
        EXPECT_LT(drawn, passes * globe.size() / 4);  // and not the whole globe
    }
}

// The technique may have near and far planes computed for its own use: the projection stays as it is.
TEST(ShadowPasses, ShowWhereTheNearPlaneCutsTheGlobeOpen) {
    CameraGlobe globe(test::horizonOptions());
    test::Random random(122);
    LookTotals totals;
    for (int i = 0; i < 8; ++i) {
        Evening evening(random);
        evening.view.projection = osg::Matrixd::perspective(40.0, 1.0, 1e6, 2e7);
        const osg::ref_ptr<osgShadow::ViewDependentShadowMap> technique = new osgShadow::ViewDependentShadowMap;
        const osg::ref_ptr<osgShadow::ShadowedScene> scene = shadowedScene(globe, technique.get(), evening.toLight);
        scene->getShadowSettings()->setComputeNearFarModeOverride(osg::CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES);
        const std::vector<Look> looks = looksAt(*scene, evening.view, globe);
        EXPECT_TRUE(totals.add(globe, looks.at(0), test::NearPlane::AtMinusOne).empty()) << i;
    }
    EXPECT_GT(totals.seen, 8u);
}

}  // namespace
}  // namespace osgAnalyticBin
