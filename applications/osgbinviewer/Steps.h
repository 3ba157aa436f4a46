// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "CameraPath.h"
#include "SpyViewHandler.h"

#include <osgViewer/Viewer>

#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

/// Runs a viewer by a script, for pictures: see --steps.
class Steps {
public:
    /// `poses` may be empty. The viewer has no camera manipulator.
    Steps(osgViewer::Viewer& viewer, SpyViewHandler& spy, const std::vector<flight::CameraPose>& poses);

    /// Throws: std::runtime_error with one line for a step that cannot be understood or done.
    void run(const std::string& text);

private:
    void runOne(const std::string& verb, const std::string& value);
    void standAt(const std::string& pose);
    void press(const std::string& key);
    void orbit(const std::string& numbers);
    void drawUntilIdle();
    void drawFrames(int count);
    void takePicture(const std::string& fileName, osg::GraphicsContext* window);

    osgViewer::Viewer& _viewer;
    SpyViewHandler& _spy;
    const std::vector<flight::CameraPose> _poses;
};

}  // namespace osgAnalyticBin::viewer
