// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Tiles below a tree of plain groups: the search for the lowest surface passes over groups out of view. And the records
// of tiles that they go by, which pager threads and cull threads doubt while the update traversal makes families.

#include "../../../osgAnalyticBin/src/kit/CallbackChain.h"
#include "../../../osgAnalyticBin/src/kit/cull/TileFamily.h"
#include "../../../osgAnalyticBin/src/kit/tile/InstalledTile.h"
#include "KitTest.h"

#include <atomic>

namespace osgAnalyticBin::test {
namespace {

// 32 tiles of 45 degrees in groups of four, and these in two groups.
struct GroupTree : MeshGlobe {
    explicit GroupTree(double altitude = 0.0) : MeshGlobe(altitude) {
        root->removeChildren(0, root->getNumChildren());
        for (int half = 0; half < 2; ++half) {
            halves.push_back(new osg::Group);
            root->addChild(halves.back());
            for (unsigned int i = 0; i < 4; ++i) {
                groups.push_back(new osg::Group);
                halves.back()->addChild(groups.back());
            }
        }
        for (unsigned int i = 0; i < 32; ++i) groups[i / 16 * 4 + i % 8 / 2]->addChild(tiles[i]);
    }

    // Returns: nullptr where the search does not pass over the group.
    [[nodiscard]] const ColumnUnion* columnsBelow(osg::Group& group) const {
        (void)root->getBound();
        return TileFamily::columnUnionOf(group);
    }

    std::vector<osg::ref_ptr<osg::Group>> halves, groups;
};

AnalyticBinCullCallback& binOf(osg::Node& tile) {
    return *findCallback<AnalyticBinCullCallback>(tile.getCullCallback());
}

void expectHeld(const ColumnUnion& columns, const AnalyticBin& bin) {
    const double reach = columns.sphere().radius() * (1.0 + 1e-9);
    const core::GeodeticBin& box = bin.bin();
    for (const double latitude : {box.latitude().lower, box.latitude().middle(), box.latitude().upper}) {
        for (const double longitude : {box.longitude().lower, box.longitude().middle(), box.longitude().upper}) {
            for (const double altitude : {box.altitude().lower, box.altitude().upper, 0.0}) {
                const osg::Vec3d point = osgVector(earth().toEcef({latitude, longitude, altitude}));
                EXPECT_LE((point - columns.sphere().center()).length(), reach);
            }
        }
    }
}

TEST(GroupTree, HoldsTheColumnsOfAllTiles) {
    for (const double altitude : {-9000.0, 0.0, 3000.0}) {
        GroupTree tree(altitude);
        ASSERT_EQ(installBins(*tree.root), 32u);
        for (unsigned int i = 0; i < 32; ++i) {
            const AnalyticBin bin = binOf(*tree.tiles[i]).getBin();
            for (osg::Group* const group : {tree.halves[i / 16].get(), tree.tiles[i]->getParent(0)}) {
                ASSERT_TRUE(tree.columnsBelow(*group));
                expectHeld(*tree.columnsBelow(*group), bin);
            }
        }
    }
}

TEST(GroupTree, FollowsBinsThatGrow) {
    GroupTree tree;
    ASSERT_EQ(installBins(*tree.root), 32u);
    ASSERT_TRUE(tree.columnsBelow(*tree.halves[0]));
    AnalyticBinCullCallback& callback = binOf(*tree.tiles[3]);
    AnalyticBin wide = callback.getBin();
    wide.expandBy(core::Geodetic{wide.bin().latitude().middle(), wide.bin().longitude().middle(), -2e6});
    callback.setBin(wide);
    ASSERT_TRUE(tree.columnsBelow(*tree.halves[0]));
    expectHeld(*tree.columnsBelow(*tree.halves[0]), wide);
    callback.setBin(AnalyticBin());
    EXPECT_FALSE(tree.columnsBelow(*tree.halves[0]));
    EXPECT_TRUE(tree.columnsBelow(*tree.halves[1]));
}

TEST(GroupTree, DoubtsWhatIsKeptVisible) {
    GroupTree tree;
    ASSERT_EQ(installBins(*tree.root), 32u);
    // high in the air, until the next update widens the bin
    tree.tiles[3]->insertChild(0, makeTower(ecefDeg(-70, -30, 50000.0)));
    EXPECT_FALSE(tree.columnsBelow(*tree.halves[0]));
    EXPECT_TRUE(tree.columnsBelow(*tree.halves[1]));
    update(*tree.root);
    ASSERT_TRUE(tree.columnsBelow(*tree.halves[0]));
    expectHeld(*tree.columnsBelow(*tree.halves[0]), binOf(*tree.tiles[3]).getBin());
}

TEST(GroupTree, DoubtsChildrenThatItDoesNotKnow) {
    const auto change = [](int what, osg::Group& group) {
        const osg::ref_ptr<osg::Node> added = what < 2 ? new osg::Group : makeMeshTile(extentsDeg(0, 10, 0, 10), 0.0);
        if (what % 2 == 0) group.addChild(added);
        if (what % 2 == 1) group.setChild(0, added);
    };
    for (int what = 0; what < 4; ++what) {
        for (const bool isDeep : {false, true}) {
            GroupTree tree;
            ASSERT_EQ(installBins(*tree.root), 32u);
            ASSERT_TRUE(tree.columnsBelow(*tree.halves[0]));
            change(what, isDeep ? *tree.groups[1] : *tree.halves[0]);
            EXPECT_FALSE(tree.columnsBelow(*tree.halves[0])) << what << isDeep;
            EXPECT_TRUE(tree.columnsBelow(*tree.halves[1]));
        }
    }
}

TEST(GroupTree, TrustsAFamilyThatWasMadeAnew) {
    GroupTree tree;
    ASSERT_EQ(installBins(*tree.root), 32u);
    TileFamily::renew(*tree.groups[1]);
    ASSERT_TRUE(tree.columnsBelow(*tree.halves[0]));
    binOf(*tree.groups[1]->getChild(0)).setBin(AnalyticBin());
    EXPECT_FALSE(tree.columnsBelow(*tree.halves[0]));
}

TEST(GroupTree, DoubtsAGroupWithoutItsWatch) {
    GroupTree tree;
    ASSERT_EQ(installBins(*tree.root), 32u);
    removeBins(*tree.groups[1]);
    EXPECT_FALSE(tree.columnsBelow(*tree.halves[0]));
}

class InstalledTiles : public ::testing::Test {
protected:
    InstalledTiles() {
        join();
        _other = std::thread([this] {
            while (!_isOver.load()) {
                tile->doubt(InstalledTile::MeshUnread);
                tile->settle(InstalledTile::MeshUnread);
            }
        });
    }
    ~InstalledTiles() override {
        _isOver.store(true);
        _other.join();
    }

    void join() {
        block = new TileBlock(1);
        tile->joinFamily(*block, 0);
        tile->fillSlot({}, {});
    }
    [[nodiscard]] bool isBelieved() const { return block->partFrom(0).believed.load() != 0; }

    const osg::ref_ptr<InstalledDatabase> database = new InstalledDatabase(new osg::EllipsoidModel);
    const osg::ref_ptr<InstalledTile> tile = new InstalledTile(*database, nullptr, "", 0);
    osg::ref_ptr<TileBlock> block;

private:
    std::atomic<bool> _isOver{false};
    std::thread _other;
};

TEST_F(InstalledTiles, AreNotBelievedWhileTheyAreDoubtedWhateverElseIsSettled) {
    int believed = 0;
    for (int i = 0; i < 20000; ++i) {
        tile->doubt(InstalledTile::Outgrown);
        for (int look = 0; look < 8; ++look) believed += isBelieved() ? 1 : 0;
        tile->settle(InstalledTile::Outgrown);
    }
    EXPECT_EQ(believed, 0);
}

TEST_F(InstalledTiles, AreDoubtedWhileTheirFamiliesAreMadeAnew) {
    for (int i = 0; i < 20000; ++i) join();
}

}  // namespace
}  // namespace osgAnalyticBin::test
