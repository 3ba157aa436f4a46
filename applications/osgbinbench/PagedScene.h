// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CullStage.h"

#include <osgUtil/UpdateVisitor>
#include <osgViewer/Scene>

#include <cstdint>
#include <optional>

namespace osgAnalyticBin::bench {

/// A scene with a pager and a clock of its own, taken from frame to frame without drawing: what has been read is
/// merged, the graph is updated, then culled, and what is missing is asked for. So no frame is late because drawing it
/// took long, and time stands still while other scenes have their turn.
class PagedScene {
public:
    /// What one frame's cull traversal did.
    struct Frame {
        double cullMs = 0.0;
        std::uint64_t wanted = 0;      ///< files asked for: not loaded yet
        std::uint64_t askedAgain = 0;  ///< files asked for that earlier frames had ceased to ask for
    };

    /// `camera` has `root` for its only child, a viewport, and the view of every frame.
    PagedScene(osg::Node& root, osg::Camera& camera);
    ~PagedScene();

    PagedScene(const PagedScene&) = delete;
    PagedScene& operator=(const PagedScene&) = delete;

    /// Moves the clock on by so many seconds and does a frame's work but drawing it.
    Frame step(double seconds);

    /// The next frame is culled as the first of its visitor: nothing that an earlier frame found out counts.
    void forgetFrames();

    /// Nothing that was read is thrown away from now on.
    void keepEverything();

    /// Whether the pager's threads have work; files read count as read when they wait for being merged.
    [[nodiscard]] bool isReading() const;

    /// Whether the next frame merges something.
    [[nodiscard]] bool hasFilesToMerge() const { return pager().requiresUpdateSceneGraph(); }

    /// Holds the pager's threads until resume(). Returns: when the file that is being read has been read.
    void pause();
    void resume();

    [[nodiscard]] osg::FrameStamp& frameStamp() { return *_frameStamp; }

private:
    class Requests;

    [[nodiscard]] osgDB::DatabasePager& pager() const { return *_scene->getDatabasePager(); }
    [[nodiscard]] bool isThreadBusy() const;

    osg::Camera& _camera;
    osg::ref_ptr<osgViewer::Scene> _scene;
    osg::ref_ptr<osg::FrameStamp> _frameStamp;
    osg::ref_ptr<osgUtil::UpdateVisitor> _update;
    osg::ref_ptr<Requests> _requests;
    std::optional<flight::CullStage> _stage;
};

}  // namespace osgAnalyticBin::bench
