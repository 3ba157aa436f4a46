// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Verdicts of a view, repeated without tests; no window is needed. The program's own run is in ProgramTest.cpp.

#include "Failure.h"
#include "VerdictReplay.h"

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/LOD>
#include <osg/Shape>
#include <osg/ShapeDrawable>

namespace osgAnalyticBin::bench {
namespace {

struct View {
    explicit View(osg::Node& scene) {
        camera->setViewport(new osg::Viewport(0, 0, 320, 240));
        camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera->addChild(&scene);
    }

    void look(const osg::Vec3d& eye, double fovDeg) const {
        camera->setViewMatrixAsLookAt(eye, {}, osg::Vec3d(0, 0, 1));
        camera->setProjectionMatrixAsPerspective(fovDeg, 4.0 / 3.0, 1.0, 1e9);
    }

    [[nodiscard]] flight::Census census() const { return flight::TileCensus::take(*camera, *frameStamp); }

    osg::ref_ptr<osg::Camera> camera{new osg::Camera};
    osg::ref_ptr<osg::FrameStamp> frameStamp{new osg::FrameStamp};
};

osg::ref_ptr<osg::Geode> ballAt(const osg::Vec3& middle) {
    osg::ref_ptr<osg::Geode> ball = new osg::Geode;
    ball->addDrawable(new osg::ShapeDrawable(new osg::Sphere(middle, 1.0F)));
    return ball;
}

TEST(VerdictReplay, RejectsBelowNodesThatChooseTheirChildren) {
    const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(ballAt({}), 0.0F, 1e10F);
    lod->addChild(ballAt({0, 50, 0}), 0.0F, 1e10F);
    const View view(*lod);
    view.look({100, 0, 0}, 5.0);
    ASSERT_EQ(view.census().drawables, 1U);
    replayVerdicts(*view.camera, *view.frameStamp);
    view.look({100, 0, 0}, 120.0);
    EXPECT_EQ(view.census().drawables, 1U);
}

TEST(VerdictReplay, RejectsDrawablesThatAreCulledByThemselves) {
    const osg::ref_ptr<osg::Geode> balls = ballAt({});
    balls->addDrawable(new osg::ShapeDrawable(new osg::Sphere({0, 50, 0}, 1.0F)));
    const View view(*balls);
    view.look({100, 0, 0}, 5.0);
    ASSERT_EQ(view.census().drawables, 1U);
    replayVerdicts(*view.camera, *view.frameStamp);
    view.look({100, 0, 0}, 120.0);
    const flight::Census replay = view.census();
    EXPECT_EQ(replay.drawables, 1U);
    EXPECT_EQ(replay.nodes, 2U) << "the geode and one drawable";
}

TEST(VerdictReplay, IsComparedWithWhatItRepeats) {
    flight::Census original;
    original.drawables = 2;
    original.tiles.resize(1);
    original.tiles[0].key = "0/1";
    EXPECT_NO_THROW(requireSameTiles(original, original, "pose"));
    flight::Census replay = original;
    replay.tiles[0].key = "0/2";
    EXPECT_THROW(requireSameTiles(replay, original, "pose"), support::Failure);
    replay = original;
    replay.drawables = 1;
    EXPECT_THROW(requireSameTiles(replay, original, "pose"), support::Failure);
}

}  // namespace
}  // namespace osgAnalyticBin::bench
