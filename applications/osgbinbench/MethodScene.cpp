// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MethodScene.h"

#include "CsvTable.h"
#include "Failure.h"

#include <osgDB/DatabasePager>
#include <osgDB/Registry>
#include <osgTerrain/Terrain>

#include <limits>

namespace osgAnalyticBin::bench {

namespace {

// Frames without a request or a merge after which the pager counts as idle: a request made in one frame may be on its
// way from a queue to a thread in the next.
constexpr int kIdleFrames = 20;

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

MethodScene::MethodScene(const CullMethod& method, const Settings& settings, FileWatch& watch, BenchViewer& viewer)
    : _method(method), _settings(settings), _watch(watch), _viewer(viewer), _camera(new osg::Camera) {
    _camera->setViewport(new osg::Viewport(viewer.viewport()));
    _camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    _camera->setCullingMode(cullingOf(method));
    _camera->setLODScale(1.0F);
}

MethodScene::~MethodScene() {
    _viewer.rest();
    forget();
}

void MethodScene::forget() {
    _scene = nullptr;
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

void MethodScene::load() {
    _viewer.rest();
    forget();
    _watch.remover->setEnabled(_method.removesClusters);
    const osg::ref_ptr<osg::Node> root = read();
    if (!root->getBound().valid()) throw Failure(_settings.database + ": there is nothing to fly over");
    if (_settings.verticalScale != 1.0) scaleVertically(*root, _settings.verticalScale, _settings.database);
    _globe = flight::globeOf(*root);
    _viewer.show(*root, cullingOf(_method));
    _scene = _viewer.scene();
    _camera->addChild(root);
    _filesLastFrame = _watch.reads->nodeFiles();
}

void MethodScene::settle(const flight::CameraPose& pose) {
    // What a pose is charged with must not depend on what the pager threw away.
    _scene->getDatabasePager()->setTargetMaximumNumberOfPageLOD(std::numeric_limits<unsigned int>::max());
    const osg::Timer_t begin = osg::Timer::instance()->tick();
    do {
        drawUntilIdle(pose, begin);
        _viewer.rest();
    } while (census().wanted > 0);
}

void MethodScene::drawUntilIdle(const flight::CameraPose& pose, osg::Timer_t begin) {
    for (int idleFrames = 0; idleFrames < kIdleFrames;) {
        drawFrame(pose);
        idleFrames = isPagerIdle() ? idleFrames + 1 : 0;
        if (osg::Timer::instance()->delta_s(begin, osg::Timer::instance()->tick()) > _settings.timeout)
            throw Failure("pose " + pose.name + ", method " + _method.name + ": files are still missing after " +
                          flight::textFrom(_settings.timeout) + " s; raise --timeout, or look for missing files");
    }
}

bool MethodScene::isPagerIdle() {
    const std::uint64_t files = _watch.reads->nodeFiles();
    const bool quiet = files == _filesLastFrame;
    _filesLastFrame = files;
    const osgDB::DatabasePager& pager = *_scene->getDatabasePager();
    return quiet && !pager.getRequestsInProgress() && !pager.requiresUpdateSceneGraph();
}

void MethodScene::drawFrame(const flight::CameraPose& pose) {
    _camera->setViewMatrix(flight::viewMatrixOf(pose, _globe));
    _camera->setProjectionMatrix(flight::projectionMatrixOf(pose, _globe, _camera->getViewport()->aspectRatio()));
    _viewer.setView(_camera->getViewMatrix(), _camera->getProjectionMatrix());
    _viewer.drawFrame();
}

}  // namespace osgAnalyticBin::bench
