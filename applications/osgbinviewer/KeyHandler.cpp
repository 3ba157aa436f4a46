// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "KeyHandler.h"

#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <string>

namespace osgAnalyticBin::viewer {

bool KeyHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
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

// OSG sorts all keys by name: a blank comes first.
void KeyHandler::getUsage(osg::ApplicationUsage& usage) const {
    for (const Key& key : _keys) usage.addKeyboardMouseBinding(std::string(" ") + static_cast<char>(key.key), key.use);
}

void KeyHandler::draw(osgViewer::View&, osg::Camera&) {}

bool KeyHandler::handleOther(const osgGA::GUIEventAdapter&, osgViewer::View&) {
    return false;
}

}  // namespace osgAnalyticBin::viewer
