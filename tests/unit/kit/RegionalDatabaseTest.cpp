// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Databases that cover a part of the globe: the horizon, and terrain that hides terrain; and when those of other
// builders, which declare no horizon, have one. Pictures and random scenes: tests/long/scenes. What the core proves:
// CoveredRegionTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"
#include "DatabaseFixture.h"

#include <osgAnalyticBin/AnalyticBin.h>
#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/CoordinateSystemNode>
#include <osg/LOD>
#include <osg/MatrixTransform>

#include <support/CapturedNotes.h>
#include <utility>
#include <vector>

namespace osgAnalyticBin::test {
namespace {

// Rows of square tiles northward from a latitude and eastward from the zero meridian, without any other terrain.
struct Region : MeshGlobe {
    Region(double south, int rows, int columns, double widthDeg)
        : southernmost(south), width(widthDeg), across(columns) {
        root->removeChildren(0, root->getNumChildren());
        tiles.clear();
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) add(row, column, 0.0);
    }

    void add(int row, int column, double height) {
        const double tileSouth = southernmost + width * row, west = width * column;
        tiles.push_back(
            makePaged(makeMeshTile(extentsDeg(tileSouth, tileSouth + width, west, west + width), height), "no.osgb"));
        root->addChild(tiles.back());
    }

    [[nodiscard]] osg::PagedLOD& tile(int row, int column) {
        return *tiles[static_cast<std::size_t>(row * across + column)];
    }
    // Puts another mesh in the place of one.
    void replace(int row, int column, osg::Node* mesh) { tile(row, column).setChild(0, mesh); }
    void raise(int row, int column, double height) {
        replace(row, column, makeMeshTile(extentsOf(row, column), height));
    }
    [[nodiscard]] core::GeodeticBin extentsOf(int row, int column) const {
        const double south = southernmost + width * row, west = width * column;
        return extentsDeg(south, south + width, west, west + width);
    }

    double southernmost, width;
    int across;
};

// 40 x 40 degrees. From a place the horizon is some 5.6 degrees away at an altitude of 30 km, 12.8 at 160 km.
struct WideRegion : Region {
    WideRegion() : Region(10.0, 8, 8, 5.0) {}

    // Whether the tile in the north-east is drawn in a view that it is in.
    [[nodiscard]] bool drawsFarTile(double latitude, double longitude, double altitude = 30000.0) {
        return draws(tile(7, 7), CullView::lookAt(ecefDeg(latitude, longitude, altitude), ecefDeg(47.5, 37.5, 0.0),
                                                  ecefDeg(latitude, longitude, 0.0), 60.0));
    }
};

TEST(RegionalHorizon, IsUsedWhereItIsWithinTheRegion) {
    WideRegion region;
    EXPECT_TRUE(region.drawsFarTile(30.0, 20.0));
    installBins(*region.root);
    for (const bool isTileByTile : {false, true}) {
        BinStatistics::of(*region.visitor).setTileByTile(isTileByTile);
        EXPECT_FALSE(region.drawsFarTile(30.0, 20.0));
        EXPECT_FALSE(region.drawsFarTile(16.5, 6.5));
        EXPECT_FALSE(region.drawsFarTile(30.0, 20.0, 160000.0));
        // past a border
        EXPECT_TRUE(region.drawsFarTile(30.0, 2.0));
        EXPECT_TRUE(region.drawsFarTile(11.0, 20.0));
        EXPECT_TRUE(region.drawsFarTile(30.0, 39.8));
        // great circles bulge to the north
        EXPECT_TRUE(region.drawsFarTile(49.5, 20.0));
    }
}

TEST(RegionalHorizon, IsNotUsedByAnEyeBesideTheRegion) {
    WideRegion region;
    installBins(*region.root);
    const CapturedNotes notes(osg::NOTICE);
    for (const auto& [latitude, longitude] : {std::pair(30.0, -3.0), {5.0, 20.0}, {51.0, 20.0}, {30.0, 41.0}})
        EXPECT_TRUE(region.drawsFarTile(latitude, longitude)) << latitude << ' ' << longitude;
    EXPECT_EQ(notes.count("not over the regional database"), 1u);
}

TEST(RegionalHorizon, IsNotUsedWhereATileIsMissing) {
    WideRegion region;
    region.root->removeChild(&region.tile(0, 0));
    const CapturedNotes notes(osg::NOTICE);
    installBins(*region.root);
    EXPECT_EQ(notes.count("The horizon is not used"), 1u);
    EXPECT_TRUE(region.drawsFarTile(30.0, 20.0));
}

// Where the ground ends, whatever the bins are.
struct RaggedRegion : WideRegion {
    [[nodiscard]] bool drawsTile(int row, int column, double latitude, double longitude, double altitude,
                                 const osg::Vec3d& to) {
        const osg::Vec3d eye = ecefDeg(latitude, longitude, altitude);
        return draws(tile(row, column), CullView::lookAt(eye, to, eye, 20.0));
    }
};

TEST(RegionalHorizon, EndsWhereATileIsNarrower) {
    RaggedRegion region;
    region.replace(3, 7, makeMeshTile(extentsDeg(25, 30, 35, 38.4), 0.0));
    installBins(*region.root);
    EXPECT_TRUE(region.drawsTile(7, 7, 25.5, 39.1, 400.0, ecefDeg(47.5, 38.5, 0)));
    RaggedRegion inside;
    inside.replace(3, 4, makeMeshTile(extentsDeg(25, 30, 20, 23.4), 0.0));
    installBins(*inside.root);
    EXPECT_TRUE(inside.drawsTile(3, 7, 27.5, 23.6, 8000.0, ecefDeg(27.5, 38.5, 0)));
}

TEST(RegionalHorizon, EndsWhereACoastCutsAMesh) {
    RaggedRegion region;
    auto& geometry = *drawableOf(region.tile(3, 7))->asGeometry();
    const auto& all = static_cast<const osg::DrawElementsUInt&>(*geometry.getPrimitiveSet(0));
    const osg::ref_ptr<osg::DrawElementsUInt> north = new osg::DrawElementsUInt(GL_TRIANGLES);
    const auto isNorthWest = [](unsigned int vertex) { return vertex / 9 >= vertex % 9; };
    for (std::size_t i = 0; i + 2 < all.size(); i += 3) {
        if (isNorthWest(all[i]) && isNorthWest(all[i + 1]) && isNorthWest(all[i + 2]))
            north->insert(north->end(), all.begin() + static_cast<std::ptrdiff_t>(i),
                          all.begin() + static_cast<std::ptrdiff_t>(i + 3));
    }
    geometry.setPrimitiveSet(0, north);
    installBins(*region.root);
    EXPECT_TRUE(region.drawsTile(7, 7, 25.5, 39.1, 400.0, ecefDeg(47.5, 38.5, 0)));
}

TEST(RegionalHorizon, IsNotExtendedByWhatStandsBesideTheGround) {
    RaggedRegion region;
    for (int row = 0; row < 8; ++row) {
        const osg::ref_ptr<osg::Group> group = new osg::Group;
        group->addChild(region.tile(row, 7).getChild(0));
        group->addChild(makeTower(ecefDeg(10.1 + 5 * row, 41.2, 0)));
        group->addChild(makeTower(ecefDeg(14.9 + 5 * row, 41.2, 0)));
        region.replace(row, 7, group);
    }
    installBins(*region.root);
    EXPECT_TRUE(region.drawsTile(7, 7, 25.5, 40.5, 200.0, ecefDeg(47.5, 39.5, 0)));
}

TEST(RegionalHorizon, IsNotExtendedByStoredBinsThatAreTooLarge) {
    RaggedRegion region;
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) {
            const double south = 9.0 + 5.0 * row, west = 5.0 * column - 2.0;
            setStoredBin(region.tile(row, column), AnalyticBin(core::GeodeticBin::fromDegrees(
                                                       {south, south + 7.0}, {west, west + 9.0}, {-1500.0, 100.0})));
            setStoredSurfaceLow(region.tile(row, column), -100.0);
        }
    }
    installBins(*region.root);
    EXPECT_TRUE(region.drawsTile(7, 7, 27.5, 40.3, 1000.0, ecefDeg(47.5, 38.5, 0)));
    EXPECT_FALSE(region.drawsTile(7, 7, 27.5, 20.0, 1000.0, ecefDeg(47.5, 38.5, 0)));
}

TEST(RegionalHorizon, HasHolesAtThePolesWhereTilesDoNotReachThem) {
    WideRegion globe;
    globe.root->removeChildren(0, globe.root->getNumChildren());
    for (int i = 0; i < 12; ++i) {
        const double west = -180.0 + 60.0 * (i % 6);
        globe.tiles[static_cast<std::size_t>(i)] =
            makePaged(makeMeshTile(extentsDeg(i < 6 ? -87 : 0, i < 6 ? 0 : 87, west, west + 60), 0.0), "no.osgb");
        globe.root->addChild(globe.tiles[static_cast<std::size_t>(i)]);
    }
    installBins(*globe.root);
    const osg::Vec3d eye = ecefDeg(89.9, 60, 2000);
    EXPECT_TRUE(globe.draws(*globe.tiles[1], CullView::lookAt(eye, ecefDeg(-20, -90, 0), eye, 60.0)));
}

TEST(RegionalHorizon, FollowsTheTilesWhenBinsAreInstalledAnew) {
    WideRegion region;
    installBins(*region.root);
    EXPECT_TRUE(region.drawsFarTile(30.0, 41.0));
    for (int row = 0; row < 8; ++row)
        for (int column = 8; column < 10; ++column) region.add(row, column, 0.0);
    installBins(*region.root);
    EXPECT_FALSE(region.drawsFarTile(30.0, 41.0));
}

// Ten tiles of 0.2 degrees from west to east, in three rows; the third column is a ridge.
struct RidgeRegion : Region {
    RidgeRegion() : Region(10.0, 3, 10, 0.2) {
        for (int row = 0; row < 3; ++row) raise(row, 2, 8000.0);
        CullOptions options;
        options.occlusion = OcclusionUse::On;
        installBins(*root, options);
    }

    // Whether the tile behind the ridge, as seen from the west, is drawn in a view that it is in.
    [[nodiscard]] bool drawsFarTile(double latitude, double longitude, double altitude = 1000.0) {
        return draws(tile(1, 4), CullView::lookAt(ecefDeg(latitude, longitude, altitude), ecefDeg(10.3, 0.9, altitude),
                                                  ecefDeg(latitude, longitude, 0.0), 30.0));
    }
};

TEST(RegionalTerrain, HidesWhatIsBehindARidge) {
    RidgeRegion region;
    EXPECT_FALSE(region.drawsFarTile(10.3, 0.1));
    EXPECT_GE(BinStatistics::of(*region.visitor).getCounts().occluded, 1u);
    EXPECT_TRUE(region.drawsFarTile(10.3, 0.1, 20000.0));
    setCullOptions(*region.root, {});
    EXPECT_TRUE(region.drawsFarTile(10.3, 0.1));
}

TEST(RegionalTerrain, HidesTheSameWhenTilesAreTestedOneByOne) {
    RidgeRegion region;
    BinStatistics::of(*region.visitor).setTileByTile(true);
    EXPECT_FALSE(region.drawsFarTile(10.3, 0.1));
    EXPECT_TRUE(region.drawsFarTile(10.3, 0.1, 20000.0));
}

TEST(RegionalTerrain, HidesNothingFromBesideTheRegion) {
    RidgeRegion region;
    for (const auto& [latitude, longitude] : {std::pair(10.3, -0.1), {10.3, -0.001}, {9.99, 0.1}, {10.61, 0.1}})
        EXPECT_TRUE(region.drawsFarTile(latitude, longitude)) << latitude << ' ' << longitude;
    // parallels bulge northward from lines of sight along the northern border
    EXPECT_TRUE(region.drawsFarTile(10.5937, 0.1));
}

TEST(RegionalTerrain, HidesNothingWhereATileIsMissing) {
    RidgeRegion region;
    region.root->removeChild(&region.tile(1, 1));
    EXPECT_TRUE(region.drawsFarTile(10.3, 0.1));
}

// A globe of 32 tiles as roots, or paged below one that covers it, and something beside them.
struct ForeignGlobe : MeshGlobe {
    explicit ForeignGlobe(bool isBelowATile, bool hasGap = false, const CullOptions& options = {},
                          osg::Node* more = {}) {
        if (hasGap) root->removeChild(tiles[31]);
        if (isBelowATile) {
            const osg::ref_ptr<osg::Group> file = new osg::Group;
            for (unsigned int i = 0; i < root->getNumChildren(); ++i) file->addChild(root->getChild(i));
            root->removeChildren(0, root->getNumChildren());
            const auto above = makePaged(makeMeshTile(extentsDeg(-90, 90, -180, 180), 0.0, 33), "below.osgb", 1e9f);
            putBelow(*above, file);
            root->addChild(above);
        }
        if (more) root->addChild(more);
        installBins(*root, options);
    }
};

TEST(ForeignHorizon, IsUsedWithoutBeingDeclaredWhereTilesCoverTheGlobe) {
    for (const bool isBelowATile : {false, true}) {
        for (const bool hasGap : {false, true}) {
            ForeignGlobe globe(isBelowATile, hasGap);
            EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
            EXPECT_EQ(globe.drawsAntipode(), hasGap) << isBelowATile;
        }
    }
}

// What a set draws stands before the terrain, if anything.
TEST(ForeignHorizon, IsUsedBesideAPhotogrammetrySet) {
    for (const bool isMoved : {false, true}) {
        const osg::ref_ptr<osg::Group> set = isMoved ? new osg::MatrixTransform : new osg::Group;
        const osg::ref_ptr<osg::LOD> tile = new osg::LOD;
        tile->addChild(makeFlatTile(extentsDeg(20, 21, -21, -20), 100.0f), 0.0f, 1e9f);
        set->addChild(tile);
        markPhotogrammetrySet(*set);
        ForeignGlobe globe(false, false, {}, set);
        EXPECT_TRUE(globe.draws(*globe.tiles[19], MeshGlobe::fromAbove()));
        EXPECT_FALSE(globe.drawsAntipode());
    }
}

TEST(ForeignHorizon, AnotherGlobeInsideDoesNotHideThatTilesLeaveAGap) {
    const osg::ref_ptr<osg::CoordinateSystemNode> inside = new osg::CoordinateSystemNode;
    inside->setEllipsoidModel(new osg::EllipsoidModel);
    for (const bool hasGap : {false, true}) EXPECT_EQ(ForeignGlobe(false, hasGap, {}, inside).drawsAntipode(), hasGap);
}

TEST(ForeignHorizon, IsNotUsedWhereAllSkirtsCountOrWhereItIsOff) {
    CullOptions skirts, off;
    skirts.skirts = SkirtUse::All;
    off.horizonUse = HorizonUse::Off;
    for (const CullOptions& options : {skirts, off}) EXPECT_TRUE(ForeignGlobe(true, false, options).drawsAntipode());
}

}  // namespace
}  // namespace osgAnalyticBin::test
