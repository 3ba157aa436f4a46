// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PagedScene.h"

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/PagedLOD>

namespace osgAnalyticBin::bench {
namespace {

constexpr double kFrame = 1.0 / 60.0;  // seconds

// A PagedLOD of radius 10 at the origin, whose page is due within 100, and never comes.
struct OnePage {
    OnePage() {
        lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
        lod->setRadius(10.0F);
        lod->addChild(new osg::Geode, 100.0F, 1e10F);
        lod->setFileName(1, "page.osgt");
        lod->setRange(1, 0.0F, 100.0F);
        root->addChild(lod);
        camera->setViewport(new osg::Viewport(0, 0, 100, 100));
        camera->setProjectionMatrixAsPerspective(60.0, 1.0, 1.0, 1e5);
        camera->addChild(root);
        scene.emplace(*root, *camera);
        scene->pause();
    }

    PagedScene::Frame frameFrom(double distance) {
        camera->setViewMatrixAsLookAt({0.0, 0.0, distance}, {}, {0.0, 1.0, 0.0});
        return scene->step(kFrame);
    }

    osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    std::optional<PagedScene> scene;
};

TEST(PagedScene, CountsRequestsThatWereGivenUpAndMadeAgain) {
    OnePage page;
    for (int frame = 0; frame < 3; ++frame) {
        const PagedScene::Frame near = page.frameFrom(50.0);
        EXPECT_EQ(near.wanted, 1U);
        EXPECT_EQ(near.askedAgain, 0U) << "asked for in each frame";
    }
    const PagedScene::Frame far = page.frameFrom(500.0);
    EXPECT_EQ(far.wanted, 0U);
    EXPECT_EQ(far.askedAgain, 0U);
    EXPECT_EQ(page.frameFrom(50.0).askedAgain, 1U);
    EXPECT_EQ(page.frameFrom(50.0).askedAgain, 0U);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
