// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KeyHandler.h"
#include "Traffic.h"

namespace osgAnalyticBin::viewer {

class TextPanel;

/// Scatters models about the camera once the terrain there is loaded, and says how many of them are drawn. Key `T`
/// scatters them anew, `G` stops and starts that terrain hides them.
class TrafficHandler : public KeyHandler {
public:
    /// Adds `count` models to the scene, behind all that is there.
    TrafficHandler(osg::Group& scene, unsigned int count);

protected:
    ~TrafficHandler() override;
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    Traffic _traffic;
    bool _isDue = true;
    bool _asks = true;
    const osg::ref_ptr<TextPanel> _panel;
};

}  // namespace osgAnalyticBin::viewer
