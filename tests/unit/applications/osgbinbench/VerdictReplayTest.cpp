// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Verdicts of a view, repeated without tests, below nodes that choose their children and for drawables that are culled
// by themselves; no window is needed. The program's own run is in ProgramTest.cpp.

#include "Failure.h"
#include "VerdictReplay.h"

#include <gtest/gtest.h>
#include <osg/Geode>
#include <osg/LOD>
#include <osg/Shape>
#include <osg/ShapeDrawable>

namespace osgAnalyticBin::bench {
namespace {

osg::ref_ptr<osg::Drawable> ballAt(double y) {
    return new osg::ShapeDrawable(new osg::Sphere(osg::Vec3d(0.0, y, 0.0), 1.0F));
}

TEST(VerdictReplay, DrawsWhatWasDrawnWhereverTheCameraLooks) {
    const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    for (const double y : {0.0, 50.0}) {
        lod->addChild(ballAt(y), 0.0F, 1e10F);
        geode->addDrawable(ballAt(y));
    }
    for (osg::Node* scene : {static_cast<osg::Node*>(lod), static_cast<osg::Node*>(geode)}) {
        const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
        camera->setViewport(new osg::Viewport(0, 0, 320, 240));
        camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setViewMatrixAsLookAt(osg::Vec3d(100, 0, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1));
        camera->addChild(scene);
        const osg::ref_ptr<osg::FrameStamp> frameStamp = new osg::FrameStamp;
        const auto seenAt = [&](double fovDeg) {
            camera->setProjectionMatrixAsPerspective(fovDeg, 4.0 / 3.0, 1.0, 1e9);
            return flight::TileCensus::take(*camera, *frameStamp);
        };
        const flight::Census wide = seenAt(120.0), narrow = seenAt(5.0);
        ASSERT_EQ(narrow.drawables, 1U);
        EXPECT_THROW(requireSameTiles(wide, narrow, "pose"), support::Failure);
        replayVerdicts(*camera, *frameStamp);
        EXPECT_NO_THROW(requireSameTiles(seenAt(120.0), narrow, "pose"));
        EXPECT_EQ(seenAt(120.0).nodes, 2U) << "the root and one drawable";
    }
}

}  // namespace
}  // namespace osgAnalyticBin::bench
