// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Files that cannot be read: when they are tried again, in simulated time and through a real pager. How servers fail is
// tested in http/.

#include "../../../osgAnalyticBin/src/kit/database/FailedReads.h"
#include "CountedReads.h"
#include "KitTest.h"
#include "PagedFlight.h"

namespace osgAnalyticBin::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

const FailedReads::Clock::time_point kStart;

TEST(FailedReads, WaitsDoubleFromOneSecondToTen) {
    FailedReads failures;
    auto now = kStart;
    for (const int seconds : {1, 2, 4, 8, 10, 10, 10}) {
        failures.note("bad", false, now);
        const auto next = now + std::chrono::seconds(seconds);
        EXPECT_FALSE(failures.mayRead("bad", next - milliseconds(1)));
        EXPECT_TRUE(failures.mayRead("bad", next));
        EXPECT_TRUE(failures.mayRead("other", now));
        now = next;
    }
}

TEST(FailedReads, SuccessForgetsEarlierFailures) {
    FailedReads failures;
    failures.note("late", false, kStart);
    failures.note("late", false, kStart);
    failures.note("late", true, kStart);
    EXPECT_TRUE(failures.mayRead("late", kStart));
    failures.note("late", false, kStart);
    EXPECT_TRUE(failures.mayRead("late", kStart + FailedReads::kFirstWait));
}

class MissingTiles : public ::testing::Test {
protected:
    void SetUp() override {
        _scene = osgDB::readRefNodeFile(writeSyntheticDatabase(_folder.path()));
        ASSERT_TRUE(_scene);
        fs::create_directory(_folder / "away");
        for (const auto& entry : fs::directory_iterator(_folder.path())) {
            const std::string name = entry.path().filename().string();
            if (name.rfind("tiles_", 0) == 0) fs::rename(entry.path(), fs::path(_folder / "away") / name);
        }
        osgDB::Registry::instance()->setReadFileCallback(_attempts);
    }
    void TearDown() override { osgDB::Registry::instance()->setReadFileCallback(nullptr); }

    void bringFilesBack() const {
        for (const auto& entry : fs::directory_iterator(_folder / "away"))
            fs::copy(entry.path(), _folder / entry.path().filename().string());
    }

    TemporaryFolder _folder;
    osg::ref_ptr<osg::Node> _scene;
    osg::ref_ptr<CountedReads> _attempts = new CountedReads;
    const CullView _view = CullView::lookAt({6.7e6, 0, 0}, {0, 0, 0}, {0, 0, 1}, 40.0);
};

constexpr int kFrames = 100;

TEST_F(MissingTiles, AreNotLookedForInEveryFrameAndAppearWhenTheyAreThere) {
    installBins(*_scene);
    PagedFlight flight(*_scene);
    flight.frames(_view, kFrames);
    EXPECT_GT(_attempts->most(), 0);
    EXPECT_LT(_attempts->most(), 5);
    EXPECT_FALSE(flight.drawn().empty());  // the coarse tiles
    const std::multiset<std::string> coarse = flight.drawn();
    bringFilesBack();
    ASSERT_TRUE(flight.load(_view));
    EXPECT_NE(flight.drawn(), coarse);
    const osg::ref_ptr<osg::Node> whole = osgDB::readRefNodeFile(_folder / "globe.osgb");
    installBins(*whole);
    PagedFlight unhurt(*whole);
    ASSERT_TRUE(unhurt.load(_view));
    EXPECT_EQ(flight.drawn(), unhurt.drawn());
}

// What keeps a viewer awake that draws on demand: osgViewer::Scene::requiresUpdateSceneGraph().
bool needsFrames(const osg::Node& scene) {
    return scene.getUpdateCallback() || scene.getNumChildrenRequiringUpdateTraversal() > 0;
}

TEST_F(MissingTiles, LetAViewerRestThatDrawsOnDemand) {
    ASSERT_TRUE(needsFrames(*_scene)) << "a request to install bins";
    PagedFlight flight(*_scene);
    flight.frames(_view, 4);
    EXPECT_FALSE(needsFrames(*_scene));
    EXPECT_GT(_attempts->most(), 0);
    bringFilesBack();
    ASSERT_TRUE(flight.load(_view));
    flight.frames(_view, 3);
    EXPECT_FALSE(needsFrames(*_scene));
    // the options are still those of the database
    EXPECT_NE(dynamic_cast<InstallBinsCallback*>(_scene->getEventCallback()), nullptr);
}

// An osgTerrain::Terrain itself asks for updates always.
TEST_F(MissingTiles, LetAViewerRestUntilThereIsWork) {
    _scene->setUpdateCallback(nullptr);
    const osg::ref_ptr<osgTerrain::Terrain> terrain = new osgTerrain::Terrain;
    while (_scene->asGroup()->getNumChildren() > 0) {
        terrain->addChild(_scene->asGroup()->getChild(0));
        _scene->asGroup()->removeChild(0u);
    }
    terrain->setEllipsoidModel(new osg::EllipsoidModel);
    installBins(*terrain);
    PagedFlight flight(*terrain);
    flight.frames(_view, 3);
    EXPECT_EQ(terrain->getUpdateCallback(), nullptr);
    terrain->setVerticalScale(2.0F);
    flight.frame(_view);
    EXPECT_NE(terrain->getUpdateCallback(), nullptr) << "to fit bins to the shape";
    flight.frames(_view, 2);
    EXPECT_EQ(terrain->getUpdateCallback(), nullptr);
}

}  // namespace
}  // namespace osgAnalyticBin::test
