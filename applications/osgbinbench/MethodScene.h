// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "BenchViewer.h"
#include "CameraPath.h"
#include "CameraView.h"
#include "ClusterRemover.h"
#include "CullMethod.h"
#include "ReadCounter.h"
#include "Settings.h"
#include "TileCensus.h"

#include <osg/Timer>

namespace osgAnalyticBin::bench {

/// Counts and treats what is read for whichever scene is being shown; made once, before the first file is read.
struct FileWatch {
    osg::ref_ptr<ClusterRemover> remover = ClusterRemover::install();
    osg::ref_ptr<flight::ReadCounter> reads = flight::ReadCounter::install();
};

/// A database with a pager of its own, culled by one method. Scenes take turns with the viewer; only the one that was
/// loaded last reads files.
class MethodScene {
public:
    MethodScene(const CullMethod& method, const Settings& settings, FileWatch& watch, BenchViewer& viewer);
    ~MethodScene();

    MethodScene(const MethodScene&) = delete;
    MethodScene& operator=(const MethodScene&) = delete;

    /// Reads the database's root file and shows it; pages of before are forgotten.
    /// Throws: Failure when it cannot be read or is empty.
    void load();

    /// Stands at a pose until every file that is wanted there has been read and merged.
    /// Requires: load(), and no other scene shown since.
    /// Throws: Failure when that takes longer than the timeout.
    void settle(const flight::CameraPose& pose);

    /// Draws one frame from a pose, wherever the pager is. Requires: as settle().
    void drawFrame(const flight::CameraPose& pose);

    /// What a cull traversal at the pose last set does. Requires: a viewer at rest.
    [[nodiscard]] Census census() { return TileCensus::take(*_camera, _viewer.frameStamp()); }

    [[nodiscard]] const CullMethod& method() const { return _method; }
    /// A camera for culling off the record: it has the scene, the view and the settings of the viewer's, and no window.
    [[nodiscard]] osg::Camera& camera() { return *_camera; }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return _viewer.frameStamp(); }
    [[nodiscard]] const flight::Globe& globe() const { return _globe; }

private:
    void forget();
    [[nodiscard]] osg::ref_ptr<osg::Node> read() const;
    void drawUntilIdle(const flight::CameraPose& pose, osg::Timer_t begin);
    [[nodiscard]] bool isPagerIdle();

    CullMethod _method;
    const Settings& _settings;
    FileWatch& _watch;
    BenchViewer& _viewer;
    osg::ref_ptr<osgViewer::Scene> _scene;
    osg::ref_ptr<osg::Camera> _camera;
    flight::Globe _globe;
    std::uint64_t _filesLastFrame = 0;
};

}  // namespace osgAnalyticBin::bench
