// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Oracle: scene graphs whose tiles are known because they were put there. And scenes that are deeper than any terrain:
// the kit's visitors end with the stack that OSG's own traversals need.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

osg::ref_ptr<osg::MatrixTransform> makeLeaf(double x = 0.0) {
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
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeLeaf(), "c.osgb");
    const osg::ref_ptr<osg::Node> leaf = makeLeaf();
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
    root->addChild(makeLeaf());
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeLeaf(), "c.osgb");
    root->addChild(paged);
    EXPECT_EQ(nodesOf(findTiles(*root)), std::vector<osg::Node*>{paged});
}

TEST(TileFinder, CountsEachFilesTilesForItself) {
    const osg::ref_ptr<osg::CoordinateSystemNode> root = new osg::CoordinateSystemNode;
    const osg::ref_ptr<osg::PagedLOD> paged = makePaged(makeLeaf(), "sub/c.osgb");
    const osg::ref_ptr<osg::Group> loaded = new osg::Group;
    const osg::ref_ptr<osg::PagedLOD> inner = makePaged(makeLeaf(), "d.osgb");
    loaded->addChild(makeLeaf());
    loaded->addChild(inner);
    paged->addChild(loaded);
    root->addChild(paged);
    const osg::ref_ptr<osg::PagedLOD> second = makePaged(makeLeaf(), "e.osgb");
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
    const osg::ref_ptr<osg::MatrixTransform> moving = makeLeaf();
    moving->setDataVariance(osg::Object::DYNAMIC);
    const osg::ref_ptr<osg::MatrixTransform> animated = makeLeaf();
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
