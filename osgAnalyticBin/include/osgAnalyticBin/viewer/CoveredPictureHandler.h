// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/Export.h>

#include <osg/Group>
#include <osgGA/GUIEventHandler>

namespace osgAnalyticBin {

/// Key `O`: draws, over the picture of the view's camera, what terrain is known to cover in it. Tiles behind that are
/// culled with `occlusion=on`, or `auto` while it is in use. Where culling is frozen, or in a second window, it stands
/// as a curtain before the eye that culls. Nothing is drawn while terrain hides nothing. One handler for each view.
/// Cost: while shown, a TileSurvey for each frame.
class OSGANALYTICBINVIEWER_EXPORT CoveredPictureHandler : public osgGA::GUIEventHandler {
public:
    CoveredPictureHandler();

    /// Default `O`.
    void setKeyEvent(int key) { _key = key; }
    /// Whether it is drawn from the next frame on, as the key chooses.
    void setShown(bool shown) { _isShown = shown; }

    /// The present drawing in the world's frame; without children while nothing is drawn.
    [[nodiscard]] const osg::Group& curtain() const { return *_curtain; }

    /// Handles the key, and draws anew at every frame. Returns: whether the key was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The key, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~CoveredPictureHandler() override;

private:
    int _key = 'O';
    bool _isShown = false;
    const osg::ref_ptr<osg::Group> _curtain;
};

}  // namespace osgAnalyticBin
