// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "PagedFlight.h"

#include <osg/Drawable>
#include <osg/PagedLOD>

#include <chrono>
#include <support/VisitNodes.h>
#include <thread>

namespace osgAnalyticBin::test {

namespace {

constexpr double kFrameTime = 1.0 / 60.0;
// The pager's threads get this much real time in each frame.
constexpr std::chrono::milliseconds kPause{2};
constexpr std::chrono::seconds kLongestWait{60};

std::string keyOf(const osg::BoundingSphere& sphere, const osg::Matrixd& toEye) {
    const osg::Vec3d center = osg::Vec3d(sphere.center()) * toEye;
    std::string key;
    for (const double value : {center.x(), center.y(), center.z(), static_cast<double>(sphere.radius())})
        key += std::to_string(std::llround(value)) + ' ';
    return key;
}

}  // namespace

/// Notes what is asked for, and passes it on.
class PagedFlight::Requests : public osg::NodeVisitor::DatabaseRequestHandler {
public:
    explicit Requests(osgDB::DatabasePager* pager) : _pager(pager) {}

    void requestNodeFile(const std::string& fileName, osg::NodePath& path, float priority, const osg::FrameStamp* stamp,
                         osg::ref_ptr<osg::Referenced>& request, const osg::Referenced* options) override {
        names.insert(fileName);
        _pager->requestNodeFile(fileName, path, priority, stamp, request, options);
    }

    std::set<std::string> names;

private:
    osgDB::DatabasePager* _pager;
};

/// Notes what is drawn.
class PagedFlight::Recorder : public osgUtil::CullVisitor {
public:
    using osgUtil::CullVisitor::apply;
    void apply(osg::Drawable& drawable) override {
        const unsigned int before = _currentReuseRenderLeafIndex;
        osgUtil::CullVisitor::apply(drawable);
        if (_currentReuseRenderLeafIndex == before) return;
        drawn.insert(keyOf(drawable.getBound(), *getModelViewMatrix()));
    }

    std::multiset<std::string> drawn;
};

PagedFlight::PagedFlight(osg::Node& scene, unsigned int targetMaximum)
    : _scene(scene), _pager(osgDB::DatabasePager::create()), _requests(new Requests(_pager)), _recorder(new Recorder) {
    _pager->setDoPreCompile(false);
    _pager->setTargetMaximumNumberOfPageLOD(targetMaximum);
    _pager->registerPagedLODs(&scene, 0);
    _recorder->setDatabaseRequestHandler(_requests);
    _update->setFrameStamp(_stamp);
}

PagedFlight::~PagedFlight() {
    _pager->cancel();
}

void PagedFlight::frame(const CullView& view) {
    _stamp->setFrameNumber(_stamp->getFrameNumber() + 1);
    _stamp->setReferenceTime(_stamp->getFrameNumber() * kFrameTime);
    _update->setTraversalNumber(_stamp->getFrameNumber());
    _pager->updateSceneGraph(*_stamp);
    _scene.accept(*_update);
    _pager->signalBeginFrame(_stamp);
    _requests->names.clear();
    _recorder->drawn.clear();
    _scene.getBound();
    cull(_scene, view, *_recorder, _stamp->getFrameNumber(), _stamp->getReferenceTime());
    _pager->signalEndFrame();
    std::this_thread::sleep_for(kPause);
}

void PagedFlight::frames(const CullView& view, int count) {
    for (int i = 0; i < count; ++i) frame(view);
}

bool PagedFlight::framesUntil(const CullView& view, const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + kLongestWait;
    while (std::chrono::steady_clock::now() < end) {
        frame(view);
        if (condition()) return true;
    }
    return false;
}

bool PagedFlight::load(const CullView& view) {
    return framesUntil(view, [this] { return wanted().empty(); });
}

const std::set<std::string>& PagedFlight::wanted() const {
    return _requests->names;
}

const std::multiset<std::string>& PagedFlight::drawn() const {
    return _recorder->drawn;
}

CullView lookDown(double side) {
    const osg::Vec3d eye(6378137.0 + 300e3, 0.0, 0.0);
    return CullView::lookAt(eye, eye + osg::Vec3d(-1.0, side, 0.0), osg::Vec3d(1.0, 0.0, 0.0), 40.0);
}

std::size_t loadedTiles(osg::Node& scene) {
    std::size_t count = 0;
    visitNodes(scene, [&](osg::Node& node) {
        const auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        for (unsigned int i = 0; paged && i < std::min(paged->getNumChildren(), paged->getNumFileNames()); ++i)
            if (!paged->getFileName(i).empty()) ++count;
    });
    return count;
}

}  // namespace osgAnalyticBin::test
