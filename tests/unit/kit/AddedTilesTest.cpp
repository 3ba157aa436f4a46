// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles that an application attaches by itself, in the manner of a flight simulator: no CoordinateSystemNode stands
// above them, they come in any thread, and their ground has a name.

#include "KitTest.h"

namespace osgAnalyticBin::test {
namespace {

CullOptions onEarth(CullOptions options = {}) {
    options.globe = earth();
    return options;
}

// Leaves of 45 degrees, each in a group, that are not attached yet to a scene with bins.
struct AddedGlobe : MeshGlobe {
    explicit AddedGlobe(const CullOptions& options = onEarth()) {
        scene = new osg::Group;
        root->removeChildren(0, root->getNumChildren());
        for (const auto& tile : std::exchange(tiles, {})) {
            leaves.push_back(makeGroup({tile->getChild(0)}));
            tile->removeChildren(0, 1);
        }
        (void)installBins(*scene, options);
    }

    void addAll() {
        for (const auto& leaf : leaves) {
            EXPECT_EQ(addTile(*scene, *leaf), 1u);
            scene->addChild(leaf);
        }
        update(*scene);
    }
    // The tile on the other side of the globe, from above the middle of tile 19, which looks down.
    [[nodiscard]] bool drawsAntipode() { return draws(*leaves[15], fromAbove()); }

    std::vector<osg::ref_ptr<osg::Group>> leaves;
};

TEST(NamedGlobe, StandsForACoordinateSystemAndOutlivesOtherMethods) {
    MeshGlobe plain;
    plain.scene = makeGroup({plain.tiles.begin(), plain.tiles.end()});
    plain.root->removeChildren(0, plain.root->getNumChildren());
    EXPECT_EQ(installBins(*plain.scene), 0u);
    ASSERT_EQ(installBins(*plain.scene, onEarth()), 32u);
    EXPECT_FALSE(plain.drawsAntipode()) << "no horizon";
    EXPECT_TRUE(plain.draws(*plain.tiles[19], MeshGlobe::fromAbove()));
    EXPECT_EQ(setCullOptions(*plain.scene, onEarth(by(Method::Sphere))), 0u);
    EXPECT_TRUE(plain.drawsAntipode());
    EXPECT_EQ(setCullOptions(*plain.scene, onEarth()), 32u);
    EXPECT_FALSE(plain.drawsAntipode());
    removeBins(*plain.scene);
    EXPECT_TRUE(plain.drawsAntipode());
    EXPECT_EQ(plain.scene->getCullCallback(), nullptr);
}

TEST(AddedTiles, LeaveTheHorizonAloneWhereItsAltitudeIsNotGiven) {
    AddedGlobe globe;
    globe.addAll();
    EXPECT_TRUE(globe.drawsAntipode()) << "nobody knows what lies between the tiles";
    EXPECT_FALSE(globe.draws(*globe.leaves[19], beside(ecefDeg(22.5, -22.5, 1e5))));
}

TEST(AddedTiles, ComeInSeveralThreads) {
    AddedGlobe globe;
    std::vector<std::thread> threads;
    for (std::size_t first = 0; first < 4; ++first) {
        threads.emplace_back([&globe, first] {
            for (std::size_t i = first; i < 32; i += 4) EXPECT_EQ(addTile(*globe.scene, *globe.leaves[i]), 1u);
        });
    }
    for (int i = 0; i < 50; ++i) (void)globe.drawsAntipode();
    for (std::thread& thread : threads) thread.join();
    for (const auto& tile : globe.leaves) globe.scene->addChild(tile);
    update(*globe.scene);
    EXPECT_EQ(findTiles(*globe.scene).size(), 0u) << "they are no tiles without an ellipsoid";
    EXPECT_TRUE(globe.draws(*globe.leaves[19], MeshGlobe::fromAbove()));
}

TEST(AddedTiles, FollowOtherOptionsAlsoOnTheirWay) {
    AddedGlobe globe(onEarth(declaredHorizon()));
    for (const auto& tile : globe.leaves) EXPECT_EQ(addTile(*globe.scene, *tile), 1u);
    (void)setCullOptions(*globe.scene, onEarth(by(Method::Sphere)));
    for (const auto& tile : globe.leaves) globe.scene->addChild(tile);
    (void)globe.drawsAntipode();
    update(*globe.scene);
    EXPECT_TRUE(globe.drawsAntipode());
}

TEST(AddedTiles, LeaveNothingBehindWhenTheyAreRemoved) {
    AddedGlobe globe(onEarth(declaredHorizon()));
    globe.addAll();
    (void)globe.drawsAntipode();
    update(*globe.scene);
    removeTile(*globe.scene, *globe.leaves[3]);
    EXPECT_EQ(globe.leaves[3]->getCullCallback(), nullptr);
    EXPECT_EQ(globe.leaves[3]->getComputeBoundingSphereCallback(), nullptr);
    EXPECT_EQ(globe.leaves[3]->getChild(0)->getCullCallback(), nullptr);
    globe.scene->removeChild(globe.leaves[3]);
    // siblings have other numbers for a frame
    EXPECT_TRUE(globe.draws(*globe.leaves[19], MeshGlobe::fromAbove()));
    update(*globe.scene);
    EXPECT_FALSE(globe.drawsAntipode());
    EXPECT_TRUE(globe.draws(*globe.leaves[19], MeshGlobe::fromAbove()));
    ASSERT_EQ(addTile(*globe.scene, *globe.leaves[3]), 1u) << "again";
}

// Both have the same name, none, and the first is above the heights that are declared.
TEST(AddedTiles, HaveBinsOfTheirOwnWhateverIsFoundOfOthers) {
    AddedGlobe globe;
    const osg::ref_ptr<osg::Group> high = makeGroup({makeMeshTile(extentsDeg(0, 10, 0, 10), 1.5e4)});
    EXPECT_EQ(addTile(*globe.scene, *high), 1u);
    EXPECT_EQ(addTile(*globe.scene, *globe.leaves[3]), 1u);
    EXPECT_LT(installedOn(*globe.leaves[3]->getChild(0))->getBin().bin().altitude().upper, 1.4e4);
}

TEST(AddedTiles, StandInTheFrameOfTheirParent) {
    AddedGlobe globe(onEarth(declaredHorizon()));
    const osg::Matrixd half = osg::Matrixd::rotate(osg::PI, osg::Vec3d(0, 0, 1));
    EXPECT_EQ(addTile(*globe.scene, *globe.leaves[15], half), 1u);
    globe.scene->addChild(makeTransform(half, {globe.leaves[15]}));
    update(*globe.scene);
    EXPECT_FALSE(globe.drawsAntipode() != globe.draws(*globe.leaves[15], MeshGlobe::fromAbove()));
    // tile 15 is south of the equator, east of 135 degrees: turned, east of 45 degrees west
    EXPECT_TRUE(globe.draws(*globe.leaves[15], downTo(-22.5, -22.5)));
    EXPECT_FALSE(globe.draws(*globe.leaves[15], downTo(-22.5, 157.5)));
}

TEST(AddedTiles, AreRefusedWhereThereIsNoDatabase) {
    AddedGlobe globe;
    EXPECT_EQ(addTile(*makeGroup({}), *globe.leaves[0]), 0u);
    globe.scene->addChild(globe.leaves[0]);
    EXPECT_EQ(addTile(*globe.scene, *globe.leaves[0]), 0u) << "a cull traversal may be in it";
    EXPECT_EQ(globe.leaves[0]->getChild(0)->getCullCallback(), nullptr);
}

// What SimGear makes of a file: a transform with a group of that name, and objects.
struct NamedGround {
    NamedGround() {
        ground->setName("BTGTerrainGroup");
        ground->addChild(makeMeshTile(extentsDeg(0, 10, 0, 10), 0.0));
        tile->addChild(ground);
        tile->addChild(tower);
        const osg::ref_ptr<osg::LOD> lod = new osg::LOD;
        lod->addChild(tile, 0.0f, 1e9f);
        content->addChild(lod);
    }

    osg::ref_ptr<osg::Group> content = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> tile = new osg::MatrixTransform;
    osg::ref_ptr<osg::Group> ground = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> tower = makeTower(ecefDeg(5, 5, 1e5), 1000.0f);
};

TEST(NamedGround, AloneHasABin) {
    NamedGround named;
    AddedGlobe globe(onEarth(optionsOf("ground=BTGTerrainGroup")));
    ASSERT_EQ(addTile(*globe.scene, *named.content), 1u);
    ASSERT_TRUE(installedOn(*named.ground));
    globe.scene->addChild(named.content);
    update(*globe.scene);
    EXPECT_LT(installedOn(*named.ground)->getBin().bin().altitude().upper, 1000.0) << "the tower is in the bin";
    const CullView above = beside(ecefDeg(5, 5, 1e5));
    EXPECT_FALSE(globe.draws(*named.ground, above));
    EXPECT_TRUE(globe.draws(*named.tower, above));
    EXPECT_TRUE(globe.draws(*named.ground, downTo(5, 5)));
}

TEST(NamedGround, IsFoundInDatabases) {
    NamedGround named;
    const auto root = makeGlobe({named.content});
    EXPECT_EQ(installBins(*root), 0u);
    EXPECT_EQ(installBins(*root, optionsOf("ground=BTGTerrainGroup")), 1u);
    EXPECT_TRUE(installedOn(*named.ground));
    EXPECT_EQ(installBins(*root, optionsOf("ground=Ground")), 0u);
    EXPECT_FALSE(installedOn(*named.ground));
}

}  // namespace
}  // namespace osgAnalyticBin::test
