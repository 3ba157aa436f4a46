// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Handlers.h"

#include <osgAnalyticBin/InstallBins.h>

#include <array>
#include <string>

namespace osgAnalyticBin::viewer {

namespace {

// the comparison that most ask for comes first
constexpr std::array<Method, 4> kMethods{Method::Quadratic, Method::Sphere, Method::None, Method::Exact};
constexpr double kSecondsShown = 15.0;
const osg::Vec4 kSameColour(0.9F, 0.9F, 0.9F, 1.0F);
const osg::Vec4 kFewerColour(0.3F, 1.0F, 0.35F, 1.0F);
const osg::Vec4 kMoreColour(1.0F, 0.6F, 0.2F, 1.0F);

Method neighbour(Method method, std::size_t step) {
    std::size_t at = 0;
    while (at + 1 < kMethods.size() && kMethods[at] != method) ++at;
    return kMethods[(at + step) % kMethods.size()];
}

TextPanel::Line countLine(const std::string& what, std::size_t now) {
    return {"tiles " + what + ": " + std::to_string(now), kSameColour};
}

TextPanel::Line changeLine(const std::string& what, std::size_t before, std::size_t now) {
    const std::string difference =
        now >= before ? "+" + std::to_string(now - before) : "-" + std::to_string(before - now);
    const osg::Vec4 colour = now == before ? kSameColour : now < before ? kFewerColour : kMoreColour;
    return {"tiles " + what + ": " + std::to_string(before) + " -> " + std::to_string(now) + "  (" + difference + ")",
            colour};
}

}  // namespace

MethodSwitchHandler::MethodSwitchHandler(const CullOptions& options)
    : _options(options), _methodBefore(options.method) {
    addKey('n', "Next culling method, and its change in tiles.",
           [this](osgViewer::View& view) { setMethod(view, neighbour(_options.method, 1)); });
    addKey('N', "Previous culling method.",
           [this](osgViewer::View& view) { setMethod(view, neighbour(_options.method, kMethods.size() - 1)); });
}

void MethodSwitchHandler::setMethod(osgViewer::View& view, Method method) {
    const std::vector<osg::Camera*> cameras = CameraCulling::drawingCameras(view);
    _methodBefore = _options.method;
    if (!cameras.empty()) {
        _countsBefore = TileSurvey(*cameras.front(), *view.getFrameStamp()).counts();
        _viewBefore = CameraCulling::cullingView(*cameras.front()).view;
    }
    _options.method = method;
    setCullOptions(*view.getSceneData(), _options);
    _shownUntil = view.getFrameStamp()->getReferenceTime() + kSecondsShown;
}

void MethodSwitchHandler::draw(osgViewer::View& view, osg::Camera& camera) {
    if (_shownUntil < 0.0) return;
    osg::FrameStamp& frameStamp = *view.getFrameStamp();
    if (frameStamp.getReferenceTime() > _shownUntil) {
        _shownUntil = -1.0;
        return _panel->hide();
    }
    const TileCounts now = TileSurvey(camera, frameStamp).counts();
    // from elsewhere the difference says nothing of the method
    const bool isComparable = CameraCulling::cullingView(camera).view == _viewBefore;
    std::vector<TextPanel::Line> lines{
        {std::string("culling: ") + methodName(_methodBefore) + " -> " + methodName(_options.method), kSameColour}};
    const auto add = [&](const char* what, std::size_t TileCounts::*count) {
        lines.push_back(isComparable ? changeLine(what, _countsBefore.*count, now.*count)
                                     : countLine(what, now.*count));
    };
    add("tested", &TileCounts::tested);
    add("kept", &TileCounts::kept);
    add("drawn", &TileCounts::drawn);
    _panel->show(camera, lines);
}

}  // namespace osgAnalyticBin::viewer
