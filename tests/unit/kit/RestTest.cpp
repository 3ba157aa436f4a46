// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Where bins gain nothing, the database is left to OSG.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// For its visits OSG traverses what is kept: nothing is drawn directly.
class DerivedVisitor : public osgUtil::CullVisitor {};

CullOptions withoutHorizon() {
    CullOptions options;
    options.horizonUse = HorizonUse::Off;
    return options;
}

struct RestingGlobe : MeshGlobe {
    explicit RestingGlobe(const CullOptions& options, osgUtil::CullVisitor* by = new DerivedVisitor) {
        visitor = by;
        install(options);
    }
    void install(const CullOptions& options) {
        installBins(*root, options);
        update(*root);
    }
    // Whether bins are tested in one of so many views.
    bool testsBins(const CullView& view, unsigned int views) {
        unsigned int tested = 0;
        for (unsigned int i = 0; i < views; ++i) {
            last = cull(*scene, view, *visitor, ++frame);
            tested += BinStatistics::of(*visitor).getCounts().tested;
        }
        return tested > 0;
    }
    // After many views.
    bool rests(const CullView& view) {
        (void)testsBins(view, 100);
        // some views in a row, of which one may look whether bins gain something
        return !testsBins(view, 8) || !testsBins(view, 8);
    }
    CullResult last;
};

// Of the whole globe, both sides: spheres and bins are in view.
CullView ofAllTiles() {
    return CullView::lookAt(osg::Vec3d(1e8, 0, 0), osg::Vec3d(), osg::Vec3d(0, 0, 1), 20.0);
}

TEST(Rest, BinsThatGainNothingAreNotTested) {
    RestingGlobe globe(withoutHorizon());
    EXPECT_TRUE(globe.testsBins(ofAllTiles(), 1));
    EXPECT_TRUE(globe.rests(ofAllTiles()));
    EXPECT_EQ(globe.last.drawn.size(), globe.tiles.size());
}

TEST(Rest, EndsWithinAFewDozenViewsWhereBinsGain) {
    RestingGlobe globe(withoutHorizon());
    ASSERT_TRUE(globe.rests(ofAllTiles()));
    // in a corner of a tile, which the spheres of three others reach
    EXPECT_TRUE(globe.testsBins(downTo(4, -4), 33));
    EXPECT_FALSE(globe.rests(downTo(4, -4)));
}

TEST(Rest, EndsWhenTilesCome) {
    RestingGlobe globe(withoutHorizon());
    ASSERT_TRUE(globe.rests(ofAllTiles()));
    const osg::ref_ptr<osg::Node> tile = makeMeshTile(extentsDeg(10, 11, -20, -19), 100.0);
    ASSERT_TRUE(osgAnalyticBin::addTile(*globe.root, *tile));
    EXPECT_TRUE(globe.testsBins(ofAllTiles(), 1));
}

TEST(Rest, IsForEachOfManyDatabases) {
    RestingGlobe globe(withoutHorizon());
    const osg::ref_ptr<osg::Group> all = new osg::Group;
    all->addChild(globe.root);
    for (int i = 0; i < 99; ++i) {
        const MeshGlobe other;
        installBins(*other.root, withoutHorizon());
        all->addChild(other.root);
    }
    globe.scene = all;
    update(*all);
    EXPECT_TRUE(globe.rests(ofAllTiles()));
}

TEST(Rest, IsNotForTilesThatTheHorizonHides) {
    EXPECT_FALSE(RestingGlobe(declaredHorizon()).rests(ofAllTiles()));
}

TEST(Rest, IsNotForMeshesThatAreDrawnDirectly) {
    EXPECT_FALSE(RestingGlobe(withoutHorizon(), new osgUtil::CullVisitor).rests(ofAllTiles()));
}

// OSG's spheres are those of the terrain without it.
TEST(Rest, IsNotForTerrainWithAVerticalScale) {
    RestingGlobe globe(withoutHorizon());
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    for (const auto& tile : globe.tiles) terrain->addChild(tile);
    globe.root->removeChildren(0, globe.root->getNumChildren());
    globe.root->addChild(terrain);
    globe.install(withoutHorizon());
    EXPECT_TRUE(globe.rests(ofAllTiles()));
    terrain->setVerticalScale(2.0f);
    update(*globe.root);
    EXPECT_FALSE(globe.rests(ofAllTiles()));
}

TEST(Rest, IsNotForVisitorsThatWatchTiles) {
    RestingGlobe globe(withoutHorizon());
    BinStatistics::of(*globe.visitor).setTileByTile(true);
    EXPECT_FALSE(globe.rests(ofAllTiles()));
}

// The application's sphere lies: OSG would leave the tile out.
TEST(Rest, IsNotForTilesThatOsgWouldLeaveOut) {
    RestingGlobe globe(withoutHorizon());
    osg::PagedLOD& tile = *globe.tiles[19];
    tile.setCenterMode(osg::LOD::USER_DEFINED_CENTER);
    tile.setCenter(osg::Vec3d(0, 0, 3e8));
    tile.setRadius(1.0);
    EXPECT_FALSE(globe.rests(ofAllTiles()));
    EXPECT_EQ(globe.last.drawn.size(), globe.tiles.size());
}

}  // namespace
}  // namespace osgAnalyticBin::test
