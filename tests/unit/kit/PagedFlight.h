// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullFixture.h"

#include <gtest/gtest.h>
#include <osg/Drawable>
#include <osg/Node>
#include <osg/PagedLOD>
#include <osgDB/DatabasePager>
#include <osgDB/Registry>
#include <osgUtil/UpdateVisitor>

#include <chrono>
#include <map>
#include <mutex>
#include <support/AnyScene.h>
#include <thread>

namespace osgAnalyticBin::test {

/// A flight over a paged scene without a window: OSG's own DatabasePager and cull traversals, in the order in which
/// osgViewer runs them, single threaded but for the pager. Time is simulated: a frame takes a sixtieth of a second.
class PagedFlight {
public:
    /// `targetMaximum`: number of PagedLODs above which the pager drops what is out of view.
    explicit PagedFlight(osg::Node& scene, unsigned int targetMaximum = 300)
        : _scene(scene), _pager(osgDB::DatabasePager::create()), _requests(new Requests(_pager)) {
        _pager->setDoPreCompile(false);
        _pager->setTargetMaximumNumberOfPageLOD(targetMaximum);
        _pager->registerPagedLODs(&scene, 0);
        _recorder->setDatabaseRequestHandler(_requests);
        _update->setFrameStamp(_stamp);
    }
    ~PagedFlight() { _pager->cancel(); }
    PagedFlight(const PagedFlight&) = delete;
    PagedFlight& operator=(const PagedFlight&) = delete;

    void frame(const CullView& view) {
        // the pager's threads get this much real time in each frame
        constexpr std::chrono::milliseconds kPause{2};
        _stamp->setFrameNumber(_stamp->getFrameNumber() + 1);
        _stamp->setReferenceTime(_stamp->getFrameNumber() / 60.0);
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
    void frames(const CullView& view, int count) {
        for (int i = 0; i < count; ++i) frame(view);
    }

    /// Frames until the condition holds; it is asked after each. Returns: false when it does not within a minute.
    bool framesUntil(const CullView& view, const std::function<bool()>& condition) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (std::chrono::steady_clock::now() < end) {
            frame(view);
            if (condition()) return true;
        }
        return false;
    }

    /// Frames until everything in view is there.
    bool load(const CullView& view) {
        return framesUntil(view, [this] { return wanted().empty(); });
    }

    /// Names of files that the last frame asked for.
    [[nodiscard]] const std::set<std::string>& wanted() const { return _requests->names; }

    /// What the last frame drew: center, in the eye's frame, and radius of each drawable.
    [[nodiscard]] const std::multiset<std::string>& drawn() const { return _recorder->drawn; }

    /// Simulated seconds.
    [[nodiscard]] double time() const { return _stamp->getReferenceTime(); }

private:
    /// Notes what is asked for, and passes it on.
    struct Requests : osg::NodeVisitor::DatabaseRequestHandler {
        explicit Requests(osgDB::DatabasePager* to) : pager(to) {}
        void requestNodeFile(const std::string& fileName, osg::NodePath& path, float priority,
                             const osg::FrameStamp* stamp, osg::ref_ptr<osg::Referenced>& request,
                             const osg::Referenced* options) override {
            names.insert(fileName);
            pager->requestNodeFile(fileName, path, priority, stamp, request, options);
        }
        osgDB::DatabasePager* const pager;
        std::set<std::string> names;
    };

    /// Notes what is drawn.
    struct Recorder : osgUtil::CullVisitor {
        using osgUtil::CullVisitor::apply;
        void apply(osg::Drawable& drawable) override {
            const unsigned int before = _currentReuseRenderLeafIndex;
            osgUtil::CullVisitor::apply(drawable);
            if (_currentReuseRenderLeafIndex == before) return;
            const osg::BoundingSphere sphere = drawable.getBound();
            const osg::Vec3d center = osg::Vec3d(sphere.center()) * *getModelViewMatrix();
            std::string key;
            for (const double value : {center.x(), center.y(), center.z(), static_cast<double>(sphere.radius())})
                key += std::to_string(std::llround(value)) + ' ';
            drawn.insert(key);
        }
        std::multiset<std::string> drawn;
    };

    osg::Node& _scene;
    const osg::ref_ptr<osgDB::DatabasePager> _pager;
    const osg::ref_ptr<Requests> _requests;
    const osg::ref_ptr<Recorder> _recorder = new Recorder;
    const osg::ref_ptr<osgUtil::UpdateVisitor> _update = new osgUtil::UpdateVisitor;
    const osg::ref_ptr<osg::FrameStamp> _stamp = new osg::FrameStamp;
};

/// From 300 km above the equator, down at 45 degrees to the east (1) or west (-1).
[[nodiscard]] inline CullView lookDown(double side) {
    const osg::Vec3d eye(6378137.0 + 300e3, 0.0, 0.0);
    return CullView::lookAt(eye, eye + osg::Vec3d(-1.0, side, 0.0), osg::Vec3d(1.0, 0.0, 0.0), 40.0);
}

/// Number of PagedLODs below the node that have a paged child at present.
[[nodiscard]] inline std::size_t loadedTiles(osg::Node& scene) {
    std::size_t count = 0;
    visitNodes(scene, [&](osg::Node& node) {
        const auto* const paged = dynamic_cast<osg::PagedLOD*>(&node);
        for (unsigned int i = 0; paged && i < std::min(paged->getNumChildren(), paged->getNumFileNames()); ++i)
            if (!paged->getFileName(i).empty()) ++count;
    });
    return count;
}

/// Number of PagedLODs below the node. Expects each to have a cull callback of this class.
template <class CullCallback>
[[nodiscard]] std::size_t tilesWith(osg::Node& scene) {
    std::size_t count = 0;
    visitNodes(scene, [&](osg::Node& node) {
        if (!dynamic_cast<osg::PagedLOD*>(&node)) return;
        ++count;
        EXPECT_TRUE(dynamic_cast<CullCallback*>(node.getCullCallback()));
    });
    return count;
}

/// Reads as OSG does, in any thread, and counts how often it is asked for each name.
struct CountedReads : osgDB::ReadFileCallback {
    osgDB::ReaderWriter::ReadResult readNode(const std::string& name, const osgDB::Options* options) override {
        count(name);
        return osgDB::Registry::instance()->readNodeImplementation(name, options);
    }

    osgDB::ReaderWriter::ReadResult readObject(const std::string& name, const osgDB::Options* options) override {
        count(name);
        return osgDB::Registry::instance()->readObjectImplementation(name, options);
    }

    [[nodiscard]] std::map<std::string, int> counts() const {
        const std::lock_guard<std::mutex> lock(_mutex);
        return _counts;
    }

    [[nodiscard]] int total() const {
        int sum = 0;
        for (const auto& [name, count] : counts()) sum += count;
        return sum;
    }

    /// Of one name.
    [[nodiscard]] int most() const {
        int most = 0;
        for (const auto& [name, count] : counts()) most = std::max(most, count);
        return most;
    }

private:
    void count(const std::string& name) {
        const std::lock_guard<std::mutex> lock(_mutex);
        ++_counts[name];
    }

    mutable std::mutex _mutex;
    std::map<std::string, int> _counts;
};

}  // namespace osgAnalyticBin::test
