// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// Everything that the kit allows while a database is shown, in all of osgViewer's threading models, with a live
// DatabasePager. Built with the thread sanitizer (preset tsan) this fails on data races; without, on crashes, hangs and
// tiles that never come. Needs a display; skipped where no graphics context can be made.

#include "Handlers.h"
#include "ViewerRig.h"

#include <osgAnalyticBin/InstallBins.h>
#include <osgAnalyticBin/viewer/BinStatsHandler.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <gtest/gtest.h>
#include <osgUtil/SceneView>
#include <osgUtil/UpdateVisitor>
#include <osgViewer/Renderer>
#include <osgViewer/ViewerEventHandlers>

#include <chrono>
#include <kit/DatabaseFixture.h>
#include <support/CapturedNotes.h>
#include <support/Random.h>
#include <support/TemporaryFolder.h>
#include <thread>
#include <tuple>

namespace osgAnalyticBin::test {
namespace {

constexpr int kFrames = 24;  // each method once
constexpr double kFrameTime = 0.05;

// Tiles that bins culled in the last frame, over all cameras.
unsigned int culledBy(const std::vector<osg::Camera*>& cameras) {
    unsigned int outside = 0;
    for (osg::Camera* camera : cameras) {
        auto* renderer = dynamic_cast<osgViewer::Renderer*>(camera->getRenderer());
        for (unsigned int i = 0; renderer && i < 2; ++i) {
            const BinStatistics* statistics = BinStatistics::find(*renderer->getSceneView(i)->getCullVisitor());
            if (statistics) outside += statistics->getCounts().outside;
        }
    }
    return outside;
}

CullOptions optionsWith(Method method, HorizonUse horizonUse = HorizonUse::Declared) {
    CullOptions options;
    options.method = method;
    options.horizonUse = horizonUse;
    options.horizon = -130000.0;
    options.expiry = 0.1;
    options.occlusion = OcclusionUse::On;
    return options;
}

void lookAround(ViewerRig& rig, Random& random) {
    const double altitude = random.logUniform(2e5, 2e7);
    rig.look(viewFrom(random.uniform(-80.0, 80.0), random.uniform(-180.0, 180.0), altitude, random.uniform(0.0, 360.0),
                      random.uniform(0.0, 70.0)));
}

// What an application may change between frames, one thing after the other.
class Changes {
public:
    Changes(ViewerRig& rig, osg::Group& scene)
        : _rig(rig),
          _scene(scene),
          _stats(new osgViewer::StatsHandler),
          _freeze(new viewer::FreezeCullHandler),
          _switch(new viewer::MethodSwitchHandler(optionsWith(Method::Quadratic))),
          _display(new viewer::BinDisplayHandler) {
        // not all: slabs of inner tiles are made by the same code, and take most of the time
        _display->setShown(viewer::BinDisplayHandler::Shown::Ends);
        rig.view().addEventHandler(new BinStatsHandler(*_stats));
        rig.view().addEventHandler(_display);
        rig.view().addEventHandler(_switch);
        rig.viewer().getViewerStats()->collectStats("frame_rate", true);
    }

    void make(int frame) {
        constexpr std::array<Method, 6> kMethods{Method::Quadratic, Method::Sphere, Method::Exact,
                                                 Method::None,      Method::Exact,  Method::Quadratic};
        const auto step = static_cast<std::size_t>(frame / 4);
        const CullOptions options =
            optionsWith(kMethods[step % kMethods.size()], step % 2 == 0 ? HorizonUse::Declared : HorizonUse::Given);
        if (frame % 8 == 3) setCullOptions(_scene, options);
        if (frame % 8 == 7) _switch->setMethod(_rig.view(), options.method);
        if (frame % 6 == 1) _freeze->setFrozen(_rig.view(), !_freeze->isFrozen());
        if (frame % 3 == 0) culled += culledBy(_rig.cameras());
    }

    void scaleTerrain(float scale) {
        for (unsigned int i = 0; i < _scene.getNumChildren(); ++i) {
            if (auto* terrain = dynamic_cast<osgTerrain::Terrain*>(_scene.getChild(i)))
                terrain->setVerticalScale(scale);
        }
    }

    unsigned int culled = 0;

private:
    ViewerRig& _rig;
    osg::Group& _scene;
    const osg::ref_ptr<osgViewer::StatsHandler> _stats;
    const osg::ref_ptr<viewer::FreezeCullHandler> _freeze;
    const osg::ref_ptr<viewer::MethodSwitchHandler> _switch;
    const osg::ref_ptr<viewer::BinDisplayHandler> _display;
};

osg::ref_ptr<osg::Group> readScene(const std::vector<std::string>& files) {
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    for (const std::string& file : files) {
        const osg::ref_ptr<osg::Node> database = osgDB::readRefNodeFile(file);
        if (!database) return nullptr;
        installBins(*database, optionsWith(Method::Quadratic), file);
        scene->addChild(database);
    }
    return scene;
}

// Flies over the scene while everything changes: PagedLODs are refined, and bins cull.
void fly(osg::Group& scene, Threading threading, Layout layout, int cameras) {
    ViewerRig rig(scene, threading, layout, cameras);
    rig.setMostPagedLods(8);
    Changes changes(rig, scene);
    Random random(900);
    std::size_t most = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        if (frame % 10 == 0) lookAround(rig, random);
        // OSG makes meshes of tiles in the update traversal; cull threads that find some without crash, bins or not
        if (frame % 5 == 2) changes.scaleTerrain(1.0f + static_cast<float>(frame % 3));
        rig.update(frame * kFrameTime);
        changes.make(frame);
        most = std::max(most, pagedIn(scene));
        rig.render();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_GT(most, 0u);
    EXPECT_GT(changes.culled, 0u);
}

using Parameters = std::tuple<Threading, Layout, int>;

std::string caseName(const testing::TestParamInfo<Parameters>& info) {
    const auto& [threading, layout, cameras] = info.param;
    return std::string(nameOf(threading)) + (layout == Layout::Views ? "Views" : "Slaves") + std::to_string(cameras);
}

class Threads : public testing::TestWithParam<Parameters> {};

TEST_P(Threads, ChangeEverythingWhilePagingIsLive) {
    if (!ViewerRig::canDraw()) GTEST_SKIP() << "no graphics context";
    // written once
    static const TemporaryFolder folder;
    static const std::vector<std::string> databases{writeFalseDatabase(folder.makeFolder("false")),
                                                    writeTerrainDatabase(folder.makeFolder("terrain"))};
    const osg::ref_ptr<osg::Group> scene = readScene(databases);
    ASSERT_TRUE(scene);
    const auto& [threading, layout, cameras] = GetParam();
    fly(*scene, threading, layout, cameras);
}

// A single thread has no races. The soak flies in all models.
const auto kModels = testing::ValuesIn(std::begin(kThreadingModels) + 1, std::end(kThreadingModels));

// Cameras with a thread each are many; with a thread for each context two show what there is to see.
INSTANTIATE_TEST_SUITE_P(Views, Threads,
                         testing::Values(Parameters{Threading::CullThreadPerCameraDrawThreadPerContext, Layout::Views,
                                                    4},
                                         Parameters{Threading::CullDrawThreadPerContext, Layout::Views, 2},
                                         Parameters{Threading::DrawThreadPerContext, Layout::Views, 2}),
                         caseName);
INSTANTIATE_TEST_SUITE_P(Slaves, Threads,
                         testing::Combine(kModels, testing::Values(Layout::Slaves), testing::Values(2)), caseName);

TEST(ThreadsOnVpb, ChangeEverythingWhilePagingIsLive) {
    if (!ViewerRig::canDraw()) GTEST_SKIP() << "no graphics context";
    const std::string folder = std::string(SAMPLE_DATA) + "/vpb/";
    const osg::ref_ptr<osg::Group> scene = readScene({folder + "terrain/earth.osgb", folder + "polygonal/earth.osgb"});
    if (!scene) GTEST_SKIP() << "no samples";
    fly(*scene, Threading::CullThreadPerCameraDrawThreadPerContext, Layout::Views, 2);
}

// A globe inside another has a database of its own, whose tiles widen the tiles of the outer one.
TEST(ThreadsOnNestedGlobes, WidenTheSameTileAtOnce) {
    const CapturedNotes notes;
    const TemporaryFolder folder;
    const core::GeodeticBin extents = extentsDeg(10, 30, 0, 40);
    const AnalyticBin claimed(extents.withAltitude({-40000.0, 300.0}), 1.0);
    const osg::ref_ptr<osg::PagedLOD> whole = makePaged(makeMeshTile(extents, 200.0), "inner.osgb", 1e9f);
    setStoredBin(*whole, claimed);
    const osg::ref_ptr<osg::Node> outer = makeGlobe({whole});
    ASSERT_TRUE(osgDB::writeNodeFile(*outer, folder / "outer.osgb"));
    ASSERT_TRUE(osgDB::writeNodeFile(*makeGlobe({makeMeshTile(extents, 7000.0)}), folder / "inner.osgb"));
    whole->setDatabasePath(folder / "");
    ASSERT_EQ(installBins(*outer), 1u);

    constexpr int kReaders = 4;
    constexpr int kReads = 8;
    std::array<osg::ref_ptr<osg::Node>, kReaders> contents;
    std::vector<std::thread> readers;
    for (auto& content : contents) {
        readers.emplace_back([&content, &whole] {
            for (int i = 0; i < kReads; ++i) content = readBelow(*whole);
        });
    }
    for (std::thread& reader : readers) reader.join();
    const osg::ref_ptr<osgUtil::UpdateVisitor> update = new osgUtil::UpdateVisitor;
    outer->accept(*update);
    EXPECT_GE(installedOn(*whole)->getBin().bin().altitude().upper, 6999.0);
    EXPECT_EQ(notes.count("larger than the bin"), 1u);
    // what was found is known where the tile is fitted anew
    EXPECT_EQ(setCullOptions(*outer, {}), 1u);
    EXPECT_GE(installedOn(*whole)->getBin().bin().altitude().upper, 6999.0);
}

}  // namespace
}  // namespace osgAnalyticBin::test
