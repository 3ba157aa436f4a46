// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// How long the DatabasePager keeps tiles that are out of view: its own rule, and CullOptions::expiry. The pager is
// OSG's; time is simulated.

#include "CountedReads.h"
#include "PagedFlight.h"

#include <osgAnalyticBin/InstallBins.h>

#include <gtest/gtest.h>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include <support/SyntheticDatabase.h>
#include <support/TemporaryFolder.h>

namespace osgAnalyticBin {
namespace {

using test::CullView;
using test::PagedFlight;

osg::ref_ptr<osg::PagedLOD> makePagedLod(std::initializer_list<const char*> files) {
    osg::ref_ptr<osg::PagedLOD> node = new osg::PagedLOD;
    node->addChild(new osg::Group, 1e6f, 1e10f);
    unsigned int child = 1;
    for (const char* file : files) node->setFileName(child++, file);
    setStoredBin(*node, AnalyticBin(core::GeodeticBin::fromDegrees({0, 10}, {0, 10}, {0, 100})));
    return node;
}

CullOptions withExpiry(double seconds, Method method = Method::Quadratic) {
    CullOptions options;
    options.expiry = seconds;
    options.method = method;
    return options;
}

TEST(PagingExpiry, IsRaisedOnPagedChildrenAndNeverLowered) {
    const auto node = makePagedLod({"finer.osgb", "finest.osgb"});
    node->setMinimumExpiryTime(2, 10.0);
    installBins(*node);
    EXPECT_EQ(node->getMinimumExpiryTime(0), 0.0);  // not paged
    EXPECT_EQ(node->getMinimumExpiryTime(1), 3.0);
    EXPECT_EQ(node->getMinimumExpiryTime(2), 10.0);
}

TEST(PagingExpiry, AnotherInstallationStartsFromWhatWasThereAtFirst) {
    const auto node = makePagedLod({"finer.osgb", "finest.osgb"});
    node->setMinimumExpiryTime(2, 1.0);
    for (const double seconds : {3.0, 8.0, 1.0, 0.5, 0.0}) {
        installBins(*node, withExpiry(seconds));
        EXPECT_EQ(node->getMinimumExpiryTime(1), seconds);
        EXPECT_EQ(node->getMinimumExpiryTime(2), std::max(seconds, 1.0));
    }
    installBins(*node, withExpiry(3.0));
    installBins(*node, withExpiry(3.0, Method::Sphere));
    EXPECT_EQ(node->getMinimumExpiryTime(1), 0.0);
    EXPECT_EQ(node->getMinimumExpiryTime(2), 1.0);
    const osg::UserDataContainer* values = node->getUserDataContainer();
    EXPECT_EQ(values->getNumUserObjects(), 1u);  // the stored bin
}

TEST(PagingExpiry, WhatTheUserSetsLaterStays) {
    const auto node = makePagedLod({"finer.osgb"});
    installBins(*node);
    node->setMinimumExpiryTime(1, 7.0);
    installBins(*node, withExpiry(3.0, Method::Sphere));
    EXPECT_EQ(node->getMinimumExpiryTime(1), 7.0);
}

TEST(PagingExpiry, SpheresKeepOsgsRule) {
    for (const Method method : {Method::Sphere, Method::None}) {
        const auto node = makePagedLod({"finer.osgb"});
        installBins(*node, withExpiry(3.0, method));
        EXPECT_EQ(node->getMinimumExpiryTime(1), 0.0);
    }
}

class TurningTheHead : public ::testing::Test {
protected:
    void SetUp() override {
        const std::string file = test::writeSyntheticDatabase(_folder.path());
        ASSERT_FALSE(file.empty());
        _scene = osgDB::readRefNodeFile(file);
        ASSERT_TRUE(_scene);
        osgDB::Registry::instance()->setReadFileCallback(_reads);
    }
    void TearDown() override { osgDB::Registry::instance()->setReadFileCallback(nullptr); }

    // 300 km above the equator, looking down at 45 degrees to the east or west.
    static CullView look(double side) {
        const osg::Vec3d eye(6378137.0 + 300e3, 0.0, 0.0);
        return CullView::lookAt(eye, eye + osg::Vec3d(-1.0, side, 0.0), osg::Vec3d(1.0, 0.0, 0.0), 40.0);
    }

    test::TemporaryFolder _folder;
    osg::ref_ptr<osg::Node> _scene;
    osg::ref_ptr<test::CountedReads> _reads = new test::CountedReads;
};

// Fewer than the scene has at first, so that the pager drops whatever it may.
constexpr unsigned int kSmallTarget = 10;
constexpr int kFramesOfNearlyTwoSeconds = 118;
constexpr int kFramesOfFourSeconds = 240;

TEST_F(TurningTheHead, AndBackWithinTwoSecondsReadsNothingAgain) {
    installBins(*_scene);
    PagedFlight flight(*_scene, kSmallTarget);
    ASSERT_TRUE(flight.load(look(+1)));
    const std::size_t files = _reads->counts().size();
    ASSERT_GT(files, 2u);
    flight.frames(look(-1), kFramesOfNearlyTwoSeconds);
    EXPECT_GT(_reads->counts().size(), files);
    ASSERT_TRUE(flight.load(look(+1)));
    EXPECT_EQ(_reads->most(), 1);
}

TEST_F(TurningTheHead, WithOsgsOwnRuleReadsFilesAgain) {
    installBins(*_scene, withExpiry(0.0));
    PagedFlight flight(*_scene, kSmallTarget);
    ASSERT_TRUE(flight.load(look(+1)));
    flight.frames(look(-1), kFramesOfNearlyTwoSeconds);
    ASSERT_TRUE(flight.load(look(+1)));
    EXPECT_GT(_reads->most(), 1);
}

TEST_F(TurningTheHead, AndNotBackLetsTilesExpire) {
    installBins(*_scene);
    PagedFlight flight(*_scene, kSmallTarget);
    ASSERT_TRUE(flight.load(look(+1)));
    ASSERT_TRUE(flight.load(look(-1)));
    const std::size_t both = test::loadedTiles(*_scene);
    flight.frames(look(-1), kFramesOfFourSeconds);
    const std::size_t kept = test::loadedTiles(*_scene);
    EXPECT_LT(kept, both);

    // What is left is what this view needs by itself.
    osg::ref_ptr<osg::Node> fresh = osgDB::readRefNodeFile(_folder / "globe.osgb");
    installBins(*fresh);
    PagedFlight alone(*fresh, kSmallTarget);
    ASSERT_TRUE(alone.load(look(-1)));
    EXPECT_EQ(kept, test::loadedTiles(*fresh));
    EXPECT_EQ(flight.drawn(), alone.drawn());
}

}  // namespace
}  // namespace osgAnalyticBin
