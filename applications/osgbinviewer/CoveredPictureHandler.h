// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KeyHandler.h"

#include <osg/Group>

namespace osgAnalyticBin::viewer {

class TextPanel;

/// Key `O`: draws a curtain over the part of the picture that terrain covers. Tiles behind the curtain are culled with
/// `occlusion=on`, and with `auto` while it is in use. With frozen culling and in a second window, the curtain stands
/// in front of the eye that culls. Where there is no curtain, a line says what is
/// missing for terrain to hide tiles. One handler for each view.
/// Cost: one TileSurvey a frame while the curtain is shown.
class CoveredPictureHandler : public KeyHandler {
public:
    CoveredPictureHandler();

    /// The curtain, in the world's frame. It has no children while nothing is drawn.
    [[nodiscard]] const osg::Group& curtain() const { return *_curtain; }

protected:
    ~CoveredPictureHandler() override;
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    bool _isShown = false;
    const osg::ref_ptr<osg::Group> _curtain;
    const osg::ref_ptr<TextPanel> _panel;
};

}  // namespace osgAnalyticBin::viewer
