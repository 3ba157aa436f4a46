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

TEST(TilesWithoutBins, AreSeenThroughAsOthersAreWhereTheHorizonIsGiven) {
    const auto blend = [](osg::Node& tile) { tile.getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON); };
    const auto blendMesh = [&](osg::Node& tile) { blend(*drawableOf(tile)); };
    const auto mask = [](osg::Node& tile) { tile.setNodeMask(0); };
    const std::vector<std::function<void(osg::Node&)>> ways{blend, blendMesh, mask};
    for (const auto& way : ways) {
        MeshGlobe globe;
        const auto tile = instanceTile18(globe);
        installBins(*globe.root, declaredHorizon());
        EXPECT_EQ(installedOn(*tile), nullptr);
        // from well above the sphere of tile 19
        EXPECT_FALSE(globe.drawsAntipode(5e6));
        way(*tile);
        EXPECT_TRUE(globe.drawsAntipode(5e6)) << (&way - ways.data());
    }
}

TEST(TilesWithoutBins, HideNothingFromEyesThatMayBeBelowThem) {
    MeshGlobe globe(40000.0);
    instanceTile18(globe);
    installBins(*globe.root, declaredHorizon());
    const auto drawsAntipode = [&](double longitude, double altitude) {
        const osg::Vec3d eye = ecefDeg(21.3, longitude, altitude);
        return globe.draws(*globe.tiles[15], CullView::lookAt(eye, {0, 0, 0}, {0, 0, 1}, 100.0));
    };
    EXPECT_TRUE(drawsAntipode(-21.7, 20000.0));
    EXPECT_TRUE(drawsAntipode(-44.9, 1000.0));
    EXPECT_FALSE(drawsAntipode(-21.7, 5e6));
    EXPECT_FALSE(drawsAntipode(-110.0, 41000.0));
}

}  // namespace
}  // namespace osgAnalyticBin::test
