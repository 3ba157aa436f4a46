// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MethodViewer.h"

#include "DrawingSurface.h"
#include "Failure.h"

#include <osgDB/DatabasePager>
#include <osgDB/Registry>
#include <osgTerrain/Terrain>

#include <limits>

namespace osgAnalyticBin::bench {

namespace {

// Frames without a request or a merge after which the pager counts as idle: a request made in one frame may be on its
// way from a queue to a thread in the next.
constexpr int kIdleFrames = 5;

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

}  // namespace

MethodViewer::MethodViewer(const CullMethod& method, const Settings& settings, FileWatch& watch)
    : _method(method), _settings(settings), _watch(watch), _capture(new flight::FrameCapture) {
    _viewer.setThreadingModel(settings.threading);
    prepareViewer(_viewer, settings.width, settings.height);
    if (_method.cullsNothing) camera().setCullingMode(osg::CullSettings::NO_CULLING);
    camera().addFinalDrawCallback(_capture);
    camera().getStats()->collectStats("rendering", true);
}

MethodViewer::~MethodViewer() {
    rest();
    if (osgDB::DatabasePager* const pager = _viewer.getDatabasePager()) pager->cancel();
}

osg::ref_ptr<osg::Node> MethodViewer::read() const {
    const std::string name = _method.sceneName(_settings.database, _settings.binOptions);
    osgDB::ReaderWriter::ReadResult result = osgDB::Registry::instance()->readNode(name, nullptr);
    if (result.validNode()) return result.getNode();
    const std::string reason =
        result.message().empty() ? "missing, or of a kind that OSG does not read" : result.message();
    throw Failure(_settings.database + ": cannot be read with method " + _method.name + ": " + reason);
}

void MethodViewer::load() {
    rest();
    _watch.remover->setEnabled(_method.removesClusters);
    const osg::ref_ptr<osg::Node> scene = read();
    if (!scene->getBound().valid()) throw Failure(_settings.database + ": there is nothing to fly over");
    if (_settings.verticalScale != 1.0) scaleVertically(*scene, _settings.verticalScale, _settings.database);
    _globe = flight::globeOf(*scene);
    _viewer.setSceneData(scene);
    if (!_viewer.isRealized()) {
        _viewer.realize();
    } else {
        wake();
    }
    _filesLastFrame = _watch.reads->nodeFiles();
}

void MethodViewer::settle(const flight::CameraPose& pose) {
    // What a pose is charged with must not depend on what the pager threw away.
    _viewer.getDatabasePager()->setTargetMaximumNumberOfPageLOD(std::numeric_limits<unsigned int>::max());
    const osg::Timer_t begin = osg::Timer::instance()->tick();
    do {
        drawUntilIdle(pose, begin);
        rest();
    } while (census().wanted > 0);
    wake();
}

void MethodViewer::drawUntilIdle(const flight::CameraPose& pose, osg::Timer_t begin) {
    wake();
    for (int idleFrames = 0; idleFrames < kIdleFrames;) {
        drawFrame(pose);
        idleFrames = isPagerIdle() ? idleFrames + 1 : 0;
        if (osg::Timer::instance()->delta_s(begin, osg::Timer::instance()->tick()) > _settings.timeout)
            throw Failure("pose " + pose.name + ", method " + _method.name + ": files are still missing after " +
                          std::to_string(_settings.timeout) + " s; raise --timeout, or look for missing files");
    }
}

bool MethodViewer::isPagerIdle() {
    const std::uint64_t files = _watch.reads->nodeFiles();
    const bool quiet = files == _filesLastFrame;
    _filesLastFrame = files;
    const osgDB::DatabasePager& pager = *_viewer.getDatabasePager();
    return quiet && !pager.getRequestsInProgress() && !pager.requiresUpdateSceneGraph();
}

void MethodViewer::setPose(const flight::CameraPose& pose) {
    camera().setViewMatrix(flight::viewMatrixOf(pose, _globe));
    camera().setProjectionMatrix(flight::projectionMatrixOf(pose, camera().getViewport()->aspectRatio()));
}

void MethodViewer::drawFrame(const flight::CameraPose& pose) {
    setPose(pose);
    _viewer.frame();
}

osg::ref_ptr<osg::Image> MethodViewer::picture() {
    wake();
    osg::ref_ptr<osg::Image> image = drawPicture(_viewer, *_capture);
    if (!image) throw Failure("method " + _method.name + ": the picture was never drawn");
    return image;
}

void MethodViewer::wake() {
    if (_viewer.getThreadingModel() != osgViewer::ViewerBase::SingleThreaded) _viewer.startThreading();
}

void MethodViewer::rest() {
    if (_viewer.areThreadsRunning()) _viewer.stopThreading();
}

Census MethodViewer::census() {
    return TileCensus::take(camera(), frameStamp());
}

}  // namespace osgAnalyticBin::bench
