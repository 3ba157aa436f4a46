// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osg/Camera>
#include <osgGA/GUIEventHandler>
#include <osgViewer/View>

#include <functional>
#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

/// A handler of keys of osgbinviewer's own, for one view. In the help they come before OSG's.
class KeyHandler : public osgGA::GUIEventHandler {
public:
    /// Handles the keys that no other handler has taken, and calls draw() at every frame. Returns: whether the event is
    /// handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override {
        auto* const view = dynamic_cast<osgViewer::View*>(action.asView());
        if (!view || !view->getSceneData()) return false;
        if (event.getEventType() == osgGA::GUIEventAdapter::FRAME) {
            const std::vector<osg::Camera*> cameras = CameraCulling::drawingCameras(*view);
            if (!cameras.empty()) draw(*view, *cameras.front());
            return false;
        }
        if (event.getHandled()) return false;
        if (event.getEventType() != osgGA::GUIEventAdapter::KEYDOWN) return handleOther(event, *view);
        for (const Key& key : _keys) {
            if (key.key != event.getKey()) continue;
            key.press(*view);
            action.requestRedraw();
            return true;
        }
        return false;
    }

    /// The keys, for osgViewer::HelpHandler. OSG sorts all keys by name: a blank comes first.
    void getUsage(osg::ApplicationUsage& usage) const override {
        for (const Key& key : _keys)
            usage.addKeyboardMouseBinding(std::string(" ") + static_cast<char>(key.key), key.use);
    }

protected:
    /// `use`: what the key does, for the help.
    void addKey(int key, const char* use, const std::function<void(osgViewer::View&)>& press) {
        _keys.push_back({key, use, press});
    }

    /// At every frame, between cull traversals. `camera`: the first of those that draw the view's scene.
    virtual void draw(osgViewer::View& /*view*/, osg::Camera& /*camera*/) {}

    /// Any other event. Returns: whether it is handled.
    virtual bool handleOther(const osgGA::GUIEventAdapter& /*event*/, osgViewer::View& /*view*/) { return false; }

private:
    struct Key {
        int key;
        const char* use;
        std::function<void(osgViewer::View&)> press;
    };
    std::vector<Key> _keys;
};

}  // namespace osgAnalyticBin::viewer
