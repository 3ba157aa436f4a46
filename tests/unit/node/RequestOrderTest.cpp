// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Which files a view requests while several are missing. What is found of hidden tiles: TerrainOcclusionTest.cpp.

#include "ApplicationGlobe.h"
#include "CullFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>

#include <cstddef>
#include <ostream>
#include <set>
#include <vector>

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

// A view of six tiles: five of one lag, as many as are passed on in any case and one more, and one of another lag. No
// other tile has finer tiles.
class SixTiles {
public:
    SixTiles(double lagOfFive, double lagOfOne) {
        _globe.visitor->setDatabaseRequestHandler(_requests);
        for (const auto& tile : _globe.tiles) setCutoff(*tile, 0.0);
        for (osg::PagedLOD* const tile : five()) setCutoff(*tile, kDistance / lagOfFive);
        setCutoff(one(), kDistance / lagOfOne);
        installBins(*_globe.root);
    }

    [[nodiscard]] std::vector<osg::PagedLOD*> five() const {
        std::vector<osg::PagedLOD*> tiles;
        for (const std::size_t i : {11u, 12u, 19u, 27u, 28u}) tiles.push_back(_globe.tiles[i]);
        return tiles;
    }
    [[nodiscard]] osg::PagedLOD& one() const { return *_globe.tiles[20]; }

    // How many requests of the five, and of the one, reach the pager in a frame.
    struct Passed {
        std::size_t ofFive, ofOne;
        bool operator==(const Passed& other) const { return ofFive == other.ofFive && ofOne == other.ofOne; }
        friend std::ostream& operator<<(std::ostream& output, const Passed& passed) {
            return output << passed.ofFive << " and " << passed.ofOne;
        }
    };
    Passed passed(double time = 0.0) {
        for (const auto& tile : _globe.tiles) {
            tile->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
            tile->setCenter(kEye + osg::Vec3d(0, 0, kDistance));
        }
        _requests->nodes.clear();
        cull(*_globe.scene, CullView::lookAt(kEye, {0, 0, 0}, {0, 0, 1}, 120.0), *_globe.visitor, ++_globe.frame, time);
        const std::size_t ofOne = _requests->nodes.count(&one());
        return {_requests->nodes.size() - ofOne, ofOne};
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

using Passed = SixTiles::Passed;

TEST(RequestOrder, HoldsRequestsBackUntilWhatIsMoreUrgentIsLoaded) {
    SixTiles tiles(0.1, 0.5);
    EXPECT_EQ(tiles.passed(), (Passed{5, 0}));
    EXPECT_EQ(tiles.passed(), (Passed{5, 0}));
    for (osg::PagedLOD* const tile : tiles.five()) tile->addChild(new osg::Group);
    EXPECT_EQ(tiles.passed(), (Passed{0, 1}));
    tiles.one().addChild(new osg::Group);
    EXPECT_EQ(tiles.passed(), (Passed{0, 0}));
}

TEST(RequestOrder, PassesOnWhatIsNearlyAsUrgent) {
    EXPECT_EQ(SixTiles(0.26, 0.5).passed(), (Passed{5, 1}));
    EXPECT_EQ(SixTiles(0.24, 0.5).passed(), (Passed{5, 0}));
}

TEST(RequestOrder, PassesOnFourInAnyCase) {
    EXPECT_EQ(SixTiles(0.5, 0.1).passed(), (Passed{3, 1}));
    SixTiles tiles(0.1, 0.5);
    tiles.five().front()->addChild(new osg::Group);
    EXPECT_EQ(tiles.passed(), (Passed{4, 0}));
    tiles.five().back()->addChild(new osg::Group);
    EXPECT_EQ(tiles.passed(), (Passed{3, 1}));
}

TEST(RequestOrder, WaitsAQuarterOfASecondForAFile) {
    SixTiles tiles(0.1, 0.5);
    for (const double time : {10.0, 10.1, 10.24}) EXPECT_EQ(tiles.passed(time), (Passed{5, 0})) << time;
    for (const double time : {10.26, 10.5}) EXPECT_EQ(tiles.passed(time), (Passed{5, 1})) << time;
}

TEST(RequestOrder, LeavesPrioritiesOfTheApplicationAlone) {
    for (const float offset : {-3.0f, 3.0f}) {
        SixTiles tiles(0.1, 0.5);
        tiles.one().setPriorityOffset(1, offset);
        EXPECT_EQ(tiles.passed(), (Passed{5, 1})) << offset;
    }
    SixTiles tiles(0.1, 0.5);
    tiles.one().setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
    tiles.one().setRange(0, 0.0f, 10.0f);
    tiles.one().setRange(1, 10.0f, 1e10f);
    EXPECT_EQ(tiles.passed(), (Passed{5, 1}));
}

}  // namespace
}  // namespace osgAnalyticBin::test
