// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "MethodScene.h"

#include "ClusterCallbacks.h"
#include "CsvTable.h"
#include "Failure.h"
#include "Nodes.h"
#ifdef OSGANALYTICBIN_RESEARCH
#include "Rivals.h"
#endif

#include <osgAnalyticBin/InstallBins.h>

#include <osg/PagedLOD>
#include <osgDB/DatabasePager>
#include <osgDB/Registry>
#include <osgTerrain/Terrain>

#include <algorithm>
#include <limits>
#include <set>
#include <thread>
#include <typeinfo>
#include <utility>

namespace osgAnalyticBin::bench {

using support::Failure;

namespace {

// Frames in a row that ask for nothing: what one update changes after the last merge is seen by the next cull.
constexpr int kQuietFrames = 3;
constexpr double kSettleFrame = 1.0 / 60.0;  // seconds
constexpr std::chrono::microseconds kLook{100};
// Before a file that could not be read is asked for once more.
constexpr std::chrono::milliseconds kBeforeNextTry{20};

using Nodes = std::set<osg::ref_ptr<osg::Node>>;

/// Records the nodes that a cull traversal goes into, and the drawables that it draws.
class Recorder final : public flight::CullWatcher {
public:
    [[nodiscard]] static Nodes keptNodes(osg::Camera& camera, osg::FrameStamp& frameStamp) {
        const osg::ref_ptr<Recorder> recorder = new Recorder;
        recorder->watch(camera, frameStamp);
        return std::move(recorder->_kept);
    }

private:
    void enter(osg::Node&) override {
        const osg::NodePath& path = getNodePath();
        if (path.size() > 1) _kept.insert(path[path.size() - 2]);
    }
    void leave(osg::Node&) override {}
    void draw(osg::Drawable&) override { _kept.insert(getNodePath().back()); }

    Nodes _kept;
};

/// Goes on to some of a node's children.
class AcceptKept : public osg::Callback {
public:
    explicit AcceptKept(osg::NodeList kept) : _kept(std::move(kept)) {}

    bool run(osg::Object*, osg::Object* data) override {
        osg::NodeVisitor& visitor = *data->asNodeVisitor();
        for (const auto& child : _kept) child->accept(visitor);
        return true;
    }

private:
    const osg::NodeList _kept;
};

// Whether a group goes on to each of its children, whatever the view.
bool acceptsAll(const osg::Node& node) {
    return typeid(node) == typeid(osg::Group) || typeid(node) == typeid(osg::CoordinateSystemNode) ||
           typeid(node) == typeid(osgTerrain::Terrain) || node.asTransform();
}

void filter(osg::Group& group, const Nodes& kept) {
    osg::NodeList children;
    for (unsigned int i = 0; i < group.getNumChildren(); ++i)
        if (kept.count(group.getChild(i)) != 0) children.emplace_back(group.getChild(i));
    if (children.size() < group.getNumChildren()) group.addCullCallback(new AcceptKept(std::move(children)));
}

// osgViewer finds a scene by its root, wherever it was made; only views make them otherwise.
class OwnScene : public osgViewer::Scene {
public:
    OwnScene() = default;

protected:
    ~OwnScene() override = default;
};

void raiseExpiry(osg::Node& node, double seconds) {
    auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
    for (unsigned int i = 0; paged && i < paged->getNumFileNames(); ++i)
        if (!paged->getFileName(i).empty())
            paged->setMinimumExpiryTime(i, std::max(seconds, paged->getMinimumExpiryTime(i)));
}

void scaleVertically(osg::Node& scene, double scale, const std::string& database) {
    bool isFound = false;
    support::visitNodes(scene, [&](osg::Node& node, osg::NodeVisitor&) {
        auto* const terrain = dynamic_cast<osgTerrain::Terrain*>(&node);
        if (terrain) terrain->setVerticalScale(static_cast<float>(scale));
        isFound = isFound || terrain;
        return !isFound;
    });
    if (!isFound) throw Failure("--vertical-scale: " + database + " has no osgTerrain::Terrain; leave the option out");
}

}  // namespace

void FileWatch::setTreatment(Clusters clusters, double expiry, const osg::EllipsoidModel* globe) {
    _clusters = clusters;
    _expiry = expiry;
    _globe = globe ? new osg::EllipsoidModel(globe->getRadiusEquator(), globe->getRadiusPolar()) : nullptr;
}

void FileWatch::treat(osg::Node& graph) {
    if (_clusters == Clusters::Remove) removeClusterCallbacks(graph);
    if (_clusters == Clusters::Fill) fillClusterCallbacks(graph, _globe);
    const double seconds = _expiry;
    if (seconds > 0.0) support::forAllNodes(graph, [seconds](osg::Node& node) { raiseExpiry(node, seconds); });
}

/// Counts the requests of a frame, and hands them on.
class MethodScene::Requests final : public flight::RequestCounter {
public:
    explicit Requests(osgDB::DatabasePager& pager) : _pager(pager) {}

    void requestNodeFile(const std::string& file, osg::NodePath& path, float priority, const osg::FrameStamp* stamp,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced* options) override {
        // below tiles that draw nothing, bins request with priorities below zero
        if (priority >= 0.0F) ++count;
        _pager.requestNodeFile(file, path, priority, stamp, request, options);
    }

private:
    osgDB::DatabasePager& _pager;
};

MethodScene::MethodScene(const CullMethod& method, const Settings& settings, FileWatch& watch)
    : _method(method), _settings(settings), _watch(watch), _camera(new osg::Camera) {
    _camera->setViewport(new osg::Viewport(0, 0, settings.width, settings.height));
    _camera->setCullingMode(method.cullsNothing
                                ? static_cast<osg::CullSettings::CullingMode>(osg::CullSettings::NO_CULLING)
                                : kDefaultCulling);
    _camera->setLODScale(1.0F);
}

MethodScene::~MethodScene() = default;

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
    _watch.setTreatment(_method.clusters, _method.usesBins ? 0.0 : _settings.expiry, globe);
}

void MethodScene::load() {
    _stage.reset();
    _scene = nullptr;
    _camera->removeChildren(0, _camera->getNumChildren());
    treatFiles(nullptr);
    const osg::ref_ptr<osg::Node> root = read();
#ifdef OSGANALYTICBIN_RESEARCH
    if (!_method.rule.empty())
        rivals::installRivals(*root,
                              {rivals::ruleNamed(_method.rule), _method.ruleUsesHorizon, _method.ruleTestsEdges});
#endif
    if (!root->getBound().valid()) throw Failure(_settings.database + ": the database is empty");
    if (_settings.verticalScale != 1.0) scaleVertically(*root, _settings.verticalScale, _settings.database);
    _globe = flight::globeOf(*root);
    treatFiles(_globe.ellipsoid);
    _camera->addChild(root);
    _scene = new OwnScene;
    _scene->setSceneData(root);
    _frameStamp = new osg::FrameStamp;
    _update = new osgUtil::UpdateVisitor;
    _update->setFrameStamp(_frameStamp);
    _requests = new Requests(pager());
    _stage.emplace(*_requests);
}

void MethodScene::resume() {
    treatFiles(_globe.ellipsoid);
    pager().setDatabasePagerThreadPause(false);
}

void MethodScene::pause() {
    pager().setDatabasePagerThreadPause(true);
    while (isThreadBusy()) std::this_thread::sleep_for(kLook);
}

void MethodScene::replayVerdicts() {
    const Nodes kept = Recorder::keptNodes(*_camera, *_frameStamp);
    osg::Node& scene = root();
    removeBins(scene);
    removeClusterCallbacks(scene);
    for (const auto& node : kept) node->setCullingActive(false);
    support::visitNodes(scene, [&](osg::Node& node, osg::NodeVisitor&) {
        const bool isKept = kept.count(&node) != 0;
        // LODs choose their children by themselves: the mask keeps them out of what was culled
        if (!isKept) node.setNodeMask(0);
        if (isKept && acceptsAll(node)) filter(*node.asGroup(), kept);
        return isKept;
    });
}

MethodScene::Frame MethodScene::step(double seconds) {
    _frameStamp->setFrameNumber(_frameStamp->getFrameNumber() + 1);
    _frameStamp->setReferenceTime(_frameStamp->getReferenceTime() + seconds);
    _frameStamp->setSimulationTime(_frameStamp->getReferenceTime());
    _update->reset();
    _update->setTraversalNumber(_frameStamp->getFrameNumber());
    _scene->updateSceneGraph(*_update);
    // The traversals that follow must not find bounds to compute.
    (void)_scene->getSceneData()->getBound();
    pager().signalBeginFrame(_frameStamp);
    _requests->count = 0;
    const double cullMs = _stage->cull(*_camera, *_frameStamp);
    pager().signalEndFrame();
    return {cullMs, _requests->count};
}

void MethodScene::settle(const flight::CameraPose& pose) {
    // What a pose is charged with must not depend on what the pager threw away.
    pager().setTargetMaximumNumberOfPageLOD(std::numeric_limits<unsigned int>::max());
    const auto begin = std::chrono::steady_clock::now();
    setPose(pose);
    for (int quietFrames = 0; quietFrames < kQuietFrames;) {
        // each frame is culled as the first of its visitor: nothing that an earlier one found out counts
        _stage.emplace(*_requests);
        const Frame frame = step(kSettleFrame);
        awaitFiles(pose, begin);
        const bool hasFilesToMerge = pager().requiresUpdateSceneGraph();
        quietFrames = frame.wanted == 0 && !hasFilesToMerge ? quietFrames + 1 : 0;
        if (frame.wanted > 0 && !hasFilesToMerge) std::this_thread::sleep_for(kBeforeNextTry);
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
        if (isReading()) std::this_thread::sleep_for(kLook);
    } while (isReading());
}

MethodScene::Frame MethodScene::flyFrame(const flight::CameraPose& pose, double seconds) {
    setPose(pose);
    return step(seconds);
}

bool MethodScene::isThreadBusy() const {
    for (unsigned int i = 0; i < pager().getNumDatabaseThreads(); ++i)
        if (pager().getDatabaseThread(i)->getActive()) return true;
    return false;
}

// A thread becomes active before it takes a file from the list; files read count as read when they wait for being
// merged.
bool MethodScene::isReading() const {
    return pager().getFileRequestListSize() > 0 || isThreadBusy();
}

flight::Globe globeOf(const Settings& settings, FileWatch& watch) {
    MethodScene scene(cullMethodFromName("sphere"), settings, watch);
    scene.load();
    scene.pause();
    return scene.globe();
}

}  // namespace osgAnalyticBin::bench
