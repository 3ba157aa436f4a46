// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The horizon of databases that cover a part of the globe, and when those of other builders, which declare none, have
// one. More regions: tests/scenes. What the core proves: CoveredRegionTest.cpp.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// 40 x 40 degrees of tiles, without any other terrain. From a place the horizon is some 5.6 degrees away at an altitude
// of 30 km.
struct WideRegion : MeshGlobe {
    WideRegion() {
        root->removeChildren(0, root->getNumChildren());
        tiles.clear();
        for (int column = 0; column < 8; ++column) addColumn(column);
    }

    void addColumn(int column) {
        const double west = 5.0 * column;
        for (double south = 10.0; south < 50.0; south += 5.0) {
            tiles.push_back(makePaged(makeMeshTile(extentsDeg(south, south + 5.0, west, west + 5.0), 0.0), "no.osgb"));
            root->addChild(tiles.back());
        }
    }

    // Whether the tile in the north-east is drawn in a view that it is in.
    [[nodiscard]] bool drawsFarTile(double latitude, double longitude) {
        return draws(*tiles[63], CullView::lookAt(ecefDeg(latitude, longitude, 30000.0), ecefDeg(47.5, 37.5, 0.0),
                                                  ecefDeg(latitude, longitude, 0.0), 60.0));
    }
};

TEST(RegionalHorizon, IsNotUsedByAnEyeBesideTheRegion) {
    WideRegion region;
    installBins(*region.root);
    const CapturedNotes notes(osg::NOTICE);
    for (const auto& [latitude, longitude] : {std::pair(30.0, -3.0), {5.0, 20.0}, {51.0, 20.0}, {30.0, 41.0}})
        EXPECT_TRUE(region.drawsFarTile(latitude, longitude)) << latitude << ' ' << longitude;
    EXPECT_EQ(notes.count("not over the regional database"), 1u);
}

TEST(RegionalHorizon, FollowsTheTilesWhenBinsAreInstalledAnew) {
    WideRegion region;
    installBins(*region.root);
    EXPECT_TRUE(region.drawsFarTile(30.0, 41.0));
    for (const int column : {8, 9}) region.addColumn(column);
    installBins(*region.root);
    EXPECT_FALSE(region.drawsFarTile(30.0, 41.0));
}

// What a set draws stands before the terrain, if anything.
TEST(ForeignHorizon, IsUsedBesideAPhotogrammetrySet) {
    for (const bool isMoved : {false, true}) {
        const osg::ref_ptr<osg::Group> set = isMoved ? new osg::MatrixTransform : new osg::Group;
        const osg::ref_ptr<osg::LOD> tile = new osg::LOD;
        tile->addChild(makeFlatTile(extentsDeg(20, 21, -21, -20), 100.0f), 0.0f, 1e9f);
        set->addChild(tile);
        markPhotogrammetrySet(*set);
        MeshGlobe globe;
        globe.root->addChild(set);
        installBins(*globe.root);
        EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
        EXPECT_FALSE(globe.drawsAntipode());
    }
}

TEST(ForeignHorizon, AnotherGlobeInsideDoesNotHideThatTilesLeaveAGap) {
    for (const bool hasGap : {false, true}) {
        MeshGlobe globe;
        if (hasGap) globe.root->removeChild(globe.tiles[31]);
        const osg::ref_ptr<osg::CoordinateSystemNode> inside = new osg::CoordinateSystemNode;
        inside->setEllipsoidModel(new osg::EllipsoidModel);
        globe.root->addChild(inside);
        installBins(*globe.root);
        EXPECT_EQ(globe.drawsAntipode(), hasGap);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
