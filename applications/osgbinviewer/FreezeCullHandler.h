// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgGA/GUIEventHandler>

namespace osg {
class Camera;
class Node;
}  // namespace osg

namespace osgAnalyticBin::viewer {

/// Key `F`: freezes the culling of a view's cameras, while the view can still be moved. The tiles that were in view
/// stay drawn, with the frustum as lines and translucent sides down to the globe. `F` again: back to normal. One
/// handler for each view.
class FreezeCullHandler : public osgGA::GUIEventHandler {
public:
    FreezeCullHandler();

    /// Whether culling is frozen.
    [[nodiscard]] bool isFrozen() const { return _isFrozen; }

    /// Freezes or thaws the view's cameras, as the key does. Between frames only.
    void setFrozen(osgGA::GUIActionAdapter& view, bool frozen);

    /// Handles the key. Returns: whether it was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The keys, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~FreezeCullHandler() override;

private:
    static constexpr int kKey = 'F';
    bool _isFrozen = false;
};

}  // namespace osgAnalyticBin::viewer
