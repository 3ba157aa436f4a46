// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A camera that is culled by another view than its own. Oracle: a cull traversal of that other view.

#include "ViewerScene.h"

#include <osgAnalyticBin/Declarations.h>

#include <gtest/gtest.h>

namespace osgAnalyticBin {
namespace {

using test::ViewerScene;
using Drawn = std::map<const osg::Drawable*, osg::Matrixd>;

std::set<const osg::Drawable*> drawables(const Drawn& drawn) {
    std::set<const osg::Drawable*> set;
    for (const auto& [drawable, matrix] : drawn) set.insert(drawable);
    return set;
}

// Metres by which matrices place points within 10 000 km of their origins differently, about.
double difference(const osg::Matrixd& a, const osg::Matrixd& b) {
    double largest = 0.0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j) largest = std::max(largest, std::abs(a(i, j) - b(i, j)) * (i < 3 ? 1e7 : 1.0));
    return largest;
}

constexpr double kMillimetre = 1e-3;

class FrozenCamera : public ::testing::Test {
protected:
    void SetUp() override {
        _scene.lookFrom(20.0, 30.0, 2000e3, 70.0, 50.0);
        _seen = _scene.cull();
        CameraCulling::of(_scene.camera()).freeze(CameraCulling::cullingView(_scene.camera()));
        _scene.lookFrom(10.0, -60.0, 9e6, 20.0, 50.0);
    }

    ViewerScene _scene;
    Drawn _seen;
};

TEST_F(FrozenCamera, DrawsPreciselyWhatItSawWhereTheFlyingViewSeesIt) {
    const Drawn drawn = _scene.cull();
    ASSERT_GT(_seen.size(), 1u);
    EXPECT_EQ(drawables(drawn), drawables(_seen));
    CameraCulling::of(_scene.camera()).thaw();
    const Drawn own = _scene.cull();
    EXPECT_NE(drawables(own), drawables(_seen));
    std::size_t shared = 0;
    for (const auto& [drawable, matrix] : drawn) {
        if (!own.count(drawable)) continue;
        ++shared;
        EXPECT_LT(difference(matrix, own.at(drawable)), kMillimetre);
    }
    EXPECT_GT(shared, 0u);
}

TEST_F(FrozenCamera, AtItsOwnPlaceDrawsAsBefore) {
    _scene.lookFrom(20.0, 30.0, 2000e3, 70.0, 50.0);
    const double nearBefore = (CameraCulling::of(_scene.camera()).thaw(), (void)_scene.cull(), _scene.nearPlane);
    CameraCulling::of(_scene.camera()).freeze(CameraCulling::cullingView(_scene.camera()));
    const Drawn drawn = _scene.cull();
    EXPECT_EQ(drawables(drawn), drawables(_seen));
    for (const auto& [drawable, matrix] : drawn) EXPECT_LT(difference(matrix, _seen.at(drawable)), kMillimetre);
    EXPECT_NEAR(_scene.nearPlane, nearBefore, 1.0);
}

TEST_F(FrozenCamera, ComputesNearAndFarForTheFlyingView) {
    (void)_scene.cull();
    // 9000 km above the ground, the globe behind
    EXPECT_GT(_scene.nearPlane, 5e6);
    EXPECT_LT(_scene.farPlane, 2.5e7);
    EXPECT_LT(_scene.nearPlane, _scene.farPlane);
}

// A camera is culled by its own view as without the callback, also where near and far planes are computed.
TEST(CameraCulling, IsDeclaredWhileTheCameraIsCulledByItsOwnView) {
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera, other = new osg::Camera;
    CameraCulling& culling = CameraCulling::of(*camera);
    EXPECT_TRUE(traversesAlways(culling));
    culling.freeze(CameraCulling::cullingView(*other));
    EXPECT_FALSE(traversesAlways(culling));
    culling.thaw();
    EXPECT_TRUE(traversesAlways(culling));
}

}  // namespace
}  // namespace osgAnalyticBin
