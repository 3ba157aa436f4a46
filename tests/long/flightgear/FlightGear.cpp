// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT
//
// FlightGear's scenery as FlightGear shows it: tiles read by SimGear with materials and effects, each below a level of
// detail as the tile manager attaches it. The same nodes are drawn first as they are, then with bins: pictures,
// drawables and times of cull traversals are compared. Run it by run.sh.

#include "../../unit/kit/CullFixture.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/LOD>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgViewer/Viewer>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <simgear/debug/logstream.hxx>
#include <simgear/misc/ResourceManager.hxx>
#include <simgear/misc/sg_path.hxx>
#include <simgear/props/props.hxx>
#include <simgear/props/props_io.hxx>
#include <simgear/scene/material/EffectCullVisitor.hxx>
#include <simgear/scene/material/matlib.hxx>
#include <simgear/scene/model/ModelRegistry.hxx>
#include <simgear/scene/model/modellib.hxx>
#include <simgear/scene/tgdb/userdata.hxx>
#include <simgear/scene/util/SGReaderWriterOptions.hxx>
#include <simgear/structure/exception.hxx>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace osgAnalyticBin;
using Clock = std::chrono::steady_clock;

const std::string kRoot = "/usr/share/games/flightgear";
constexpr float kTileRange = 250000.0f;
constexpr int kWidth = 640, kHeight = 480;

struct Pose {
    const char* name;
    double latitude, longitude, altitude, heading, pitch;  // degrees, metres
    bool isIceland;
};

const std::vector<Pose> kPoses{{"Hilo, runway", 19.7203, -155.0485, 13.0, 80, 0, false},
                               {"Hilo, 100 m", 19.7203, -155.0485, 100.0, 260, -3, false},
                               {"Hilo, 300 m", 19.75, -155.1, 400.0, 225, -5, false},
                               {"Mauna Kea, 1 km above", 19.82, -155.47, 5200.0, 180, -10, false},
                               {"saddle, 200 m", 19.70, -155.45, 2300.0, 270, -2, false},
                               {"Kona, 1 km", 19.74, -156.05, 1000.0, 90, -5, false},
                               {"Hawaii, 3 km", 19.6, -155.9, 3000.0, 45, -15, false},
                               {"Hawaii, 10 km", 19.3, -156.2, 10000.0, 40, -20, false},
                               {"sea, 300 m", 20.0, -156.4, 300.0, 120, -2, false},
                               {"Hawaii, 200 km", 19.6, -155.5, 200000.0, 0, -90, false},
                               {"Keflavik, runway", 63.985, -22.6056, 60.0, 110, 0, true},
                               {"Keflavik, 100 m", 63.985, -22.65, 150.0, 90, -2, true},
                               {"Reykjavik, 300 m", 64.13, -21.94, 300.0, 20, -4, true},
                               {"fjord, 200 m", 65.95, -23.3, 300.0, 320, -2, true},
                               {"Snaefellsjokull, 1 km above", 64.8, -23.6, 2400.0, 260, -8, true},
                               {"Iceland, 3 km", 64.7, -22.6, 3000.0, 60, -10, true},
                               {"Iceland, 10 km", 64.3, -23.5, 10000.0, 45, -15, true},
                               {"sea, 100 m", 63.5, -22.5, 100.0, 0, 0, true},
                               {"Iceland, 200 km", 64.8, -22.0, 200000.0, 0, -90, true},
                               {"pole", 89.5, -18.0, 3000.0, 180, -5, true}};

// In a field of view of 45 degrees, upright.
test::CullView viewOf(const Pose& pose) {
    const osg::EllipsoidModel earth;
    osg::Matrixd toEcef;
    earth.computeLocalToWorldTransformFromLatLongHeight(osg::DegreesToRadians(pose.latitude),
                                                        osg::DegreesToRadians(pose.longitude), pose.altitude, toEcef);
    const double heading = osg::DegreesToRadians(pose.heading), pitch = osg::DegreesToRadians(pose.pitch);
    const osg::Vec3d ahead(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch), std::sin(pitch));
    const osg::Vec3d up(-std::sin(heading) * std::sin(pitch), -std::cos(heading) * std::sin(pitch), std::cos(pitch));
    const osg::Vec3d eye = toEcef.getTrans();
    test::CullView view;
    view.modelView.makeLookAt(eye, eye + osg::Matrixd::transform3x3(ahead, toEcef),
                              osg::Matrixd::transform3x3(up, toEcef));
    view.projection.makePerspective(45.0, double(kWidth) / kHeight, 1.0, 500000.0);
    return view;
}

// Begins SimGear as fgviewer does.
osg::ref_ptr<simgear::SGReaderWriterOptions> beginSimGear() {
    sglog().setLogLevels(SG_ALL, SG_ALERT);
    simgear::ResourceManager::instance()->addBasePath(SGPath(kRoot));
    SGPropertyNode_ptr properties = new SGPropertyNode;
    try {
        readProperties(SGPath(kRoot + "/defaults.xml"), properties);
    } catch (const sg_exception&) {
        // it names models of another package at its end
        properties->setStringValue("/sim/startup/season", "summer");
    }
    properties->setBoolValue("/sim/rendering/shaders/use-shaders", false);
    properties->setStringValue("/sim/fg-root", kRoot);
    sgUserDataInit(properties.get());
    simgear::SGModelLib::init(kRoot, properties);
    SGMaterialLibPtr materials = new SGMaterialLib;
    if (!materials->load(SGPath(kRoot), SGPath(kRoot + "/Materials/default/materials.xml"), properties))
        std::fprintf(stderr, "no materials\n");
    osg::ref_ptr<simgear::SGReaderWriterOptions> options = new simgear::SGReaderWriterOptions;
    options->getDatabasePathList().push_back(kRoot + "/Scenery");
    options->getDatabasePathList().push_back(kRoot);
    osgDB::Registry::instance()->getDataFilePathList() = options->getDatabasePathList();
    options->setSceneryPathSuffixes({"Terrain", "Objects"});
    options->setMaterialLib(materials);
    options->setPropertyNode(properties);
    options->setInstantiateEffects(true);
    options->setInstantiateMaterialEffects(true);
    options->setPluginStringData("SimGear::FG_ROOT", kRoot);
    options->setPluginStringData("SimGear::BOUNDINGVOLUMES", "OFF");
    return options;
}

struct Tile {
    osg::ref_ptr<osg::LOD> entry;
    osg::ref_ptr<osg::Node> content;
};

// All tiles of an island, each below the level of detail of a TileEntry.
std::vector<Tile> readTiles(const std::vector<std::string>& folders, const osgDB::Options& options, std::size_t most) {
    std::vector<std::filesystem::path> files;
    for (const std::string& folder : folders) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot + "/Scenery/Terrain/" + folder)) {
            if (entry.path().extension() == ".stg") files.push_back(entry.path().filename());
        }
    }
    std::sort(files.begin(), files.end());
    if (files.size() > most) files.resize(most);
    std::vector<Tile> tiles;
    for (const auto& file : files) {
        osg::ref_ptr<osg::Node> content = osgDB::readRefNodeFile(file.string(), &options);
        if (!content) continue;
        osg::ref_ptr<osg::LOD> entry = new osg::LOD;
        entry->addChild(content, 0.0f, kTileRange);
        tiles.push_back({entry, content});
    }
    return tiles;
}

// Each tile is taken off its entry meanwhile, as before its first frame.
void install(osg::Group& terrain, const std::vector<Tile>& tiles) {
    CullOptions culling;
    culling.globe.emplace(osg::WGS_84_RADIUS_EQUATOR, osg::WGS_84_RADIUS_POLAR);
    culling.ground = "BTGTerrainGroup";
    for (const Tile& tile : tiles) tile.entry->removeChild(tile.content);
    (void)installBins(terrain, culling);
    std::size_t installed = 0;
    const auto begin = Clock::now();
    for (const Tile& tile : tiles) installed += addTile(terrain, *tile.content);
    const double each = std::chrono::duration<double, std::micro>(Clock::now() - begin).count() / double(tiles.size());
    for (const Tile& tile : tiles) tile.entry->addChild(tile.content, 0.0f, kTileRange);
    std::fprintf(stderr, "%zu tiles, %zu bins, %.0f us each\n", tiles.size(), installed, each);
}

struct Measured {
    std::size_t drawn = 0;
    double microseconds = 0.0;
    osg::ref_ptr<osg::Image> picture;
};

class Flight {
public:
    explicit Flight(osg::Group& scene) : _scene(&scene) {
        _viewer.setUpViewInWindow(0, 0, kWidth, kHeight);
        _viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
        _viewer.getCamera()->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        _viewer.setSceneData(&scene);
        _viewer.realize();
        // effects choose their techniques by it
        osgViewer::Viewer::Contexts contexts;
        _viewer.getContexts(contexts);
        osg::RenderInfo info(contexts.at(0)->getState(), &_viewer);
        _visitor->setRenderInfo(info);
    }

    Measured at(const Pose& pose) {
        const test::CullView view = viewOf(pose);
        Measured measured;
        _viewer.getCamera()->setViewMatrix(view.modelView);
        _viewer.getCamera()->setProjectionMatrix(view.projection);
        settle();
        measured.picture = new osg::Image;
        _viewer.getCamera()->setFinalDrawCallback(new Capture(*measured.picture));
        frame();
        _viewer.getCamera()->setFinalDrawCallback(nullptr);
        std::vector<double> times;
        for (int i = 0; i < 60; ++i) {
            const auto begin = Clock::now();
            const test::CullResult result = test::cull(*_scene, view, *_visitor, ++_number);
            times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
            measured.drawn = result.drawn.size();
        }
        measured.microseconds = *std::min_element(times.begin(), times.end());
        return measured;
    }

private:
    struct Capture : osg::Camera::DrawCallback {
        explicit Capture(osg::Image& to) : image(&to) {}
        void operator()(osg::RenderInfo&) const override {
            image->readPixels(0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE);
        }
        osg::ref_ptr<osg::Image> image;
    };
    // Waits for objects that the pager reads.
    void settle() {
        constexpr int kMost = 300;
        for (int i = 0, quiet = 0; i < kMost && quiet < 3; ++i) {
            frame();
            quiet = _viewer.getDatabasePager()->getRequestsInProgress() ? 0 : quiet + 1;
            if (quiet == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }
    void frame() {
        // the same time in all frames: waves stand still
        _viewer.advance(0.0);
        _viewer.eventTraversal();
        _viewer.updateTraversal();
        _viewer.renderingTraversals();
    }

    osg::ref_ptr<osg::Group> _scene;
    osgViewer::Viewer _viewer;
    osg::ref_ptr<osgUtil::CullVisitor> _visitor = new simgear::EffectCullVisitor;
    unsigned int _number = 1000000;
};

std::size_t differing(const osg::Image* a, const osg::Image* b) {
    if (!a || !b) return 0;
    std::size_t pixels = 0;
    for (unsigned int y = 0; y < kHeight; ++y) {
        for (unsigned int x = 0; x < kWidth; ++x) pixels += std::memcmp(a->data(x, y), b->data(x, y), 3) != 0;
    }
    return pixels;
}

}  // namespace

int main(int argc, char** argv) {
    const bool isQuick = argc > 1 && std::strcmp(argv[1], "--quick") == 0;
    const std::size_t most = isQuick ? 60 : 1000000;
    osgUtil::CullVisitor::prototype() = new simgear::EffectCullVisitor;
    const auto options = beginSimGear();
    std::printf("pose | drawables | with bins | us | with bins | pixels differ without bins | with bins\n");
    double stockSum = 0.0, binsSum = 0.0;
    std::size_t failures = 0;
    for (const bool isIceland : {false, true}) {
        const std::vector<std::string> folders =
            isIceland ? std::vector<std::string>{"w030n60"} : std::vector<std::string>{"w160n10", "w160n20"};
        const std::vector<Tile> tiles = readTiles(folders, *options, most);
        const osg::ref_ptr<osg::Group> terrain = new osg::Group;
        for (const Tile& tile : tiles) terrain->addChild(tile.entry);
        Flight flight(*terrain);
        std::vector<Pose> poses;
        std::copy_if(kPoses.begin(), kPoses.end(), std::back_inserter(poses),
                     [&](const Pose& pose) { return pose.isIceland == isIceland; });
        std::vector<Measured> stock, again, bins;
        const auto fly = [&](std::vector<Measured>& flown) {
            std::vector<Measured> now;
            for (const Pose& pose : poses) now.push_back(flight.at(pose));
            for (std::size_t i = 0; i < flown.size(); ++i)
                now[i].microseconds = std::min(now[i].microseconds, flown[i].microseconds);
            flown = std::move(now);
        };
        for (const Pose& pose : poses) (void)flight.at(pose);
        fly(stock);
        again = stock;
        // other work on the machine comes and goes: each has several turns
        constexpr int kTurns = 3;
        for (int turn = 0; turn < kTurns; ++turn) {
            fly(again);
            install(*terrain, tiles);
            fly(bins);
            removeBins(*terrain);
        }
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const double without = again[i].microseconds;
            const std::size_t noise = differing(stock[i].picture, again[i].picture);
            const std::size_t wrong = differing(stock[i].picture, bins[i].picture);
            std::printf("%s | %zu | %zu | %.1f | %.1f | %zu | %zu\n", poses[i].name, stock[i].drawn, bins[i].drawn,
                        without, bins[i].microseconds, noise, wrong);
            std::fflush(stdout);
            stockSum += without;
            binsSum += bins[i].microseconds;
            failures += wrong > noise || bins[i].drawn > stock[i].drawn;
        }
    }
    std::printf("sum of times: %.0f us, with bins %.0f us, ratio %.3f\n", stockSum, binsSum, binsSum / stockSum);
    return failures == 0 ? 0 : 1;
}
