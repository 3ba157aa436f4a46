// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "Traffic.h"

#include <osgGA/GUIEventHandler>

namespace osgAnalyticBin::viewer {

class TextPanel;

/// Scatters models about the camera once the terrain there is loaded, and says how many of them are drawn. Key `T`
/// scatters them anew, `G` stops and starts that terrain hides them.
class TrafficHandler : public osgGA::GUIEventHandler {
public:
    /// Adds `count` models to the scene, behind all that is there.
    TrafficHandler(osg::Group& scene, unsigned int count);

    /// Handles the keys, and updates the shown text at every frame. Returns: whether a key was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The keys, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~TrafficHandler() override;

private:
    static constexpr int kKeyScatter = 'T', kKeyHiding = 'G';
    Traffic _traffic;
    bool _isDue = true;
    bool _asks = true;
    const osg::ref_ptr<TextPanel> _panel;
};

}  // namespace osgAnalyticBin::viewer
