// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "CameraView.h"
#include "ClusterRemover.h"
#include "CullMethod.h"
#include "Failure.h"
#include "PagedScene.h"
#include "ReadCounter.h"
#include "Settings.h"
#include "TileCensus.h"

#include <chrono>
#include <optional>

namespace osgAnalyticBin::bench {

/// Counts and treats what is read for whichever scene is being shown; made once, before the first file is read.
struct FileWatch {
    FileWatch() = default;
    /// A globe may come from a plugin, which the Registry unloads before its callbacks are gone.
    ~FileWatch() { remover->setTreatment(Clusters::Keep); }
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    osg::ref_ptr<ClusterRemover> remover = ClusterRemover::install();
    osg::ref_ptr<ExpiryRaiser> expiry = ExpiryRaiser::install();
    osg::ref_ptr<flight::ReadCounter> reads = flight::ReadCounter::install();
};

/// A database with a pager of its own, culled by one method. Nothing is drawn here.
/// Scenes take turns in reading files: only the one that was loaded or resumed last does.
class MethodScene {
public:
    MethodScene(const CullMethod& method, const Settings& settings, FileWatch& watch);

    MethodScene(const MethodScene&) = delete;
    MethodScene& operator=(const MethodScene&) = delete;

    /// Reads the database's root file; pages of before are forgotten.
    /// Throws: Failure when it cannot be read or is empty.
    void load();

    /// Takes its turn after another scene had its own, or gives it up. Requires: load().
    void resume();
    void pause() { _paged->pause(); }

    /// Stands at a pose until every file that is wanted there has been read and merged. All files that one frame asks
    /// for are merged before the next frame asks for more, so that what is read depends on nothing but the pose and
    /// what was loaded before. Requires: load(), and no other scene's turn since.
    /// Throws: Failure when that takes longer than the timeout, Interrupted.
    void settle(const flight::CameraPose& pose);

    /// One frame from a pose, `seconds` after the last one, wherever the pager is. Requires: as settle().
    PagedScene::Frame flyFrame(const flight::CameraPose& pose, double seconds);

    /// The view of the camera. Requires: load().
    void setPose(const flight::CameraPose& pose);

    /// What to throw when files are still missing at a pose after the timeout.
    [[nodiscard]] support::Failure lateAt(const flight::CameraPose& pose) const;

    /// What a cull traversal at the pose last set does.
    [[nodiscard]] flight::Census census() { return flight::TileCensus::take(*_camera, _paged->frameStamp()); }

    [[nodiscard]] const CullMethod& method() const { return _method; }
    [[nodiscard]] osg::Node& root() { return *_camera->getChild(0); }
    /// A camera for culling off the record: it has the scene, the view and the method's settings, and no window.
    [[nodiscard]] osg::Camera& camera() { return *_camera; }
    [[nodiscard]] osg::FrameStamp& frameStamp() { return _paged->frameStamp(); }
    [[nodiscard]] const flight::Globe& globe() const { return _globe; }

private:
    void forget();
    void treatFiles(const osg::EllipsoidModel* globe);
    void awaitFiles(const flight::CameraPose& pose, std::chrono::steady_clock::time_point begin) const;
    [[nodiscard]] osg::ref_ptr<osg::Node> read() const;

    CullMethod _method;
    const Settings& _settings;
    FileWatch& _watch;
    osg::ref_ptr<osg::Camera> _camera;
    std::optional<PagedScene> _paged;
    flight::Globe _globe;
};

/// How cameras cull here unless a method wants otherwise: everything but small features.
inline constexpr osg::CullSettings::CullingMode kDefaultCulling =
    osg::CullSettings::DEFAULT_CULLING & ~osg::CullSettings::SMALL_FEATURE_CULLING;

}  // namespace osgAnalyticBin::bench
