// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which databases are taken for maps, and what bins of maps change in them. Databases that cover a part of the globe:
// their horizon, and when those of other builders, which declare none, have one; and the skirts of tiles. Oracle of
// these: the triangles that osgTerrain draws. More regions: tests/scenes. What the core proves: HorizonTest.cpp.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

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
    explicit Pair(const core::GeodeticBin& extents, float rootSkirt = kSkirt)
        : tile(makeFlatTile(extents, 50.0f, kSkirt)),
          root(makePaged(makeFlatTile(extentsDeg(10, 50, 0, 40), 50.0f, rootSkirt), "below.osgb", 1e9f)) {
        putBelow(*root, tile);
        terrain->addChild(root);
    }

    // The tile's skirts are in its bin and in that above it.
    void expectHeld() const {
        for (osg::Node* node : {static_cast<osg::Node*>(root), static_cast<osg::Node*>(tile)}) {
            ASSERT_NE(installedOn(*node), nullptr);
            const AnalyticBin bin = culledBin(*installedOn(*node));
            const DrawnTriangles drawn = drawnTriangles(*tile, terrain->getVerticalScale());
            ASSERT_FALSE(drawn.skirts.empty());
            EXPECT_LE(metresOutside(bin, samplesOf(drawn.skirts), earth()), bin.margin());
        }
    }

    osg::ref_ptr<osgTerrain::TerrainTile> tile;
    osg::ref_ptr<osg::PagedLOD> root;
    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
};

// In the middle of the root tile, and at its border.
const core::GeodeticBin kPlaces[] = {extentsDeg(20, 30, 10, 20), extentsDeg(10, 20, 30, 40)};

// Skirts longer than the root tile's are unknown before their tile is read. Stored bins hold what leans outward.
TEST(Skirts, AreInTheBinsOfTheirTileAndOfThatAbove) {
    for (const auto& [place, isStored] :
         {std::pair(kPlaces[0], false), std::pair(kPlaces[0], true), std::pair(kPlaces[1], false)}) {
        for (const float scale : {1.0f, 3.0f, 0.5f}) {
            for (const float rootSkirt : {kSkirt, 100.0f}) {
                const Pair pair(place, rootSkirt);
                pair.terrain->setVerticalScale(scale);
                if (isStored)
                    setStoredBin(*pair.root, AnalyticBin(extentsDeg(10, 50, 0, 40).withAltitude({-9000, 100})));
                installBins(*pair.terrain, optionsOf("heights=0..100"));
                pair.expectHeld();
            }
        }
    }
}

TEST(Skirts, OfAnIndexAreInItsBins) {
    for (const float scale : {1.0f, 3.0f, 0.5f}) {
        const Pair pair(kPlaces[0]);
        pair.terrain->setVerticalScale(scale);
        const auto entryOf = [](osg::Node& mesh) {
            const TileSurface surface = tileSurface(mesh, osg::EllipsoidModel(), osg::Matrixd());
            const double low = surface.bin.bin().altitude().lower;
            return BinIndex::Entry{surface.bin.withSkirts(surface.skirt), low,
                                   surfaceFingerprint(mesh, osg::Matrixd())};
        };
        const osg::ref_ptr<BinIndex> index = new BinIndex;
        index->setTiles("", {entryOf(*pair.root->getChild(0))});
        index->setTiles("below.osgb", {entryOf(*pair.tile)});
        installBinsByIndex(*pair.terrain, {}, *index);
        // known, or the bin would hold the default heights
        ASSERT_LT(installedOn(*pair.root)->getBin().bin().altitude().upper, 1000.0);
        EXPECT_EQ(installedOn(*pair.root)->getSkirt(), 0.0);
        pair.expectHeld();
    }
}

// The maker of a stored bin need not have thought of skirts.
TEST(Skirts, HangBelowStoredBins) {
    const Pair pair(kPlaces[0]);
    setStoredBin(*pair.tile, tileSurface(*pair.tile, osg::EllipsoidModel(), osg::Matrixd()).bin);
    installBins(*pair.terrain, optionsOf("heights=0..100"));
    pair.expectHeld();
}

enum class Callback { None, Planar, Geocentric };

// Installs bins on a paged tile with this mesh. Returns: which callback the tile got.
Callback installedOnMap(osg::CoordinateSystemNode& root, const osg::ref_ptr<osg::Node>& mesh) {
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(mesh, "parts.osgb");
    root.removeChildren(0, root.getNumChildren());
    root.addChild(tile);
    const std::size_t installed = installBins(root);
    osg::Callback* callback = tile->getCullCallback();
    EXPECT_EQ(installed, callback ? 1u : 0u);
    EXPECT_TRUE(tile->getCullingActive());
    if (!callback) return Callback::None;
    const auto& bin = dynamic_cast<AnalyticBinCullCallback&>(*callback);
    return bin.getRadiiText() == "map" ? Callback::Planar : Callback::Geocentric;
}

TEST(PlanarDatabase, IsToldByItsCoordinateSystemOrItsLocators) {
    struct Row {
        std::string format, text;
        bool hasEllipsoid, isTerrain;
        Callback expected;
    };
    const std::string utm = kUtm;
    const std::vector<Row> rows{
        {"WKT", utm, false, false, Callback::Planar},
        {"WKT", utm, false, true, Callback::Planar},
        {"", utm, false, false, Callback::Planar},
        {"WKT", "PROJCRS[\"WGS 84 / UTM zone 33N\"]", false, false, Callback::Planar},
        {"WKT", "COMPD_CS[\"UTM and heights\"," + utm + ",VERT_CS[\"EGM96\"]]", false, false, Callback::Planar},
        {"WKT", "COMPD_CS[\"WGS 84\",GEOGCS[\"WGS 84\"],VERT_CS[\"EGM96\"]]", false, false, Callback::None},
        {"PROJ4", "+proj=utm +zone=33 +datum=WGS84", false, false, Callback::Planar},
        {"PROJ4", "+zone=33 +proj=utm", false, false, Callback::Planar},
        {"PROJ4", "+proj=longlat +datum=WGS84", false, false, Callback::None},
        {"PROJ4", "+proj=geocent", false, false, Callback::None},
        {"WKT", "+proj=utm +zone=33", false, false, Callback::None},
        {"PROJ4", "+init=epsg:32633", false, false, Callback::None},
        {"WKT", "GEOGCS[\"WGS 84\"]", false, false, Callback::None},
        {"WKT", "GEOCCS[\"WGS 84\"]", false, false, Callback::None},
        {"", "", false, false, Callback::None},
        // locators say what osgTerrain draws
        {"WKT", "GEOGCS[\"WGS 84\"]", false, true, Callback::Planar},
        {"PROJ4", "+proj=longlat", false, true, Callback::Planar},
        {"", "", false, true, Callback::Planar},
        {"", "", true, true, Callback::Planar},
        // a map, but also an ellipsoid
        {"WKT", utm, true, true, Callback::Planar},
        {"WKT", utm, true, false, Callback::None}};
    for (const Row& row : rows) {
        PlanarMap map;
        map.isTerrain = row.isTerrain;
        const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode(row.format, row.text);
        if (row.hasEllipsoid) root->setEllipsoidModel(new osg::EllipsoidModel);
        EXPECT_EQ(installedOnMap(*root, map.mesh(1, 0, 0)), row.expected)
            << row.format << ' ' << row.text << (row.isTerrain ? " terrain" : " mesh");
    }
}

TEST(PlanarDatabase, LocatorsInDegreesArePlanarToo) {
    PlanarMap map;
    map.origin = osg::Vec3d(10, 45, 0);
    map.size = 2.0;
    map.heightUnit = 111319.0;  // as VirtualPlanetBuilder scales them
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode("WKT", "GEOGCS[\"WGS 84\"]");
    const osg::ref_ptr<osg::Node> tile = map.mesh(0, 0, 0);
    auto& locator = *dynamic_cast<osgTerrain::TerrainTile&>(*tile).getLocator();
    EXPECT_EQ(installedOnMap(*root, tile), Callback::Planar);
    locator.setCoordinateSystemType(osgTerrain::Locator::GEOGRAPHIC);
    EXPECT_EQ(installedOnMap(*root, tile), Callback::Planar);
    locator.setCoordinateSystemType(osgTerrain::Locator::GEOCENTRIC);
    EXPECT_NE(installedOnMap(*root, tile), Callback::Planar);
}

osg::ref_ptr<osg::Geometry> triangles(const std::vector<osg::Vec3>& vertices) {
    return makeGeometry(new osg::Vec3Array(vertices.begin(), vertices.end()),
                        new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(vertices.size())));
}

TEST(PlanarDatabase, ATextThatNamesAMapAboveAGlobeIsFoundOut) {
    for (const double latitude : {45.0, 0.3, 88.0, -30.0}) {
        std::vector<osg::Vec3> vertices;
        for (const auto& [north, east] : {std::pair{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}})
            vertices.push_back(ecefDeg(latitude + 0.5 * north, 20.0 + 0.5 * east, 300.0));
        const osg::ref_ptr<osg::Geometry> geometry = triangles(vertices);
        const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode("WKT", kUtm);
        EXPECT_EQ(installedOnMap(*root, geometry), Callback::None) << latitude;
        root->setEllipsoidModel(new osg::EllipsoidModel);
        EXPECT_EQ(installedOnMap(*root, geometry), Callback::Geocentric) << latitude;
    }
    // and a map at a northing that is nearly the earth's radius is no globe
    PlanarMap map;
    map.isTerrain = false;
    map.origin.y() = 6340000.0;
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode("WKT", kUtm);
    root->setEllipsoidModel(new osg::EllipsoidModel);
    EXPECT_EQ(installedOnMap(*root, map.mesh(2, 0, 0)), Callback::None);
}

TEST(PlanarDatabase, WhatIsNoTerrainIsLeftAsItIs) {
    const osg::Vec3 a(0, 0, 0), b(100, 0, 0), c(0, 100, 0), up(0, 0, 50);
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode("WKT", kUtm);
    ASSERT_EQ(installedOnMap(*root, triangles({a, b, c})), Callback::Planar);
    ASSERT_EQ(installedOnMap(*root, triangles({a, c, b})), Callback::Planar) << "wound the other way";
    EXPECT_EQ(installedOnMap(*root, triangles({a, b, c, a + up, c + up, b + up})), Callback::None) << "a closed body";
    EXPECT_EQ(installedOnMap(*root, triangles({a, b, a + up})), Callback::None) << "a wall";
    const osg::Vec3 high(0, 0, 2e5f);
    EXPECT_EQ(installedOnMap(*root, triangles({a + high, b + high, c + high})), Callback::None) << "in orbit";
    const float nan = std::nanf("");
    EXPECT_EQ(installedOnMap(*root, triangles({a, b, c, a, b, osg::Vec3(nan, 0, 0)})), Callback::None) << "broken";
    PlanarMap far;
    far.origin.y() = 1.5e10;
    for (const bool isTerrain : {false, true}) {
        far.isTerrain = isTerrain;
        EXPECT_EQ(installedOnMap(*root, far.mesh(0, 0, 0)), Callback::None) << "farther than latitudes reach";
    }
    const auto moving = makeTransform({}, {triangles({a, b, c})});
    moving->setDataVariance(osg::Object::DYNAMIC);
    EXPECT_EQ(installedOnMap(*root, moving), Callback::None);
    // outside of paged files a mesh is no tile
    root->removeChildren(0, root->getNumChildren());
    root->addChild(triangles({a, b, c}));
    EXPECT_EQ(installBins(*root), 0u);
    EXPECT_TRUE(root->getChild(0)->getCullingActive());
}

TEST(PlanarDatabase, TextTellsAMap) {
    const osg::ref_ptr<AnalyticBinCullCallback> callback = new AnalyticBinCullCallback;
    EXPECT_NE(callback->getRadiiText(), "map");
    for (const char* const text : {"map", "6378137 6356752"}) {
        callback->setRadiiText(text);
        EXPECT_EQ(callback->getRadiiText(), text);
    }
}

TEST(PlanarDatabase, SpheresTakeItBackAndClusterCallbacksStay) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode("WKT", kUtm);
    PlanarMap map;
    map.isTerrain = false;
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(map.mesh(0, 0, 0), "parts.osgb");
    const osg::ref_ptr<osg::ClusterCullingCallback> cluster = new osg::ClusterCullingCallback;
    cluster->set(osg::Vec3(1, 2, 3), osg::Vec3(0, 0, 1), -0.5f, 1000.0f);
    tile->setCullCallback(cluster);
    root->addChild(tile);
    for (const char* method : {"quadratic", "exact", "quadratic"}) {
        EXPECT_EQ(installBins(*root, optionsOf(std::string("method=") + method)), 1u) << method;
        EXPECT_EQ(tile->getCullCallback()->getNestedCallback(), cluster.get()) << "and one of ours, not two";
        EXPECT_DOUBLE_EQ(tile->getMinimumExpiryTime(1), CullOptions::kDefaultExpiry);
    }
    EXPECT_EQ(cluster->getDeviation(), -0.5f);
    // without declared heights the bins hold all terrain on earth, in feet
    const core::Interval heights = installedOn(*tile)->getBin().bin().altitude();
    EXPECT_GE(heights.upper, 8849.0 / 0.3048);
    EXPECT_LE(heights.lower, -10935.0 / 0.3048);
    EXPECT_EQ(installBins(*root, optionsOf("method=sphere")), 0u);
    EXPECT_EQ(tile->getCullCallback(), cluster.get());
    EXPECT_TRUE(tile->getCullingActive());
    EXPECT_TRUE(tile->getChild(0)->getCullingActive());
    EXPECT_EQ(tile->getMinimumExpiryTime(1), 0.0);
    EXPECT_EQ(root->getCullCallback(), nullptr);
}

}  // namespace
}  // namespace osgAnalyticBin::test
