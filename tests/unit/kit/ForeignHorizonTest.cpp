// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// When databases of other builders, which declare no horizon, have one: where their tiles cover the globe.

#include "DatabaseFixture.h"

#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/LOD>
#include <osg/MatrixTransform>

namespace osgAnalyticBin::test {
namespace {

constexpr double kWidth = 45.0;

// 8 x 4 tiles of a globe, as roots or paged below one that covers it.
struct Globe {
    explicit Globe(bool isBelowATile, int left = 32, const CullOptions& options = {}, osg::Node* more = nullptr) {
        const osg::ref_ptr<osg::Group> tiles = new osg::Group;
        for (int i = 0; i < left; ++i) {
            const double south = -90.0 + kWidth * (i / 8);
            const double west = -180.0 + kWidth * (i % 8);
            const auto tile = makeFlatTile(extentsDeg(south, south + kWidth, west, west + kWidth), 0.0f);
            reached.watch(*tile, std::to_string(i));
            tiles->addChild(tile);
        }
        if (isBelowATile) {
            const auto root = makePaged(makeFlatTile(extentsDeg(-90, 90, -180, 180), 0.0f), "below.osgb", 1e9f);
            putBelow(*root, tiles);
            terrain->addChild(root);
        } else {
            terrain->addChild(tiles);
        }
        if (more) terrain->addChild(more);
        installBins(*terrain, options);
    }

    // From 500 km above the middle of tile 19 (lat 22.5, lon -22.5), which looks down.
    const std::set<std::string>& seen() { return reached.in(*terrain, ecefDeg(22.5, -22.5, 5e5), {0, 0, 0}, 100.0); }

    ReachedTiles reached;
    osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
};

// Around lat -22.5, lon 157.5: on the other side of the globe.
constexpr const char* kAntipode = "15";

TEST(ForeignHorizon, IsUsedWithoutBeingDeclaredWhereTilesCoverTheGlobe) {
    for (const bool isBelowATile : {false, true}) {
        Globe globe(isBelowATile);
        EXPECT_EQ(globe.seen().count("19"), 1u);
        EXPECT_EQ(globe.seen().count(kAntipode), 0u);
        EXPECT_LT(globe.seen().size(), 16u);
    }
}

TEST(ForeignHorizon, IsNotUsedWhereTilesLeaveAGap) {
    for (const bool isBelowATile : {false, true}) {
        Globe globe(isBelowATile, 31);
        EXPECT_EQ(globe.seen().count("19"), 1u);
        EXPECT_EQ(globe.seen().count(kAntipode), 1u);
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
        Globe globe(false, 32, {}, set);
        EXPECT_EQ(globe.seen().count("19"), 1u);
        EXPECT_EQ(globe.seen().count(kAntipode), 0u);
    }
}

TEST(ForeignHorizon, AnotherGlobeInsideDoesNotHideThatTilesLeaveAGap) {
    const osg::ref_ptr<osg::CoordinateSystemNode> inside = new osg::CoordinateSystemNode;
    inside->setEllipsoidModel(new osg::EllipsoidModel);
    Globe gap(false, 31, {}, inside);
    EXPECT_EQ(gap.seen().count(kAntipode), 1u);
    Globe whole(false, 32, {}, inside);
    EXPECT_EQ(whole.seen().count(kAntipode), 0u);
}

TEST(ForeignHorizon, IsNotUsedWhereAllSkirtsCountOrWhereItIsOff) {
    CullOptions skirts;
    skirts.skirts = SkirtUse::All;
    CullOptions off;
    off.horizonUse = HorizonUse::Off;
    for (const CullOptions& options : {skirts, off}) {
        Globe globe(true, 32, options);
        EXPECT_EQ(globe.seen().count(kAntipode), 1u);
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
