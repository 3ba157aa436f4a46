// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TrafficHandler.h"

#include "TextPanel.h"
#include "ViewTools.h"

#include <osgDB/DatabasePager>
#include <osgViewer/View>

#include <string>

namespace osgAnalyticBin::viewer {

namespace {

constexpr double kReach = 30e3;  // metres

}  // namespace

TrafficHandler::TrafficHandler(osg::Group& scene, unsigned int count)
    : _traffic(count), _panel(new TextPanel(TextPanel::Corner::BottomRight)) {
    scene.addChild(&_traffic.models());
}
TrafficHandler::~TrafficHandler() = default;

bool TrafficHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    osgViewer::View* const view = viewOf(action);
    if (!view || isTaken(event)) return false;
    const bool isKey = event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN;
    if (isKey && event.getKey() == kKeyScatter) return _isDue = true;
    if (isKey && event.getKey() == kKeyHiding) {
        _asks = !_asks;
        _traffic.setAsking(_asks);
        return true;
    }
    if (event.getEventType() != osgGA::GUIEventAdapter::FRAME) return false;
    osg::Camera& camera = *view->getCamera();
    const osgDB::DatabasePager* const pager = view->getDatabasePager();
    const bool isLoaded = !pager || !(pager->getRequestsInProgress() || pager->requiresUpdateSceneGraph());
    const unsigned int drawn = _traffic.takeDrawn();
    if (_isDue && isLoaded && view->getFrameStamp()->getFrameNumber() > 1) {
        _traffic.models().removeChildren(0, _traffic.models().getNumChildren());
        _traffic.scatter(*view->getSceneData(), osg::Vec3d() * camera.getInverseViewMatrix(), kReach);
        _isDue = false;
        return false;
    }
    const unsigned int models = _traffic.models().getNumChildren();
    const std::string text = std::to_string(drawn) + " of " + std::to_string(models) + " models drawn" +
                             (_asks ? "" : ", whatever terrain hides");
    _panel->show(camera, {{text, osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f)}});
    return false;
}

void TrafficHandler::getUsage(osg::ApplicationUsage& usage) const {
    usage.addKeyboardMouseBinding(kKeyScatter, "Scatter the models of --traffic about the camera.");
    usage.addKeyboardMouseBinding(kKeyHiding, "Let terrain hide the models of --traffic, or not.");
}

}  // namespace osgAnalyticBin::viewer
