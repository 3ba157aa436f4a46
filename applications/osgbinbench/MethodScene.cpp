// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MethodScene.h"

#include "CsvTable.h"
#include "Failure.h"
#include "Interruption.h"

#include <osgDB/DatabasePager>
#include <osgDB/Registry>
#include <osgTerrain/Terrain>

#include <thread>

namespace osgAnalyticBin::bench {

using support::Failure;

namespace {

// Frames in a row that ask for nothing: what one update changes after the last merge is seen by the next cull.
constexpr int kQuietFrames = 3;
constexpr double kSettleFrame = 1.0 / 60.0;  // seconds
constexpr std::chrono::microseconds kLook{100};
// Before a file that could not be read is asked for once more.
constexpr std::chrono::milliseconds kBeforeNextTry{20};

class VerticalScaler : public osg::NodeVisitor {
public:
    explicit VerticalScaler(double scale)
        : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), _scale(static_cast<float>(scale)) {}

    using osg::NodeVisitor::apply;
    void apply(osg::Group& node) override {
        if (auto* const terrain = dynamic_cast<osgTerrain::Terrain*>(&node)) {
            terrain->setVerticalScale(_scale);
            found = true;
        }
        // What is traversed below a Terrain before its first update never finds it.
        if (!found) traverse(node);
    }

    bool found = false;

private:
    float _scale;
};

void scaleVertically(osg::Node& scene, double scale, const std::string& database) {
    VerticalScaler scaler(scale);
    scene.accept(scaler);
    if (!scaler.found)
        throw Failure("--vertical-scale: " + database + " has no osgTerrain::Terrain; leave the option out");
}

osg::CullSettings::CullingMode cullingOf(const CullMethod& method) {
    return method.cullsNothing ? static_cast<osg::CullSettings::CullingMode>(osg::CullSettings::NO_CULLING)
                               : kDefaultCulling;
}

}  // namespace

MethodScene::MethodScene(const CullMethod& method, const Settings& settings, FileWatch& watch)
    : _method(method), _settings(settings), _watch(watch), _camera(new osg::Camera) {
    _camera->setViewport(new osg::Viewport(0, 0, settings.width, settings.height));
    _camera->setCullingMode(cullingOf(method));
    _camera->setLODScale(1.0F);
}

void MethodScene::forget() {
    _paged.reset();
    _camera->removeChildren(0, _camera->getNumChildren());
}

osg::ref_ptr<osg::Node> MethodScene::read() const {
    const std::string name = _method.sceneName(_settings.database, _settings.binOptions);
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(name, nullptr);
    if (result.validNode()) return result.getNode();
    const std::string reason =
        result.message().empty() ? "missing, or of a kind that OSG does not read" : result.message();
    throw Failure(_settings.database + ": cannot be read with method " + _method.name + ": " + reason);
}

// Bins see to expiry by themselves.
void MethodScene::treatFiles(const osg::EllipsoidModel* globe) {
    _watch.remover->setTreatment(_method.clusters, globe);
    _watch.expiry->setSeconds(_method.usesBins() ? 0.0 : _settings.expiry);
}

void MethodScene::load() {
    forget();
    treatFiles(nullptr);
    const osg::ref_ptr<osg::Node> root = read();
    if (!root->getBound().valid()) throw Failure(_settings.database + ": the database is empty");
    if (_settings.verticalScale != 1.0) scaleVertically(*root, _settings.verticalScale, _settings.database);
    _globe = flight::globeOf(*root);
    _camera->addChild(root);
    _paged.emplace(*root, *_camera);
}

void MethodScene::resume() {
    treatFiles(_globe.ellipsoid);
    _paged->resume();
}

void MethodScene::settle(const flight::CameraPose& pose) {
    // What a pose is charged with must not depend on what the pager threw away.
    _paged->keepEverything();
    const auto begin = std::chrono::steady_clock::now();
    setPose(pose);
    for (int quietFrames = 0; quietFrames < kQuietFrames;) {
        _paged->forgetFrames();
        const PagedScene::Frame frame = _paged->step(kSettleFrame);
        awaitFiles(pose, begin);
        quietFrames = frame.wanted == 0 && !_paged->hasFilesToMerge() ? quietFrames + 1 : 0;
        if (frame.wanted > 0 && !_paged->hasFilesToMerge()) std::this_thread::sleep_for(kBeforeNextTry);
    }
}

Failure MethodScene::lateAt(const flight::CameraPose& pose) const {
    return Failure("pose " + pose.name + ", method " + _method.name + ": files are still missing after " +
                   flight::textFrom(_settings.timeout) + " s; raise --timeout, or look for missing files");
}

void MethodScene::awaitFiles(const flight::CameraPose& pose, std::chrono::steady_clock::time_point begin) const {
    do {
        support::throwIfStopRequested();
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
        if (passed.count() > _settings.timeout) throw lateAt(pose);
        if (_paged->isReading()) std::this_thread::sleep_for(kLook);
    } while (_paged->isReading());
}

void MethodScene::setPose(const flight::CameraPose& pose) {
    flight::placeCamera(*_camera, pose, _globe);
}

PagedScene::Frame MethodScene::flyFrame(const flight::CameraPose& pose, double seconds) {
    setPose(pose);
    return _paged->step(seconds);
}

}  // namespace osgAnalyticBin::bench
