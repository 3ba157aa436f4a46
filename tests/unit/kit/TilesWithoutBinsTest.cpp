// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// A given horizon over a globe where some tiles have no bins.

#include "ApplicationGlobe.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>

#include <functional>

namespace osgAnalyticBin::test {
namespace {

// Tile 18 in place of tile 19 too: tiles that stand in several places of their globe have no bins.
osg::ref_ptr<osg::PagedLOD> instanceTile18(MeshGlobe& globe) {
    const osg::ref_ptr<osg::MatrixTransform> turned =
        new osg::MatrixTransform(osg::Matrixd::rotate(osg::DegreesToRadians(45.0), osg::Vec3d(0, 0, 1)));
    turned->addChild(globe.tiles[18]);
    globe.root->replaceChild(globe.tiles[19], turned);
    return globe.tiles[18];
}

TEST(TilesWithoutBins, LeaveADatabaseWithoutAHorizon) {
    const auto instance = [](MeshGlobe& globe) { instanceTile18(globe); };
    const auto move = [](MeshGlobe& globe) {
        const osg::ref_ptr<osg::MatrixTransform> moving = new osg::MatrixTransform;
        moving->setDataVariance(osg::Object::DYNAMIC);
        moving->addChild(globe.tiles[19]);
        globe.root->replaceChild(globe.tiles[19], moving);
    };
    for (const std::function<void(MeshGlobe&)>& change : {std::function<void(MeshGlobe&)>(instance), {move}}) {
        MeshGlobe globe;
        installBins(*globe.root, declaredHorizon());
        EXPECT_FALSE(globe.drawsAntipode());
        change(globe);
        installBins(*globe.root, declaredHorizon());
        EXPECT_TRUE(globe.drawsAntipode());
    }
}

TEST(TilesWithoutBins, AreNotWhatVehiclesAre) {
    MeshGlobe globe;
    const osg::ref_ptr<osg::MatrixTransform> moving = makeTower(ecefDeg(0.0, 90.0, 1000.0));
    moving->setDataVariance(osg::Object::DYNAMIC);
    globe.root->addChild(moving);
    installBins(*globe.root, declaredHorizon());
    EXPECT_FALSE(globe.drawsAntipode());
}

}  // namespace
}  // namespace osgAnalyticBin::test
