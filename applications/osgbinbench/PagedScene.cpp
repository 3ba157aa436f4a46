// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PagedScene.h"

#include <osgDB/DatabasePager>

#include <chrono>
#include <limits>
#include <thread>
#include <unordered_map>
#include <utility>

namespace osgAnalyticBin::bench {

namespace {

constexpr std::chrono::microseconds kIdleLook{200};

// osgViewer finds a scene by its root, wherever it was made; only views make them otherwise.
class OwnScene : public osgViewer::Scene {
public:
    OwnScene() = default;

protected:
    ~OwnScene() override = default;
};

}  // namespace

class PagedScene::Requests final : public osg::NodeVisitor::DatabaseRequestHandler {
public:
    explicit Requests(osgDB::DatabasePager& pager) : _pager(pager) {}

    void beginFrame() {
        ++_frame;
        wanted = 0;
        askedAgain = 0;
    }

    void requestNodeFile(const std::string& file, osg::NodePath& path, float priority, const osg::FrameStamp* stamp,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced* options) override {
        // below tiles that draw nothing, bins request with priorities below zero
        if (priority >= 0.0F) ++wanted;
        const auto [asked, isNew] = _frameOf.try_emplace(file, _frame);
        if (!isNew && std::exchange(asked->second, _frame) + 1 < _frame) ++askedAgain;
        _pager.requestNodeFile(file, path, priority, stamp, request, options);
    }

    std::uint64_t wanted = 0;
    std::uint64_t askedAgain = 0;

private:
    osgDB::DatabasePager& _pager;
    std::uint64_t _frame = 0;
    std::unordered_map<std::string, std::uint64_t> _frameOf;  // that asked for a file last
};

PagedScene::PagedScene(osg::Node& root, osg::Camera& camera)
    : _camera(camera),
      _scene(new OwnScene),
      _frameStamp(new osg::FrameStamp),
      _update(new osgUtil::UpdateVisitor),
      _requests(new Requests(*_scene->getDatabasePager())) {
    _scene->setSceneData(&root);
    _update->setFrameStamp(_frameStamp);
    forgetFrames();
}

PagedScene::~PagedScene() = default;

void PagedScene::forgetFrames() {
    _stage.emplace(*_requests);
}

PagedScene::Frame PagedScene::step(double seconds) {
    _frameStamp->setFrameNumber(_frameStamp->getFrameNumber() + 1);
    _frameStamp->setReferenceTime(_frameStamp->getReferenceTime() + seconds);
    _frameStamp->setSimulationTime(_frameStamp->getReferenceTime());
    _update->reset();
    _update->setTraversalNumber(_frameStamp->getFrameNumber());
    _scene->updateSceneGraph(*_update);
    // The traversals that follow must not find bounds to compute.
    (void)_scene->getSceneData()->getBound();
    pager().signalBeginFrame(_frameStamp);
    _requests->beginFrame();
    const double cullMs = _stage->cull(_camera, *_frameStamp);
    pager().signalEndFrame();
    return {cullMs, _requests->wanted, _requests->askedAgain};
}

void PagedScene::keepEverything() {
    pager().setTargetMaximumNumberOfPageLOD(std::numeric_limits<unsigned int>::max());
}

bool PagedScene::isThreadBusy() const {
    for (unsigned int i = 0; i < pager().getNumDatabaseThreads(); ++i)
        if (pager().getDatabaseThread(i)->getActive()) return true;
    return false;
}

// A thread becomes active before it takes a file from the list.
bool PagedScene::isReading() const {
    return pager().getFileRequestListSize() > 0 || isThreadBusy();
}

void PagedScene::pause() {
    pager().setDatabasePagerThreadPause(true);
    while (isThreadBusy()) std::this_thread::sleep_for(kIdleLook);
}

void PagedScene::resume() {
    pager().setDatabasePagerThreadPause(false);
}

}  // namespace osgAnalyticBin::bench
