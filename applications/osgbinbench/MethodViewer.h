// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CameraView.h"
#include "ClusterRemover.h"
#include "CullMethod.h"
#include "FrameCapture.h"
#include "ReadCounter.h"
#include "Settings.h"
#include "TileCensus.h"

#include <osg/Timer>
#include <osgViewer/Viewer>

namespace osgAnalyticBin::bench {

/// Counts and treats what is read for whichever viewer is being flown; made once, before the first file is read.
struct FileWatch {
    osg::ref_ptr<ClusterRemover> remover = ClusterRemover::install();
    osg::ref_ptr<flight::ReadCounter> reads = flight::ReadCounter::install();
};

/// A viewer with a database of its own, culled by one method. Only one of them may read files at a time: what has been
/// settled reads none.
class MethodViewer {
public:
    /// Throws: Failure when there is nothing to draw on.
    MethodViewer(const CullMethod& method, const Settings& settings, FileWatch& watch);

    MethodViewer(const MethodViewer&) = delete;
    MethodViewer& operator=(const MethodViewer&) = delete;
    ~MethodViewer();

    /// Reads the database's root file; pages of before are forgotten.
    /// Throws: Failure when it cannot be read or is empty.
    void load();

    /// Stands at a pose until every file that is wanted there has been read and merged.
    /// Throws: Failure when that takes longer than the timeout.
    void settle(const flight::CameraPose& pose);

    /// Draws one frame from a pose, wherever the pager is.
    void drawFrame(const flight::CameraPose& pose);

    /// The picture of the pose last set. Throws: Failure when the frame does not come.
    [[nodiscard]] osg::ref_ptr<osg::Image> picture();

    /// Ends all drawing, so that the scene may be looked at by others. load() and settle() start it again.
    void rest();

    /// Requires: rest().
    [[nodiscard]] Census census();

    [[nodiscard]] const CullMethod& method() const { return _method; }
    [[nodiscard]] osg::Camera& camera() { return *_viewer.getCamera(); }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return *_viewer.getFrameStamp(); }
    [[nodiscard]] const flight::Globe& globe() const { return _globe; }
    [[nodiscard]] osgViewer::Viewer& viewer() { return _viewer; }

private:
    void setPose(const flight::CameraPose& pose);
    void wake();
    void drawUntilIdle(const flight::CameraPose& pose, osg::Timer_t begin);
    [[nodiscard]] bool isPagerIdle();
    [[nodiscard]] osg::ref_ptr<osg::Node> read() const;

    CullMethod _method;
    const Settings& _settings;
    FileWatch& _watch;
    osgViewer::Viewer _viewer;
    osg::ref_ptr<flight::FrameCapture> _capture;
    flight::Globe _globe;
    std::uint64_t _filesLastFrame = 0;
};

}  // namespace osgAnalyticBin::bench
