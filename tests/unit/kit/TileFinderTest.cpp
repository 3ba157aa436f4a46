// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle: scene graphs whose tiles are known because they were put there. And scenes that are deeper than any terrain:
// the kit's visitors end with the stack that OSG's own traversals need.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

osg::ref_ptr<osg::MatrixTransform> makeLeaf() {
    return placed(new osg::Geometry, {});
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
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeLeaf(), "c.osgb");
    const osg::ref_ptr<osg::Node> leaf = makeLeaf();
    const osg::ref_ptr<osgTerrain::TerrainTile> terrainLeaf = new osgTerrain::TerrainTile;
    const auto file = makeGroup({leaf, paged, terrainLeaf});
    const std::vector<FoundTile> tiles = findTiles(*file, frameBelowATile());
    EXPECT_EQ(nodesOf(tiles), (std::vector<osg::Node*>{leaf, paged, terrainLeaf}));
    EXPECT_EQ(tiles[1].meshes.front(), paged->getChild(0));
    EXPECT_EQ(tiles[1].pagedFiles, std::vector<std::string>{"a/c.osgb"});
    EXPECT_EQ(tiles[1].frame.file, "a/b.osgb");
    EXPECT_EQ(tiles[2].ordinal, 2u);
    EXPECT_EQ(terrainLeaf->getTerrain(), nullptr);
    // outside of paged files a mesh is none
    EXPECT_EQ(nodesOf(findTiles(*makeGlobe({makeLeaf(), paged}))), std::vector<osg::Node*>{paged});
}

TEST(TileFinder, CountsEachFilesTilesForItself) {
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeLeaf(), "sub/c.osgb"),
                                      inner = makePaged(makeLeaf(), "d.osgb"), second = makePaged(makeLeaf(), "e.osgb");
    paged->addChild(makeGroup({makeLeaf(), inner}));
    const std::vector<FoundTile> tiles = findTiles(*makeGlobe({paged, second}));
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
    const osg::ref_ptr<osg::MatrixTransform> moving = makeLeaf(), animated = makeLeaf();
    moving->setDataVariance(osg::Object::DYNAMIC);
    animated->getChild(0)->asGroup()->getChild(0)->setUpdateCallback(new osg::NodeCallback);
    const auto file = makeGroup({moving, animated, makePaged(moving, "c.osgb"), new osg::MatrixTransform});
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
            const auto globe = makeGlobe({makePaged(new osgTerrain::TerrainTile, "c.osgb")}, isPolar ? 6.4e6 : radius,
                                         isPolar ? radius : 6.4e6);
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

#ifdef __SANITIZE_ADDRESS__
constexpr int kDeep = 1500;  // each call takes several times the stack
#else
constexpr int kDeep = 10000;
#endif

// Nodes each below the one before, the scene at the end. They are taken apart one by one: OSG would do so recursively.
class Chain {
public:
    Chain(const std::function<osg::ref_ptr<osg::Group>(int)>& make, osg::Node* end) {
        for (int i = 0; i < kDeep; ++i) {
            _nodes.push_back(make(i));
            if (i > 0) _nodes[_nodes.size() - 2]->addChild(_nodes.back());
        }
        _nodes.back()->addChild(end);
        root->addChild(_nodes.front());
    }
    ~Chain() {
        root->removeChildren(0, root->getNumChildren());
        for (const auto& node : _nodes) node->removeChildren(0, node->getNumChildren());
    }
    Chain(const Chain&) = delete;
    Chain& operator=(const Chain&) = delete;

    const osg::ref_ptr<osg::CoordinateSystemNode> root = makeGlobe();

private:
    std::vector<osg::ref_ptr<osg::Group>> _nodes;
};

const core::GeodeticBin kExtents = extentsDeg(10, 12, 20, 22);

// Above a tile, and below one.
TEST(HugeScenes, TransformsMayBeDeep) {
    const osg::ref_ptr<osg::PagedLOD> tile = makePaged(makeMeshTile(kExtents, 100.0), "none.osgb"),
                                      above = makePaged(makeMeshTile(kExtents, 100.0), "none.osgb");
    const auto makeTransform = [](int) { return new osg::MatrixTransform; };
    Chain chain(makeTransform, tile), chainBelow(makeTransform, makeMeshTile(kExtents, 100.0));
    putBelow(*above, chainBelow.root->getChild(0));
    chain.root->addChild(above);
    for (const Method method : {Method::None, Method::Sphere, Method::Quadratic}) {
        (void)installBins(*chain.root, by(method));
        update(*chain.root);
        EXPECT_FALSE(cull(*chain.root, downTo(11.0, 21.0)).drawn.empty());
    }
    EXPECT_EQ(installBins(*chain.root), 3u);
    EXPECT_TRUE(installedOn(*tile) && installedOn(*above) && installedOn(*chainBelow.root->getChild(0)));
    EXPECT_TRUE(cull(*chain.root, downTo(11.0, 60.0)).drawn.empty());
}

TEST(HugeScenes, TilesMayBeDeep) {
    Chain chain(
        [](int i) -> osg::ref_ptr<osg::Group> {
            return makePaged(makeMeshTile(kExtents, 100.0 + i), "tile" + std::to_string(i) + ".osgb");
        },
        makeMeshTile(kExtents, 100.0));
    const CapturedNotes notes;
    EXPECT_GT(installBins(*chain.root), 100u);
    EXPECT_EQ(notes.count("tiles nested hundreds deep"), 1u);
    for (const Method method : {Method::None, Method::Sphere, Method::Exact})
        (void)installBins(*chain.root, by(method));
}

}  // namespace
}  // namespace osgAnalyticBin::test
