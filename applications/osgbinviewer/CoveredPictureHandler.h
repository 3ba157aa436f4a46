// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Group>
#include <osgGA/GUIEventHandler>

namespace osgAnalyticBin::viewer {

/// Key `O`: draws a curtain over the part of the picture that terrain covers. Tiles behind the curtain are culled with
/// `occlusion=on`, and with `auto` while it is in use. With frozen culling and in a second window, the curtain stands
/// in front of the eye that culls. There is no curtain while terrain hides no tile. Use one handler for each view.
/// Cost: one TileSurvey a frame while the curtain is shown.
class CoveredPictureHandler : public osgGA::GUIEventHandler {
public:
    CoveredPictureHandler();

    /// The curtain, in the world's frame. It has no children while nothing is drawn.
    [[nodiscard]] const osg::Group& curtain() const { return *_curtain; }

    /// Handles the key, and makes the curtain anew in every frame. Returns: whether the key was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The key, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~CoveredPictureHandler() override;

private:
    static constexpr int kKey = 'O';
    bool _isShown = false;
    const osg::ref_ptr<osg::Group> _curtain;
};

}  // namespace osgAnalyticBin::viewer
