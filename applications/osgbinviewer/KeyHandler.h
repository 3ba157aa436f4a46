// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osg/Camera>
#include <osgGA/GUIEventHandler>
#include <osgViewer/View>

#include <functional>
#include <vector>

namespace osgAnalyticBin::viewer {

/// A handler of keys of osgbinviewer's own, for one view. In the help they come before OSG's.
class KeyHandler : public osgGA::GUIEventHandler {
public:
    /// Handles the keys that no other handler has taken, and calls draw() at every frame. Returns: whether the event is
    /// handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The keys, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    /// `use`: what the key does, for the help.
    void addKey(int key, const char* use, const std::function<void(osgViewer::View&)>& press) {
        _keys.push_back({key, use, press});
    }

    /// At every frame, between cull traversals. `camera`: the first of those that draw the view's scene.
    virtual void draw(osgViewer::View& view, osg::Camera& camera);

    /// Any other event. Returns: whether it is handled.
    virtual bool handleOther(const osgGA::GUIEventAdapter& event, osgViewer::View& view);

private:
    struct Key {
        int key;
        const char* use;
        std::function<void(osgViewer::View&)> press;
    };
    std::vector<Key> _keys;
};

}  // namespace osgAnalyticBin::viewer
