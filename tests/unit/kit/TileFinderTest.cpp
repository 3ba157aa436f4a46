// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle: scene graphs whose tiles are known because they were put there.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

osg::ref_ptr<osg::MatrixTransform> makeMesh(double x = 0.0) {
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(osg::Matrixd::translate(x, 0, 0));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::Geometry);
    transform->addChild(geode);
    return transform;
}

std::vector<osg::Node*> nodesOf(const std::vector<FoundTile>& tiles) {
    std::vector<osg::Node*> nodes;
    for (const FoundTile& tile : tiles) nodes.push_back(tile.node.get());
    return nodes;
}

TileFrame frameBelowATile() {
    TileFrame frame;
    frame.ellipsoid = new osg::EllipsoidModel;
    frame.file = "a/b.osgb";
    frame.isBelowTile = true;
    return frame;
}

TEST(TileFinder, FindsPagedMeshesAndTheLeavesBesideThem) {
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeMesh(), "c.osgb");
    const osg::ref_ptr<osg::Node> leaf = makeMesh();
    const osg::ref_ptr<osgTerrain::TerrainTile> terrainLeaf = new osgTerrain::TerrainTile;
    file->addChild(leaf);
    file->addChild(paged);
    file->addChild(terrainLeaf);
    const std::vector<FoundTile> tiles = findTiles(*file, frameBelowATile());
    EXPECT_EQ(nodesOf(tiles), (std::vector<osg::Node*>{leaf, paged, terrainLeaf}));
    EXPECT_EQ(tiles[1].meshes.front(), paged->getChild(0));
    EXPECT_EQ(tiles[1].pagedFiles, std::vector<std::string>{"a/c.osgb"});
    EXPECT_EQ(tiles[1].frame.file, "a/b.osgb");
    EXPECT_EQ(tiles[2].ordinal, 2u);
    EXPECT_EQ(terrainLeaf->getTerrain(), nullptr);
}

TEST(TileFinder, OutsideOfPagedFilesAMeshIsNoTile) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    root->addChild(makeMesh());
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeMesh(), "c.osgb");
    root->addChild(paged);
    EXPECT_EQ(nodesOf(findTiles(*root)), std::vector<osg::Node*>{paged});
}

TEST(TileFinder, CountsEachFilesTilesForItself) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeMesh(), "sub/c.osgb");
    const osg::ref_ptr<osg::Group> loaded = new osg::Group;
    const osg::ref_ptr<osg::PagedLOD> inner = makePaged(makeMesh(), "d.osgb");
    loaded->addChild(makeMesh());
    loaded->addChild(inner);
    paged->addChild(loaded);
    root->addChild(paged);
    const osg::ref_ptr<osg::PagedLOD> second = makePaged(makeMesh(), "e.osgb");
    root->addChild(second);
    const std::vector<FoundTile> tiles = findTiles(*root);
    ASSERT_EQ(tiles.size(), 4u);
    EXPECT_EQ(tiles[2].node, inner);
    EXPECT_EQ(tiles[2].frame.file, "sub/c.osgb");
    EXPECT_EQ(tiles[2].ordinal, 1u);
    EXPECT_EQ(tiles[2].pagedFiles, std::vector<std::string>{"sub/d.osgb"});
    EXPECT_EQ(tiles[3].node, second);
    EXPECT_EQ(tiles[3].frame.file, "");
    EXPECT_EQ(tiles[3].ordinal, 1u);
}

TEST(TileFinder, WhatMayMoveIsNoTile) {
    const osg::ref_ptr<osg::Group> file = new osg::Group;
    const osg::ref_ptr<osg::MatrixTransform> moving = makeMesh();
    moving->setDataVariance(osg::Object::DYNAMIC);
    const osg::ref_ptr<osg::MatrixTransform> animated = makeMesh();
    animated->getChild(0)->asGroup()->getChild(0)->setUpdateCallback(new osg::NodeCallback);
    file->addChild(moving);
    file->addChild(animated);
    file->addChild(makePaged(moving, "c.osgb"));
    file->addChild(new osg::MatrixTransform);
    EXPECT_TRUE(findTiles(*file, frameBelowATile()).empty());
}

TEST(TileFinder, ATerrainWithoutEllipsoidIsOnWgs84AndAMapIsNoGlobe) {
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    terrain->setEllipsoidModel(nullptr);
    terrain->addChild(makePaged(new osgTerrain::TerrainTile, "c.osgb"));
    ASSERT_EQ(findTiles(*terrain).size(), 1u);
    EXPECT_EQ(findTiles(*terrain)[0].frame.ellipsoid->getRadiusEquator(), osg::WGS_84_RADIUS_EQUATOR);
    terrain->setCoordinateSystem("PROJCS[\"UTM 33\"]");
    ASSERT_EQ(findTiles(*terrain).size(), 1u);
    EXPECT_FALSE(findTiles(*terrain)[0].frame.ellipsoid);
    EXPECT_TRUE(findTiles(*terrain)[0].frame.isProjected);
}

TEST(TileFinder, BelowAGlobeWithoutRightRadiiIsNoTile) {
    for (const double radius : {std::nan(""), std::numeric_limits<double>::infinity(), 0.0, -6.4e6}) {
        for (const bool isPolar : {false, true}) {
            const osg::ref_ptr<osg::CoordinateSystemNode> globe = new osg::CoordinateSystemNode;
            globe->setEllipsoidModel(new osg::EllipsoidModel(isPolar ? 6.4e6 : radius, isPolar ? radius : 6.4e6));
            globe->addChild(makePaged(new osgTerrain::TerrainTile, "c.osgb"));
            EXPECT_FALSE(hasValidRadii(*globe->getEllipsoidModel()));
            EXPECT_TRUE(findTiles(*globe).empty()) << radius;
        }
    }
}

TEST(TileFinder, PathsOfPagedFilesAreRelativeToTheRoot) {
    EXPECT_EQ(pagedFilePath("", "a/b.osgb"), "a/b.osgb");
    EXPECT_EQ(pagedFilePath("a/b.osgb", "c.osgb"), "a/c.osgb");
    EXPECT_EQ(pagedFilePath("a/b.osgb", "../c/./d.osgb"), "c/d.osgb");
    EXPECT_EQ(pagedFilePath("a/b.osgb", "../../d.osgb"), "../d.osgb");
    EXPECT_EQ(pagedFilePath("a/b.osgb", "/etc/d.osgb"), "/etc/d.osgb");
    EXPECT_EQ(pagedFilePath("a/b.osgb", "http://host/d.osgb"), "http://host/d.osgb");
}

}  // namespace
}  // namespace osgAnalyticBin::test
