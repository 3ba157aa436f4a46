// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases that cover a part of the globe: their horizon, and when those of other builders, which declare none, have
// one; and skirts at their border, where no neighbour stands before them. Oracle of these: the triangles that
// osgTerrain draws. More regions: tests/scenes. What the core proves: HorizonTest.cpp.

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
        globe.root->addChild(makeGlobe());
        installBins(*globe.root);
        EXPECT_EQ(globe.drawsAntipode(), hasGap);
    }
}

constexpr float kSkirt = 30000.0f;

// A root tile with one tile below it.
struct Pair {
    Pair(const core::GeodeticBin& rootExtents, const core::GeodeticBin& extents, float scale = 1.0f)
        : tile(makeFlatTile(extents, 50.0f, kSkirt)),
          root(makePaged(makeFlatTile(rootExtents, 50.0f, kSkirt), "below.osgb", 1e9f)) {
        putBelow(*root, tile);
        terrain->setVerticalScale(scale);
        terrain->addChild(root);
    }
    osg::ref_ptr<osgTerrain::TerrainTile> tile;
    osg::ref_ptr<osg::PagedLOD> root;
    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
};

double skirtOf(const Pair& pair) {
    installBins(*pair.terrain, optionsOf("heights=0..100"));
    return installedOn(*pair.tile)->getSkirt();
}

TEST(Border, TilesHoldTheirSkirtsWhole) {
    for (const float scale : {1.0f, 3.0f}) {
        const Pair pair(extentsDeg(10, 50, 0, 40), extentsDeg(10, 20, 30, 40), scale);
        installBins(*pair.terrain, optionsOf("heights=0..100"));
        for (osg::Node* node : {static_cast<osg::Node*>(pair.root), static_cast<osg::Node*>(pair.tile)}) {
            ASSERT_NE(installedOn(*node), nullptr);
            const AnalyticBin bin = culledBin(*installedOn(*node));
            const DrawnTriangles drawn = drawnTriangles(*pair.tile, scale);
            ASSERT_FALSE(drawn.skirts.empty());
            EXPECT_LE(metresOutside(bin, samplesOf(drawn.skirts), earth()), bin.margin());
        }
    }
}

TEST(Border, ASkirtInPlainViewIsNotCulled) {
    const Pair pair(extentsDeg(0, 40, 0, 40), extentsDeg(14, 16, 0, 2));
    ReachedTiles reached;
    reached.watch(*pair.tile, "tile");
    installBins(*pair.terrain, optionsOf("heights=0..100"));
    const osg::Vec3d eye = ecefDeg(15, -3, 2000);
    EXPECT_EQ(reached.in(*pair.terrain, eye, ecefDeg(15, 0, -25000), 0.5).count("tile"), 1u);
    EXPECT_EQ(reached.in(*pair.terrain, eye, ecefDeg(15, 0, -60000), 0.5).count("tile"), 0u);
}

TEST(Border, RunsAlongEachSideAndIsInherited) {
    const auto root = extentsDeg(-20, 20, 160, 200);
    EXPECT_EQ(skirtOf({root, extentsDeg(-20, -10, 170, 180)}), kSkirt);
    EXPECT_EQ(skirtOf({root, extentsDeg(10, 20, 170, 180)}), kSkirt);
    EXPECT_EQ(skirtOf({root, extentsDeg(0, 10, 160, 170)}), kSkirt);
    // OSG gives longitudes beyond the date line as they are, and other builders from the other side
    EXPECT_EQ(skirtOf({root, extentsDeg(0, 10, -170, -160)}), kSkirt);
    EXPECT_EQ(skirtOf({root, extentsDeg(0, 10, 170, 180)}), 0.0);
}

TEST(Border, IsNeitherAtAPoleNorWhereATileRunsAroundTheGlobe) {
    const auto globe = extentsDeg(-90, 90, -180, 180), north = extentsDeg(30, 90, -180, 180);
    EXPECT_EQ(skirtOf({globe, extentsDeg(-90, 0, -180, -90)}), 0.0);
    EXPECT_EQ(skirtOf({globe, extentsDeg(0, 90, 90, 180)}), 0.0);
    EXPECT_EQ(skirtOf({north, extentsDeg(60, 90, -180, -90)}), 0.0);
    EXPECT_EQ(skirtOf({north, extentsDeg(30, 60, -180, -90)}), kSkirt);
}

TEST(Border, TilesThatAnIndexKnowsHoldTheirSkirtsToo) {
    const Pair pair(extentsDeg(10, 50, 0, 40), extentsDeg(20, 30, 10, 20));
    const auto entryOf = [](osg::Node& mesh) {
        const TileSurface surface = tileSurface(mesh, osg::EllipsoidModel(), osg::Matrixd());
        const double low = surface.bin.bin().altitude().lower;
        return BinIndex::Entry{surface.bin, low, surfaceFingerprint(mesh, osg::Matrixd())};
    };
    const osg::ref_ptr<BinIndex> index = new BinIndex;
    index->setTiles("", {entryOf(*pair.root->getChild(0))});
    index->setTiles("below.osgb", {entryOf(*pair.tile)});
    installBinsByIndex(*pair.terrain, {}, *index);
    const AnalyticBinCullCallback& root = *installedOn(*pair.root);
    // known, or the bin would hold the default heights
    ASSERT_LT(root.getBin().bin().altitude().upper, 1000.0);
    EXPECT_EQ(root.getSkirt(), kSkirt);
    EXPECT_EQ(installedOn(*pair.tile)->getSkirt(), 0.0);
}

// A stored bin says nothing of skirts.
TEST(Border, StoredBinsHoldSkirtsWholeThereAndWhereAsked) {
    for (const bool isAsked : {false, true}) {
        for (const double east : {20.0, 40.0}) {
            const Pair pair(extentsDeg(10, 50, 0, 40), extentsDeg(20, 30, east - 10.0, east));
            const AnalyticBin stored(core::GeodeticBin::fromDegrees({20, 30}, {east - 10.0, east}, {-3000, 100}));
            setStoredBin(*pair.tile, stored);
            installBins(*pair.terrain, optionsOf(isAsked ? "heights=0..100,skirts=all" : "heights=0..100"));
            ASSERT_NE(installedOn(*pair.tile), nullptr);
            const bool isHeld = isAsked || east == 40.0;
            EXPECT_EQ(installedOn(*pair.tile)->getSkirt(), isHeld ? kSkirt : 0.0f) << isAsked << east;
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
