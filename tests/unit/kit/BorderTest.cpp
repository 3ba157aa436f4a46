// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Skirts at the outer border of a database, where no neighbour stands before them. Oracle: the triangles that
// osgTerrain draws.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

constexpr float kSkirt = 30000.0f;

const core::Ellipsoid kBorderEllipsoid(osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR);

CullOptions lowHeights() {
    CullOptions options;
    options.heights = {0.0, 100.0};
    return options;
}

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
    installBins(*pair.terrain, lowHeights());
    return installedOn(*pair.tile)->getSkirt();
}

TEST(Border, TilesHoldTheirSkirtsWhole) {
    for (const float scale : {1.0f, 3.0f}) {
        const Pair pair(extentsDeg(10, 50, 0, 40), extentsDeg(10, 20, 30, 40), scale);
        installBins(*pair.terrain, lowHeights());
        for (osg::Node* node : {static_cast<osg::Node*>(pair.root), static_cast<osg::Node*>(pair.tile)}) {
            ASSERT_NE(installedOn(*node), nullptr);
            const AnalyticBin bin = culledBin(*installedOn(*node));
            const DrawnTriangles drawn = drawnTriangles(*pair.tile, scale);
            ASSERT_FALSE(drawn.skirts.empty());
            EXPECT_LE(metresOutside(bin, samplesOf(drawn.skirts), kBorderEllipsoid), bin.margin());
        }
    }
}

TEST(Border, ASkirtInPlainViewIsNotCulled) {
    const Pair pair(extentsDeg(0, 40, 0, 40), extentsDeg(14, 16, 0, 2));
    ReachedTiles reached;
    reached.watch(*pair.tile, "tile");
    installBins(*pair.terrain, lowHeights());
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
    const auto globe = extentsDeg(-90, 90, -180, 180);
    const auto north = extentsDeg(30, 90, -180, 180);
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
            CullOptions options = lowHeights();
            if (isAsked) options.skirts = SkirtUse::All;
            installBins(*pair.terrain, options);
            ASSERT_NE(installedOn(*pair.tile), nullptr);
            const bool isHeld = isAsked || east == 40.0;
            EXPECT_EQ(installedOn(*pair.tile)->getSkirt(), isHeld ? kSkirt : 0.0f) << isAsked << east;
        }
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
