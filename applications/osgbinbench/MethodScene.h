// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CameraView.h"
#include "CullMethod.h"
#include "Failure.h"
#include "ReadCounter.h"
#include "Settings.h"
#include "TileCensus.h"

#include <osg/CoordinateSystemNode>
#include <osgUtil/UpdateVisitor>
#include <osgViewer/Scene>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace osgAnalyticBin::bench {

/// Counts the files that are read, also those that the DatabasePager loads, and changes what is read: it removes or
/// fills cluster callbacks, and raises the minimum expiry time of what PagedLODs page in, as bins do by
/// CullOptions::expiry; longer times stay. At first it changes nothing. One in a program, installed before the first
/// file is read.
class FileWatch : public flight::ReadCounter {
public:
    /// `expiry`: seconds; 0 leaves times as they are. `globe`: of the pages read next; nullptr: the root file has to be
    /// read next. Must not be called while files are read.
    void setTreatment(Clusters clusters, double expiry, const osg::EllipsoidModel* globe = nullptr);

protected:
    ~FileWatch() override = default;
    void treat(osg::Node& graph) override;

private:
    std::atomic<Clusters> _clusters{Clusters::Keep};
    std::atomic<double> _expiry{0.0};
    /// Whose pages are read. A copy: the globe may come from a plugin, which the Registry unloads before its callbacks
    /// are gone.
    osg::ref_ptr<const osg::EllipsoidModel> _globe;
};

/// A database with a pager and a clock of its own, culled by one method, and taken from frame to frame without drawing:
/// what has been read is merged, the graph is updated, then culled, and what is missing is asked for. So no frame is
/// late because drawing it took long, and time stands still while other scenes have their turn.
/// Scenes take turns in reading files: only the one that was loaded or resumed last does.
class MethodScene {
public:
    /// What one frame's cull traversal did.
    struct Frame {
        double cullMs = 0.0;
        std::uint64_t wanted = 0;  ///< files asked for: not loaded yet
    };

    MethodScene(const CullMethod& method, const Settings& settings, FileWatch& watch);
    ~MethodScene();

    MethodScene(const MethodScene&) = delete;
    MethodScene& operator=(const MethodScene&) = delete;

    /// Reads the database's root file; pages of before are forgotten.
    /// Throws: Failure when it cannot be read or is empty.
    void load();

    /// Takes its turn after another scene had its own, or gives it up: then the pager's threads are held when the file
    /// that is being read has been read. Requires: load().
    void resume();
    void pause();

    /// Stands at a pose until every file that is wanted there has been read and merged. All files that one frame asks
    /// for are merged before the next frame asks for more, so that what is read depends on nothing but the pose and
    /// what was loaded before. Requires: load(), and no other scene's turn since.
    /// Throws: Failure when that takes longer than the timeout, Interrupted.
    void settle(const flight::CameraPose& pose);

    /// One frame from a pose, `seconds` after the last one, wherever the pager is. Requires: as settle().
    Frame flyFrame(const flight::CameraPose& pose, double seconds);

    /// The view of the camera. Requires: load().
    void setPose(const flight::CameraPose& pose) { flight::placeCamera(*_camera, pose, _globe); }

    /// Makes the scene repeat, without a test, what bins decide at the present view. One cull traversal is
    /// recorded; then bins and cluster callbacks are taken off, and each group accepts only the children that the
    /// traversal went into or drew, whose spheres and boxes are not tested either. So the next cull traversals cost
    /// what OSG takes for the tiles kept, and nothing for the tests. Requires: bins, all files loaded. The scene serves
    /// this view alone; load() it again for another.
    void replayVerdicts();

    /// What to throw when files are still missing at a pose after the timeout.
    [[nodiscard]] support::Failure lateAt(const flight::CameraPose& pose) const;

    /// What a cull traversal at the pose last set does.
    [[nodiscard]] flight::Census census() { return flight::TileCensus::take(*_camera, *_frameStamp); }

    [[nodiscard]] const CullMethod& method() const { return _method; }
    [[nodiscard]] osg::Node& root() { return *_camera->getChild(0); }
    /// A camera for culling off the record: it has the scene, the view and the method's settings, and no window.
    [[nodiscard]] osg::Camera& camera() { return *_camera; }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return *_frameStamp; }
    [[nodiscard]] const flight::Globe& globe() const { return _globe; }

private:
    class Requests;

    void treatFiles(const osg::EllipsoidModel* globe);
    void awaitFiles(const flight::CameraPose& pose, std::chrono::steady_clock::time_point begin) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> read() const;
    Frame step(double seconds);
    [[nodiscard]] osgDB::DatabasePager& pager() const { return *_scene->getDatabasePager(); }
    [[nodiscard]] bool isThreadBusy() const;
    [[nodiscard]] bool isReading() const;

    const CullMethod _method;
    const Settings _settings;
    FileWatch& _watch;
    const osg::ref_ptr<osg::Camera> _camera;
    flight::Globe _globe;
    osg::ref_ptr<osgViewer::Scene> _scene;
    osg::ref_ptr<osg::FrameStamp> _frameStamp;
    osg::ref_ptr<osgUtil::UpdateVisitor> _update;
    osg::ref_ptr<Requests> _requests;
    std::optional<flight::CullStage> _stage;
};

/// How cameras cull here unless a method wants otherwise: everything but small features.
inline constexpr osg::CullSettings::CullingMode kDefaultCulling =
    osg::CullSettings::DEFAULT_CULLING & ~osg::CullSettings::SMALL_FEATURE_CULLING;

/// The globe of the database. Throws: Failure when the database cannot be read.
[[nodiscard]] flight::Globe globeOf(const Settings& settings, FileWatch& watch);

}  // namespace osgAnalyticBin::bench
