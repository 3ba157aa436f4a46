// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KeyHandler.h"

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

namespace osgAnalyticBin::viewer {

class TextPanel;

/// Keys `n` and `N`: the next and the previous culling method for the view's scene, tiles that are paged in later
/// included; the change in counts of tiles is shown for a while, as a difference while the camera does not move. One
/// handler for each scene.
class MethodSwitchHandler : public KeyHandler {
public:
    /// `options`: those that the scene's bins were installed with.
    explicit MethodSwitchHandler(const CullOptions& options = {});

    /// The present culling method.
    [[nodiscard]] const CullOptions& cullOptions() const { return _options; }

    /// Culls the view's scene by another method from the next frame on, as the keys do. Between frames only.
    void setMethod(osgViewer::View& view, Method method);

protected:
    ~MethodSwitchHandler() override;
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    void showChange(osg::Camera& camera, osg::FrameStamp& frameStamp);

    CullOptions _options;
    Method _methodBefore;
    TileCounts _countsBefore;
    osg::Matrixd _viewBefore;
    double _shownUntil = -1.0;  // reference time, seconds
    const osg::ref_ptr<TextPanel> _panel;
};

}  // namespace osgAnalyticBin::viewer
