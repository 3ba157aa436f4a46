// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/CullOptions.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <osgGA/GUIEventHandler>

namespace osgAnalyticBin::viewer {

class TextPanel;

/// Keys `n` and `N`: the next and the previous culling method for the view's scene, tiles that are paged in later
/// included; the change in counts of tiles is shown for a while, as a difference while the camera does not move. One
/// handler for each scene.
class MethodSwitchHandler : public osgGA::GUIEventHandler {
public:
    /// `options`: those that the scene's bins were installed with.
    explicit MethodSwitchHandler(const CullOptions& options = {});

    /// The present culling method.
    [[nodiscard]] const CullOptions& cullOptions() const { return _options; }

    /// Culls the view's scene by another method from the next frame on, as the keys do. Between frames only.
    void setMethod(osgGA::GUIActionAdapter& view, Method method);

    /// Handles the keys, and updates the shown text at every frame. Returns: whether a key was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The keys, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~MethodSwitchHandler() override;

private:
    void showChange(osg::Camera& camera, osg::FrameStamp& frameStamp);

    static constexpr int kKeyNext = 'n';
    static constexpr int kKeyPrevious = 'N';
    CullOptions _options;
    Method _methodBefore;
    TileCounts _countsBefore;
    osg::Matrixd _viewBefore;
    double _shownUntil = -1.0;  // reference time, seconds
    const osg::ref_ptr<TextPanel> _panel;
};

}  // namespace osgAnalyticBin::viewer
