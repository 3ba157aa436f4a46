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
    void raise(int row, int column, double height) {
        const double south = southernmost + width * row, west = width * column;
        tile(row, column).setChild(0, makeMeshTile(extentsDeg(south, south + width, west, west + width), height));
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

TEST(RegionalTerrain, HidesNothingFromBesideTheRegion) {
    RidgeRegion region;
    for (const auto& [latitude, longitude] : {std::pair(10.3, -0.1), {10.3, -0.001}, {9.99, 0.1}, {10.61, 0.1}})
        EXPECT_TRUE(region.drawsFarTile(latitude, longitude)) << latitude << ' ' << longitude;
    // parallels bulge northward from lines of sight along the northern border
    EXPECT_TRUE(region.drawsFarTile(10.5937, 0.1));
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
