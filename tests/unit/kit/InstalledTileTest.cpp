// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// The record of a tile, which pager threads and cull threads doubt while the update traversal makes families.

#include "../../../osgAnalyticBin/src/kit/tile/InstalledTile.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace osgAnalyticBin {
namespace {

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
    for (int i = 0; i < 50000; ++i) {
        tile->doubt(InstalledTile::Outgrown);
        for (int look = 0; look < 8; ++look) believed += isBelieved() ? 1 : 0;
        tile->settle(InstalledTile::Outgrown);
    }
    EXPECT_EQ(believed, 0);
}

TEST_F(InstalledTiles, AreDoubtedWhileTheirFamiliesAreMadeAnew) {
    for (int i = 0; i < 50000; ++i) join();
}

}  // namespace
}  // namespace osgAnalyticBin
