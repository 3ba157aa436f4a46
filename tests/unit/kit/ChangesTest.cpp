// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The table "What the kit notices" of the guide, line by line. Oracle: a tile on the other side of the globe is drawn
// where something in front is not known to hide it, and only there. And content that comes below a tile after the bin
// of that tile was fitted: it stood below another tile, or it was read before bins were installed or by the
// application. Oracle: what is seen is drawn, in the frame in which it comes.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

// Masks, callbacks, states and levels: tests/scenes.
TEST(Changes, OfReferenceFramesCountInTheSameFrame) {
    InstalledGlobe globe;
    EXPECT_FALSE(globe.drawsAntipode());
    auto& transform = dynamic_cast<osg::MatrixTransform&>(*globe.tiles[19]->getChild(0));
    transform.setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    EXPECT_TRUE(globe.drawsAntipode());
    transform.setReferenceFrame(osg::Transform::RELATIVE_RF);
    EXPECT_FALSE(globe.drawsAntipode());
}

// A triangle in the middle becomes a point.
TEST(Changes, OfTrianglesCountAlsoWhereNewOnesTakeThePlaceOfOldOnesInMemory) {
    InstalledGlobe globe;
    osg::Geometry& geometry = geometryOf(*globe.tiles[19]);
    const auto& old = dynamic_cast<osg::DrawElementsUInt&>(*geometry.getPrimitiveSet(0));
    std::vector<GLuint> indices(old.begin(), old.end());
    GLuint* const middle = &indices[indices.size() / 6 * 3];
    middle[1] = middle[2] = middle[0];
    EXPECT_FALSE(globe.drawsAntipode());
    geometry.removePrimitiveSet(0);
    geometry.addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES, indices.begin(), indices.end()));
    EXPECT_TRUE(globe.drawsAntipode());
}

TEST(Changes, OfVerticesWithoutAWordCountWhenBinsAreInstalledAgain) {
    FiledGlobe globe;
    (void)globe.root->getBound();
    auto& vertices = verticesOf(*globe.group);
    const auto highest = [&globe] { return installedOn(*globe.tile)->getBin().bin().altitude().upper; };
    vertices[40] += osg::Vec3(ecefDeg(20, 20, 1.0) / ecefDeg(20, 20, 1.0).length() * 12000.0);
    (void)globe.root->getBound();
    update(*globe.root);
    EXPECT_LT(highest(), 12000.0);
    installBins(*globe.root);
    EXPECT_GE(highest(), 12000.0);
}

TEST(Changes, OfRadiiCountWhenBinsAreInstalledAgain) {
    InstalledGlobe globe;
    const auto radius = [&globe] { return installedOn(*globe.tiles[19])->ellipsoid().equatorialRadius(); };
    globe.root->setEllipsoidModel(new osg::EllipsoidModel(6378000.0, osg::WGS_84_RADIUS_POLAR));
    EXPECT_EQ(radius(), osg::WGS_84_RADIUS_EQUATOR);
    installBins(*globe.root);
    EXPECT_EQ(radius(), 6378000.0);
}

// Below two tiles there is a level with a leaf in it, which is shown from wherever the eye is.
struct Neighbours : MeshGlobe {
    explicit Neighbours(bool isInstalled = true) {
        for (const auto& tile : {tiles[19], tiles[20]}) setFinerWithin(*tile, 1e9f);
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
        return makeGroup({makeMeshTile(extentsDeg(0, 45, west, west + width), 0.0)});
    }

    osg::ref_ptr<osg::Group> here, there;
};

TEST(Newcomers, AreModelsAndTilesThatStoodBelowAnother) {
    Neighbours globe(false);
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    const osg::ref_ptr<osg::Node> models = makeGroup({makeTower(place)}), leaf = globe.there->getChild(0);
    globe.there->addChild(models);
    globe.install();
    for (const auto& [content, view] : {std::pair(leaf, downTo(22.5, 22.5)), std::pair(models, beside(place))}) {
        EXPECT_TRUE(globe.draws(*content, view));
        globe.there->removeChild(content);
        globe.here->addChild(content);
        globe.expectDrawn(*content, view);
    }
}

TEST(Newcomers, AreTilesThatTheApplicationAddsBelowAnother) {
    Neighbours globe;
    const osg::ref_ptr<osg::Group> added = Neighbours::levelOf(90.0);
    EXPECT_EQ(addTile(*globe.root, *added), 1u);
    globe.here->addChild(added);
    globe.expectDrawn(*added, downTo(22.5, 112.5));
}

// An application's own pager reads such levels, and so does OSG's where files were asked for before.
TEST(Newcomers, ThatWereReadWithoutBinsMayLeaveGaps) {
    MeshGlobe globe;
    setFinerWithin(*globe.tiles[19], 1e9f);
    installBins(*globe.root);
    update(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    const osg::ref_ptr<osg::Group> level = Neighbours::levelOf(-45.0, 10.0);
    putBelow(*globe.tiles[19], level);
    EXPECT_TRUE(globe.draws(*level, globe.fromAbove()));
    globe.expectAntipode(true);
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
    const osg::Light& light = *dynamic_cast<osg::LightSource&>(*file->asGroup()->getChild(1)).getLight();
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(globe.shines(light, downTo(20, 100.0))) << i;
        update(*globe.root);
    }
}

TEST(Newcomers, MayComeToTilesThatHaveLeftTheirDatabase) {
    FiledGlobe globe;
    globe.scene = makeGroup({globe.tile});
    globe.root->removeChild(globe.tile);
    const osg::Vec3d place = ecefDeg(20, 20, 30000.0);
    EXPECT_FALSE(globe.draws(*globe.tile, beside(place)));
    const osg::ref_ptr<osg::Node> tower = makeTower(place);
    globe.group->addChild(tower);
    globe.expectDrawn(*tower, beside(place));
}

TEST(Newcomers, ATileWithoutItsBinsMayHaveAHole) {
    InstalledGlobe globe;
    update(*globe.root);
    EXPECT_FALSE(globe.drawsAntipode());
    removeBins(*globe.tiles[19]);
    globe.tiles[19]->getChild(0)->asGroup()->removeChildren(0, 1);
    EXPECT_TRUE(globe.drawsAntipode());
}

}  // namespace
}  // namespace osgAnalyticBin::test
