// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "TrafficHandler.h"

#include "TextPanel.h"

#include <osgDB/DatabasePager>

#include <string>

namespace osgAnalyticBin::viewer {

namespace {

constexpr double kReach = 30e3;  // metres

}  // namespace

TrafficHandler::TrafficHandler(osg::Group& scene, unsigned int count)
    : _traffic(count), _panel(new TextPanel(TextPanel::Corner::BottomRight)) {
    scene.addChild(&_traffic.models());
    addKey('T', "Scatter the models of --traffic about the camera.", [this](osgViewer::View&) { _isDue = true; });
    addKey('G', "Let terrain hide the models of --traffic, or not.", [this](osgViewer::View&) {
        _asks = !_asks;
        _traffic.setAsking(_asks);
    });
}
TrafficHandler::~TrafficHandler() = default;

void TrafficHandler::draw(osgViewer::View& view, osg::Camera& camera) {
    const osgDB::DatabasePager* const pager = view.getDatabasePager();
    const bool isLoaded = !pager || !(pager->getRequestsInProgress() || pager->requiresUpdateSceneGraph());
    const unsigned int drawn = _traffic.takeDrawn();
    if (_isDue && isLoaded && view.getFrameStamp()->getFrameNumber() > 1) {
        _traffic.models().removeChildren(0, _traffic.models().getNumChildren());
        _traffic.scatter(*view.getSceneData(), osg::Vec3d() * camera.getInverseViewMatrix(), kReach);
        _isDue = false;
        return;
    }
    const unsigned int models = _traffic.models().getNumChildren();
    const std::string text = std::to_string(drawn) + " of " + std::to_string(models) + " models drawn" +
                             (_asks ? "" : ", whatever terrain hides");
    _panel->show(camera, {{text, osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f)}});
}

}  // namespace osgAnalyticBin::viewer
