// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which files a view requests while several are missing. What is found of hidden tiles: TerrainOcclusionTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>

#include <set>
#include <support/Random.h>

namespace osgAnalyticBin::test {
namespace {

// Stands for the DatabasePager: notes which nodes ask for files.
struct NotedRequests : osg::NodeVisitor::DatabaseRequestHandler {
    void requestNodeFile(const std::string&, osg::NodePath& path, float, const osg::FrameStamp*,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced*) override {
        nodes.insert(path.back());
        if (!request) request = new osg::Referenced;
    }
    std::set<const osg::Node*> nodes;
};

// A view of two tiles from their common border. No other tile has finer tiles.
class TwoTiles {
public:
    TwoTiles(double firstLag, double secondLag) {
        _globe.visitor->setDatabaseRequestHandler(_requests);
        for (const auto& tile : _globe.tiles) setCutoff(*tile, 0.0);
        setCutoff(first(), kDistance / firstLag);
        setCutoff(second(), kDistance / secondLag);
        installBins(*_globe.root);
    }

    [[nodiscard]] osg::PagedLOD& first() const { return *_globe.tiles[19]; }
    [[nodiscard]] osg::PagedLOD& second() const { return *_globe.tiles[20]; }

    // The nodes whose requests reach the pager in a frame.
    std::set<const osg::Node*> requested(double time = 0.0) {
        // both at the same distance
        for (osg::PagedLOD* const tile : {&first(), &second()}) {
            tile->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
            tile->setCenter(kEye + osg::Vec3d(0, 0, kDistance));
        }
        _requests->nodes.clear();
        cull(*_globe.scene, CullView::lookAt(kEye, {0, 0, 0}, {0, 0, 1}, 120.0), *_globe.visitor, ++_globe.frame, time);
        return _requests->nodes;
    }

private:
    static constexpr double kDistance = 1e6;
    const osg::Vec3d kEye = ecefDeg(22.5, 0.0, 3e6);

    static void setCutoff(osg::PagedLOD& tile, double cutoff) {
        tile.setRange(0, static_cast<float>(cutoff), 1e10f);
        tile.setRange(1, 0.0f, static_cast<float>(cutoff));
    }

    MeshGlobe _globe;
    const osg::ref_ptr<NotedRequests> _requests = new NotedRequests;
};

using Nodes = std::set<const osg::Node*>;

TEST(RequestOrder, HoldsRequestsBackUntilWhatIsMoreUrgentIsLoaded) {
    TwoTiles tiles(0.1, 0.5);
    EXPECT_EQ(tiles.requested(), Nodes{&tiles.first()});
    EXPECT_EQ(tiles.requested(), Nodes{&tiles.first()});
    tiles.first().addChild(new osg::Group);
    EXPECT_EQ(tiles.requested(), Nodes{&tiles.second()});
    tiles.second().addChild(new osg::Group);
    EXPECT_TRUE(tiles.requested().empty());
}

TEST(RequestOrder, PassesOnWhatIsNearlyAsUrgent) {
    TwoTiles within(0.26, 0.5);
    EXPECT_EQ(within.requested(), (Nodes{&within.first(), &within.second()}));
    TwoTiles beyond(0.24, 0.5);
    EXPECT_EQ(beyond.requested(), Nodes{&beyond.first()});
}

TEST(RequestOrder, WaitsAQuarterOfASecondForAFile) {
    TwoTiles tiles(0.1, 0.5);
    EXPECT_EQ(tiles.requested(10.0), Nodes{&tiles.first()});
    EXPECT_EQ(tiles.requested(10.1), Nodes{&tiles.first()});
    EXPECT_EQ(tiles.requested(10.24), Nodes{&tiles.first()});
    EXPECT_EQ(tiles.requested(10.26), (Nodes{&tiles.first(), &tiles.second()}));
    EXPECT_EQ(tiles.requested(10.5), (Nodes{&tiles.first(), &tiles.second()}));
}

TEST(RequestOrder, LeavesPrioritiesOfTheApplicationAlone) {
    for (const float offset : {-3.0f, 3.0f}) {
        TwoTiles tiles(0.1, 0.5);
        tiles.second().setPriorityOffset(1, offset);
        EXPECT_EQ(tiles.requested(), (Nodes{&tiles.first(), &tiles.second()})) << offset;
    }
    TwoTiles tiles(0.1, 0.5);
    tiles.second().setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
    tiles.second().setRange(0, 0.0f, 10.0f);
    tiles.second().setRange(1, 10.0f, 1e10f);
    EXPECT_EQ(tiles.requested(), (Nodes{&tiles.first(), &tiles.second()}));
}

TEST(RequestOrder, PassesOnAtLeastOneRequest) {
    Random random(51);
    for (int i = 0; i < 100; ++i) {
        TwoTiles tiles(random.logUniform(1e-4, 1.0), random.logUniform(1e-4, 1.0));
        EXPECT_FALSE(tiles.requested().empty());
    }
}

}  // namespace
}  // namespace osgAnalyticBin::test
