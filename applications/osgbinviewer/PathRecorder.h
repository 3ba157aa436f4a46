// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "KeyHandler.h"

#include <osg/Camera>

#include <optional>
#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

/// The present pose of a camera over the globe of its scene; near and far planes are those of the last frame, with some
/// room. It has no name.
/// Returns: nullopt for views that are not perspective or from near the globe's centre, and where there is no globe.
[[nodiscard]] std::optional<flight::CameraPose> recordedPose(osg::Camera& camera, double time);

/// Key `R`: starts or stops recording the view's camera into a file that osgbinbench plays: a pose every half second
/// while it moves. The file is written every five seconds, whenever recording stops, and at the end. One handler for
/// each view.
class PathRecorder : public KeyHandler {
public:
    /// `interval`: seconds between poses.
    explicit PathRecorder(const std::string& fileName, double interval = 0.5);

    /// Starts or stops, as the key does; stopping writes the file.
    void setRecording(bool recording);

    /// What has been recorded so far.
    [[nodiscard]] const std::vector<flight::CameraPose>& path() const { return _path; }

protected:
    ~PathRecorder() override;
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    void record(osg::Camera& camera, double time);
    void write();

    const std::string _fileName;
    const double _interval;
    bool _isRecording = false;
    bool _isWritten = true;
    double _lastTime = 0.0;
    double _writtenAt = -1.0;
    osg::Matrixd _lastView;
    std::vector<flight::CameraPose> _path;
};

}  // namespace osgAnalyticBin::viewer
