// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Content that comes below a tile after the bin of that tile was fitted: it stood below another tile, or it was read
// before bins were installed or by the application. Oracle: what is seen is drawn, in the frame in which it comes.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

void refineEverywhere(osg::PagedLOD& tile) {
    tile.setRange(0, 1e9f, 1e10f);
    tile.setRange(1, 0.0f, 1e9f);
}

// Below two tiles there is a level with a leaf in it, which is shown from wherever the eye is.
struct Neighbours : MeshGlobe {
    explicit Neighbours(bool isInstalled = true) {
        for (const auto& tile : {tiles[19], tiles[20]}) refineEverywhere(*tile);
        here = levelOf(-45.0);
        there = levelOf(0.0);
        putBelow(*tiles[19], here);
        putBelow(*tiles[20], there);
        if (isInstalled) install();
    }
    void install() {
        installBins(*root);
        update(*root);
        (void)root->getBound();
        update(*root);
    }

    static osg::ref_ptr<osg::Group> levelOf(double west, double width = 45.0) {
        osg::ref_ptr<osg::Group> level = new osg::Group;
        level->addChild(makeMeshTile(extentsDeg(0, 45, west, west + width), 0.0));
        return level;
    }

    osg::ref_ptr<osg::Group> here, there;
};

void expectToBeDrawnFromNowOn(MeshGlobe& globe, osg::Node& content, const CullView& view) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(globe.draws(content, view)) << i;
        update(*globe.scene);
    }
}

TEST(Newcomers, AreModelsThatBelongToAnotherTileNow) {
    Neighbours globe(false);
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    const osg::ref_ptr<osg::Group> models = new osg::Group;
    models->addChild(makeTower(place));
    globe.there->addChild(models);
    globe.install();
    EXPECT_TRUE(globe.draws(*models, beside(place)));
    globe.there->removeChild(models);
    globe.here->addChild(models);
    expectToBeDrawnFromNowOn(globe, *models, beside(place));
}

TEST(Newcomers, AreTilesThatStoodBelowAnother) {
    Neighbours globe;
    const osg::ref_ptr<osg::Node> leaf = globe.there->getChild(0);
    EXPECT_TRUE(globe.draws(*leaf, downTo(22.5, 22.5)));
    globe.there->removeChild(leaf);
    globe.here->addChild(leaf);
    expectToBeDrawnFromNowOn(globe, *leaf, downTo(22.5, 22.5));
}

TEST(Newcomers, AreTilesThatTheApplicationAddsBelowAnother) {
    Neighbours globe;
    const osg::ref_ptr<osg::Group> added = Neighbours::levelOf(90.0);
    EXPECT_EQ(addTile(*globe.root, *added), 1u);
    globe.here->addChild(added);
    expectToBeDrawnFromNowOn(globe, *added, downTo(22.5, 112.5));
}

// An application's own pager reads such levels, and so does OSG's where files were asked for before.
TEST(Newcomers, ThatWereReadWithoutBinsMayLeaveGaps) {
    MeshGlobe globe;
    refineEverywhere(*globe.tiles[19]);
    installBins(*globe.root);
    update(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    const osg::ref_ptr<osg::Group> level = Neighbours::levelOf(-45.0, 10.0);
    putBelow(*globe.tiles[19], level);
    EXPECT_TRUE(globe.draws(*level, globe.fromAbove()));
    expectToBeDrawnFromNowOn(globe, *globe.tiles[15], MeshGlobe::fromAbove());
    installBins(*globe.root);
    EXPECT_TRUE(globe.drawsAntipode());
}

// The light source is in a file that is read before bins are installed again, and merged afterwards.
TEST(Newcomers, ThatAnEarlierInstallationHasReadMayNeverBeCulled) {
    FiledGlobe globe;
    pageOut(*globe.tile);
    const osg::ref_ptr<osg::Group> written = Neighbours::levelOf(0.0);
    written->addChild(new osg::LightSource);
    ASSERT_TRUE(osgDB::writeNodeFile(*written, globe.folder / "group.osgb"));
    const osg::ref_ptr<osg::Node> file = readBelow(*globe.tile);
    installBins(*globe.root);
    update(*globe.root);
    (void)file->getBound();
    putBelow(*globe.tile, file);
    const osg::StateAttribute* const light = dynamic_cast<osg::LightSource&>(*file->asGroup()->getChild(1)).getLight();
    for (int i = 0; i < 3; ++i) {
        (void)globe.draws(*globe.tile, downTo(20, 100.0));
        const auto& lights = globe.visitor->getRenderStage()->getPositionalStateContainer()->getAttrMatrixList();
        const auto isIt = [&](const auto& at) { return at.first == light; };
        EXPECT_TRUE(std::any_of(lights.begin(), lights.end(), isIt)) << i;
        update(*globe.root);
    }
}

TEST(Newcomers, MayComeToTilesThatHaveLeftTheirDatabase) {
    FiledGlobe globe;
    globe.scene = new osg::Group;
    globe.scene->addChild(globe.tile);
    globe.root->removeChild(globe.tile);
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    EXPECT_FALSE(globe.draws(*globe.tile, beside(place)));
    const osg::ref_ptr<osg::Node> tower = makeTower(place);
    globe.group->addChild(tower);
    expectToBeDrawnFromNowOn(globe, *tower, beside(place));
}

TEST(Newcomers, ATileWithoutItsBinsMayHaveAHole) {
    MeshGlobe globe;
    installBins(*globe.root);
    update(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    removeBins(*globe.tiles[19]);
    globe.tiles[19]->getChild(0)->asGroup()->removeChildren(0, 1);
    EXPECT_TRUE(globe.drawsAntipode());
}

}  // namespace
}  // namespace osgAnalyticBin::test
