// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Flights over paged databases: that change how they are culled while they are shown (oracle: the same database, read
// anew with the method), and with files that cannot be read: when they are tried again, in simulated time and through a
// real pager. How servers fail is tested in http/.

#include "../../../osgAnalyticBin/src/kit/database/FailedReads.h"
#include "KitTest.h"
#include "PagedFlight.h"

#include <osg/Stats>

#include <cstdio>

namespace osgAnalyticBin::test {
namespace {

class SwitchedCulling : public ::testing::Test {
protected:
    void SetUp() override {
        _file = writeSyntheticDatabase(_folder.path());
        ASSERT_FALSE(_file.empty());
    }

    [[nodiscard]] osg::ref_ptr<osg::Node> read(Method method) const {
        osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(_file);
        installBins(*scene, by(method));
        return scene;
    }

    [[nodiscard]] std::multiset<std::string> drawnAfresh(Method method, const CullView& view) const {
        const osg::ref_ptr<osg::Node> scene = read(method);
        PagedFlight flight(*scene);
        EXPECT_TRUE(flight.load(view));
        return flight.drawn();
    }

    TemporaryFolder _folder;
    std::string _file;
};

TEST_F(SwitchedCulling, DrawsWhatTheMethodDrawsAfreshAlsoWhatIsPagedInLater) {
    const osg::ref_ptr<osg::Node> scene = read(Method::Quadratic);
    PagedFlight flight(*scene);
    ASSERT_TRUE(flight.load(lookDown(+1)));
    double side = -1.0;
    for (const Method method : {Method::Sphere, Method::None, Method::Exact, Method::Sphere, Method::Quadratic}) {
        setCullOptions(*scene, by(method));
        ASSERT_TRUE(flight.load(lookDown(-side)));
        EXPECT_EQ(flight.drawn(), drawnAfresh(method, lookDown(-side)))
            << methodName(method) << ", tiles loaded before";
        ASSERT_TRUE(flight.load(lookDown(side)));
        EXPECT_EQ(flight.drawn(), drawnAfresh(method, lookDown(side))) << methodName(method) << ", tiles loaded later";
        side = -side;
    }
}

/// Bins that take turns with stock OSG.
class ComparedCulling : public SwitchedCulling {
protected:
    static constexpr double kTurn = 2.0;  // seconds

    void SetUp() override {
        SwitchedCulling::SetUp();
        setenv("OSGANALYTICBIN_COMPARE", "2", 1);
        _scene = read(Method::Quadratic);
        unsetenv("OSGANALYTICBIN_COMPARE");
    }

    osg::ref_ptr<osg::Node> _scene;
};

TEST_F(ComparedCulling, DrawsInEachTurnWhatItsMethodDraws) {
    const auto bins = drawnAfresh(Method::Quadratic, lookDown(1)), spheres = drawnAfresh(Method::Sphere, lookDown(1));
    const CapturedNotes notices(osg::NOTICE);
    PagedFlight flight(*_scene);
    for (const bool isStock : {false, true, false, true}) {
        EXPECT_TRUE(flight.framesUntil(lookDown(1), [&] {
            const bool isItsTurn = (static_cast<int>(flight.time() / kTurn) % 2 == 1) == isStock;
            return isItsTurn && flight.drawn() == (isStock ? spheres : bins);
        })) << isStock;
    }
    int binTiles = 0, stockTiles = 0;
    double binMs = 0.0, stockMs = 0.0;
    ASSERT_EQ(
        std::sscanf(notices.text().c_str(),
                    "osgAnalyticBin: a view with bins %d tiles, cull %lf ms; with stock OSG %d tiles, cull %lf ms\n",
                    &binTiles, &binMs, &stockTiles, &stockMs),
        4)
        << notices.text();
    EXPECT_GT(binTiles, 0);
    EXPECT_LT(binTiles, stockTiles);
    EXPECT_GT(binMs, 0.0);
    EXPECT_GT(stockMs, 0.0);
}

TEST_F(ComparedCulling, IsInTheStatisticsOfEachCamera) {
    CullView view = lookDown(1);
    view.camera = new osg::Camera;
    view.camera->setStats(new osg::Stats("camera"));
    const osg::ref_ptr<osgUtil::CullVisitor> visitor = new osgUtil::CullVisitor;
    const std::size_t bins = cull(*_scene, view, *visitor, 1, 0.5 * kTurn).drawn.size();
    const std::size_t stock = cull(*_scene, view, *visitor, 2, 1.5 * kTurn).drawn.size();
    EXPECT_LT(bins, stock);
    const auto valueOf = [&](unsigned int frame, const std::string& name) {
        double value = -1.0;
        (void)view.camera->getStats()->getAttribute(frame, name, value);
        return value;
    };
    EXPECT_EQ(valueOf(1, "Bins tiles drawn"), static_cast<double>(bins));
    EXPECT_GT(valueOf(1, "Bins database cull ms"), 0.0);
    EXPECT_EQ(valueOf(2, "Stock OSG tiles drawn"), static_cast<double>(stock));
    EXPECT_GT(valueOf(2, "Stock OSG database cull ms"), 0.0);
    EXPECT_EQ(valueOf(2, "Bins tiles drawn"), -1.0) << "of the other turn";
}

TEST_F(SwitchedCulling, IsNotComparedByAMalformedVariable) {
    const auto bins = drawnAfresh(Method::Quadratic, lookDown(1));
    const CapturedNotes notices;
    for (const char* const text : {"soon", "-1", "nan", ""}) {
        setenv("OSGANALYTICBIN_COMPARE", text, 1);
        const osg::ref_ptr<osg::Node> scene = read(Method::Quadratic);
        PagedFlight flight(*scene);
        unsetenv("OSGANALYTICBIN_COMPARE");
        EXPECT_TRUE(flight.framesUntil(lookDown(1), [&] { return flight.time() > 1.0 && flight.drawn() == bins; }))
            << text;
    }
    EXPECT_EQ(notices.count("a view with bins"), 0u);
    EXPECT_EQ(notices.count("not a number of seconds"), 1u);
}

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
    for (const bool isRead : {false, false, true}) failures.note("late", isRead, kStart);
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

// As where the camera looks elsewhere.
TEST(UnseenDatabase, LetsAViewerRestThatDrawsOnDemand) {
    InstalledGlobe globe;
    for (int i = 0; i < 20; ++i) update(*globe.scene);
    EXPECT_FALSE(needsFrames(*globe.scene));
    globe.root->addChild(makePaged(makeMeshTile(extentsDeg(0, 1, 0, 1), 9000.0), "no.osgb"));
    (void)globe.drawsAntipode();
    EXPECT_TRUE(needsFrames(*globe.scene)) << "to give it a family";
    update(*globe.scene);
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
