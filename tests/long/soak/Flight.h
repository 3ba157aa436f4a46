// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "ViewerRig.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/InstallBins.h>

#include <osg/Group>
#include <osg/Image>
#include <osg/observer_ptr>
#include <osgDB/ReadFile>

#include <atomic>
#include <chrono>
#include <cstring>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <support/Random.h>
#include <thread>
#include <typeinfo>

namespace osgAnalyticBin::test {

inline constexpr double kFrameTime = 0.02;
inline constexpr unsigned int kMostPagedLods = 16;
inline constexpr std::size_t kStaying = 2;
inline constexpr std::size_t kMostDatabases = 4;

inline CullOptions defaultOptions() {
    CullOptions options;
    options.expiry = 0.1;
    options.index = IndexUse::On;  // what the thread that makes one takes would count as growth
    return options;
}

inline CullOptions randomOptions(Random& random) {
    constexpr std::array<Method, 4> kMethods{Method::Quadratic, Method::Exact, Method::None, Method::Sphere};
    constexpr std::array<HorizonUse, 3> kHorizons{HorizonUse::Declared, HorizonUse::Off, HorizonUse::Given};
    CullOptions options;
    options.method = random.pick(kMethods);
    options.horizonUse = random.pick(kHorizons);
    options.horizon = -130000.0;
    options.expiry = random.chance(0.5) ? 0.1 : 1.0;
    return options;
}

/// What a flight found at its end or on its way.
struct Findings {
    std::size_t frames = 0, stations = 0;
    std::size_t tilesLoaded = 0;  ///< PagedLODs that were seen with children in the frames that were looked at
    std::size_t differingPictures = 0, pictures = 0;
    std::size_t differingPixels = 0;
    std::size_t coveredPixels = 0;
    std::size_t strayObjects = 0;    ///< of the kit, alive at stations outside of the scene
    std::size_t undrainedTiles = 0;  ///< at stations, still loaded though out of view
    std::size_t unloaded = 0;        ///< stations at which the pager did not come to rest
};

/// The callbacks that the kit has put into a scene, told apart by address and observed until they are deleted. Not the
/// options that files are read with: OSG's PagedLODs keep those of their last request.
class KitObjects {
public:
    /// Looks for those in the scene. Returns: how many there are.
    std::size_t note(osg::Node& scene) {
        std::set<osg::Object*> found;
        visitNodes(scene, [&](osg::Node& node) {
            for (osg::Callback* at : {node.getCullCallback(), node.getUpdateCallback()})
                for (; at; at = at->getNestedCallback())
                    if (std::strstr(typeid(*at).name(), "osgAnalyticBin")) found.insert(at);
        });
        for (osg::Object* object : found) {
            osg::observer_ptr<osg::Object>& known = _known[object];
            if (!known.valid()) known = object;
        }
        return found.size();
    }

    /// The classes of all noted callbacks that are still alive.
    [[nodiscard]] std::multiset<std::string> alive() {
        std::multiset<std::string> classes;
        for (auto entry = _known.begin(); entry != _known.end();) {
            osg::ref_ptr<osg::Object> object;
            const bool isAlive = entry->second.lock(object);
            if (isAlive) classes.insert(object->className());
            entry = isAlive ? std::next(entry) : _known.erase(entry);
        }
        return classes;
    }

private:
    std::map<const osg::Object*, osg::observer_ptr<osg::Object>> _known;
};

/// Says what the main thread does from now on. Where it does not report again for 60 s, the process says on stderr what
/// it did last, prints its stack, and aborts.
void reportProgress(const std::string& what);

/// The last picture of each camera, taken in the threads that draw.
class Pictures {
public:
    explicit Pictures(const std::vector<osg::Camera*>& cameras) {
        for (osg::Camera* camera : cameras) {
            _readers.push_back(new Reader);
            camera->setFinalDrawCallback(_readers.back());
        }
    }

    /// Runs `draw`, which draws a frame, and waits for the pictures.
    template <class Draw>
    std::vector<osg::ref_ptr<osg::Image>> take(const Draw& draw) {
        std::vector<osg::ref_ptr<osg::Image>> images;
        for (const auto& reader : _readers) reader->isWanted = true;
        draw();
        for (const auto& reader : _readers) {
            while (reader->isWanted) std::this_thread::sleep_for(std::chrono::microseconds(200));
            images.push_back(static_cast<osg::Image*>(reader->image->clone(osg::CopyOp::DEEP_COPY_ALL)));
        }
        return images;
    }

private:
    class Reader : public osg::Camera::DrawCallback {
    public:
        void operator()(osg::RenderInfo& info) const override {
            if (!isWanted) return;
            const osg::Viewport& viewport = *info.getCurrentCamera()->getViewport();
            image->readPixels(int(viewport.x()), int(viewport.y()), int(viewport.width()), int(viewport.height()),
                              GL_RGBA, GL_UNSIGNED_BYTE);
            isWanted = false;
        }
        osg::ref_ptr<osg::Image> image = new osg::Image;
        mutable std::atomic<bool> isWanted{false};
    };

    std::vector<osg::ref_ptr<Reader>> _readers;
};

/// A viewer over databases, one of which stays to the end, flown at random while everything that may change does.
class Flight {
public:
    struct Setup {
        Threading threading;
        Layout layout;
        int cameras;
        bool withBins;
    };

    /// `databases`: files; the first two stay, copies of all come and go.
    Flight(const Setup& setup, const std::vector<std::string>& databases, Random& random, Findings& findings)
        : _setup(setup), _databases(databases), _random(random), _findings(findings) {
        report("makes a viewer");
        for (std::size_t i = 0; i < kStaying; ++i) addDatabase(_databases[i]);
        _rig = std::make_unique<ViewerRig>(*_scene, setup.threading, setup.layout, setup.cameras);
        _rig->setMostPagedLods(kMostPagedLods);
        // so that pictures can be compared
        for (osg::Camera* camera : _rig->cameras()) {
            camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
            camera->setProjectionMatrixAsPerspective(40.0, 1.0, 1e4, 1e8);
        }
        _pictures = std::make_unique<Pictures>(_rig->cameras());
        lookAround();
    }

    ~Flight() {
        report("destroys a viewer");
        _pictures.reset();
        _rig.reset();
    }

    /// Draws the most that the scene can ever hold, in every threading model: what OpenSceneGraph's visitors keep from
    /// frame to frame has its full size afterwards, and all that can be known of false databases is known.
    void warmUp() {
        report("draws everything at once");
        for (std::size_t i = kStaying; i < kMostDatabases; ++i) addDatabase(_databases.back());
        _rig->setMostPagedLods(100000);
        const osg::CullSettings::CullingMode mode = _rig->cameras().front()->getCullingMode();
        setCameras(osg::CullSettings::NO_CULLING, 0.0F);
        for (const Threading model : kThreadingModels) {
            _rig->viewer().setThreadingModel(model);
            if (!rest()) ++_findings.unloaded;
        }
        setCameras(mode, 1.0F);
        drain();
    }

    /// Flies that many frames; every change may happen in each.
    void fly(std::size_t frames) {
        if (_findings.stations > 0) changeThreads();
        for (std::size_t i = 0; i < frames; ++i) {
            frame();
            if (i % 16 != 0) continue;
            _findings.tilesLoaded += pagedIn(*_scene);
            _objects.note(*_scene);
        }
    }

    /// Compares the picture with that without culling, then returns to a state that is the same at every station: the
    /// databases that stay, default options, nothing paged in.
    void halt() {
        ++_findings.stations;
        if (_setup.withBins) {
            CullOptions options = defaultOptions();
            if (_random.chance(0.5)) options.method = Method::Exact;
            osgAnalyticBin::setCullOptions(*_scene, options);
        }
        comparePictures();
        drain();
        report("waits for the pager's thread to delete");
        constexpr int kMostRests = 100;
        const std::size_t inScene = _objects.note(*_scene);
        std::multiset<std::string> alive = _objects.alive();
        for (int i = 0; i < kMostRests && alive.size() > inScene; ++i) {
            (void)rest();
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            alive = _objects.alive();
        }
        if (alive.size() <= inScene) return;
        _findings.strayObjects += alive.size() - inScene;
        for (const std::string& name : alive) std::cerr << "alive, in the scene or not: " << name << std::endl;
    }

private:
    void frame() {
        ++_findings.frames;
        _time += kFrameTime;
        if (_random.chance(0.01)) changeDatabases();
        report("updates");
        _rig->update(_time);
        change();
        report("culls and draws");
        _rig->render();
    }

    void change() {
        if (_random.chance(0.01)) lookAround();
        _latitude = std::clamp(_latitude + _random.uniform(-0.5, 0.5), -89.0, 89.0);
        _longitude += _random.uniform(-0.5, 0.5);
        _heading += _random.uniform(-4.0, 4.0);
        _rig->look(viewFrom(_latitude, _longitude, _altitude, _heading, _pitch));
        if (_random.chance(0.02)) changeOptions();
        if (_random.chance(0.01)) changeThreads();
    }

    void changeOptions() {
        report("sets options");
        if (_setup.withBins) {
            osgAnalyticBin::setCullOptions(*_scene, randomOptions(_random));
        } else {
            (void)randomOptions(_random);
        }
    }

    void changeDatabases() {
        report("adds or removes a database");
        const unsigned int count = _scene->getNumChildren();
        if (count > kStaying && _random.chance(0.5)) {
            _scene->removeChild(static_cast<unsigned int>(_random.integer(kStaying, static_cast<int>(count) - 1)));
        } else if (count < kMostDatabases) {
            addDatabase(
                _databases[static_cast<std::size_t>(_random.integer(0, static_cast<int>(_databases.size()) - 1))]);
        }
    }

    void changeThreads() {
        report("stops and starts threads");
        _rig->viewer().stopThreading();
        if (_random.chance(0.5)) _rig->viewer().setThreadingModel(kThreadingModels[_random.integer(0, 3)]);
        _rig->viewer().startThreading();
    }

    void lookAround() {
        _latitude = _random.uniform(-85.0, 85.0);
        _longitude = _random.uniform(-180.0, 180.0);
        _altitude = _random.logUniform(1e5, 2e7);
        _pitch = _random.uniform(0.0, 80.0);
    }

    void addDatabase(const std::string& file) {
        const osg::ref_ptr<osg::Node> database = osgDB::readRefNodeFile(file);
        if (!database) return;
        database->setUpdateCallback(nullptr);  // a request to install bins
        if (_setup.withBins) installBins(*database, defaultOptions(), file);
        _scene->addChild(database);
    }

    void setCameras(osg::CullSettings::CullingMode culling, float lodScale = 1.0F) {
        for (osg::Camera* camera : _rig->cameras()) {
            camera->setCullingMode(culling);
            camera->setLODScale(lodScale);
        }
    }

    void drawNext() {
        _rig->update(_time += kFrameTime);
        _rig->render();
    }

    // Frames from where the camera is until nothing more is read or merged.
    bool rest() {
        constexpr int kMostFrames = 2000;
        constexpr int kQuiet = 6;
        osgDB::DatabasePager& pager = *_rig->view().getDatabasePager();
        int quiet = 0;
        for (int i = 0; i < kMostFrames && quiet < kQuiet; ++i) {
            drawNext();
            const bool isBusy = pager.requiresUpdateSceneGraph() || pager.getRequestsInProgress();
            quiet = isBusy ? 0 : quiet + 1;
            if (isBusy) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return quiet == kQuiet;
    }

    void comparePictures() {
        report("loads what is in view");
        _rig->setMostPagedLods(1000);
        if (!rest()) ++_findings.unloaded;
        report("draws for a picture");
        const auto culled = _pictures->take([&] { drawNext(); });
        const osg::CullSettings::CullingMode mode = _rig->cameras().front()->getCullingMode();
        setCameras(osg::CullSettings::NO_CULLING);
        report("draws for a picture without culling");
        // nothing is merged in between
        const auto truth = _pictures->take([&] { _rig->render(); });
        setCameras(mode);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            ++_findings.pictures;
            std::size_t differing = 0;
            for (unsigned int at = 0; at < truth[i]->getTotalSizeInBytes(); at += 4) {
                if (std::memcmp(truth[i]->data() + at, culled[i]->data() + at, 4) != 0) ++differing;
                if (std::memcmp(truth[i]->data() + at, truth[i]->data(), 4) != 0) ++_findings.coveredPixels;
            }
            _findings.differingPixels += differing;
            if (differing > 0) ++_findings.differingPictures;
        }
    }

    void drain() {
        report("drains");
        lookAround();
        _scene->removeChildren(kStaying, _scene->getNumChildren() - static_cast<unsigned int>(kStaying));
        if (_setup.withBins) osgAnalyticBin::setCullOptions(*_scene, defaultOptions());
        _rig->setMostPagedLods(0);
        _rig->look(viewFrom(30.0, 10.0, 6e7, 0.0, 0.0));
        // renderers have two buffers, of which some models use one: what was drawn last stays in the other
        _rig->viewer().setThreadingModel(Threading::DrawThreadPerContext);
        (void)rest();
        _rig->viewer().setThreadingModel(Threading::SingleThreaded);
        // the pager keeps what was seen a tenth of a second ago, by the clock on the wall
        constexpr int kMostRests = 400;
        for (int i = 0; i < kMostRests && (!rest() || pagedIn(*_scene) > 0); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        _findings.undrainedTiles += pagedIn(*_scene);
        _rig->setMostPagedLods(kMostPagedLods);
    }

    void report(const char* what) {
        reportProgress("frame " + std::to_string(_findings.frames) + ", " + nameOf(_setup.threading) + " at first, " +
                       std::to_string(_setup.cameras) + " cameras: " + what);
    }

    const Setup _setup;
    const std::vector<std::string>& _databases;
    Random& _random;
    Findings& _findings;
    const osg::ref_ptr<osg::Group> _scene = new osg::Group;
    std::unique_ptr<ViewerRig> _rig;
    std::unique_ptr<Pictures> _pictures;
    KitObjects _objects;
    double _time = 0.0;
    double _latitude = 0.0, _longitude = 0.0, _altitude = 1e6, _heading = 0.0, _pitch = 30.0;
};

}  // namespace osgAnalyticBin::test
