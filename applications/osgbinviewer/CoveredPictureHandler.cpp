// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "CoveredPictureHandler.h"

#include "IndexedGeometry.h"
#include "ViewTools.h"

#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <osg/BlendFunc>
#include <osg/Geode>
#include <osg/LineWidth>
#include <osg/MatrixTransform>
#include <osgViewer/View>

#include <algorithm>
#include <vector>

namespace osgAnalyticBin::viewer {

namespace {

constexpr double kDistance = 1000.0;  // metres from the eye to the curtain
constexpr double kSteepest = 5.0;     // walls of earth reach farther down than any picture
const osg::Vec4 kFaceColour(0.1F, 0.75F, 0.9F, 0.35F);
const osg::Vec4 kTopColour(0.3F, 1.0F, 1.0F, 1.0F);

osg::ref_ptr<osg::Geometry> makePart(osg::Vec3Array& vertices, GLenum primitives,
                                     const std::vector<unsigned int>& indices, const osg::Vec4& colour, int bin) {
    osg::ref_ptr<osg::Geometry> part = makeIndexed(vertices, primitives, indices, colour);
    osg::StateSet& state = *part->getOrCreateStateSet();
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    state.setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    state.setAttributeAndModes(new osg::LineWidth(2.0F));
    state.setRenderBinDetails(bin, "RenderBin");
    return part;
}

osg::ref_ptr<osg::Node> makeCurtain(const CoveredPicture& picture, const osg::Matrixd& ecefToWorld) {
    const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    std::vector<unsigned int> faces, tops;
    const auto addVertex = [&](double x, double y) {
        const double height = std::clamp(y, -kSteepest, kSteepest);
        const glm::dvec3 point = kDistance * (x * picture.eye.x + picture.eye.y + height * picture.eye.z);
        vertices->push_back(osg::Vec3(osg::Vec3d(point.x, point.y, point.z)));
    };
    const double step = picture.across.width() / static_cast<double>(picture.heights.size());
    for (std::size_t i = 0; i < picture.heights.size(); ++i) {
        const auto [lower, upper] = picture.heights[i];
        if (!(lower <= upper)) continue;
        const double left = picture.across.lower + step * static_cast<double>(i);
        const auto first = static_cast<unsigned int>(vertices->size());
        for (const double y : {lower, upper}) {
            addVertex(left, y);
            addVertex(left + step, y);
        }
        faces.insert(faces.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
        tops.insert(tops.end(), {first + 2, first + 3});
    }
    const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(makePart(*vertices, GL_TRIANGLES, faces, kFaceColour, 30));
    geode->addDrawable(makePart(*vertices, GL_LINES, tops, kTopColour, 31));
    const glm::dvec3& eye = picture.eye.origin;
    osg::ref_ptr<osg::MatrixTransform> placed =
        new osg::MatrixTransform(osg::Matrixd::translate(eye.x, eye.y, eye.z) * ecefToWorld);
    placed->addChild(geode);
    return placed;
}

}  // namespace

CoveredPictureHandler::CoveredPictureHandler() : _curtain(new osg::Group) {}
CoveredPictureHandler::~CoveredPictureHandler() = default;

bool CoveredPictureHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    osgViewer::View* view = viewOf(action);
    if (!view || isTaken(event)) return false;
    if (event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN && event.getKey() == kKey) {
        _isShown = !_isShown;
        return true;
    }
    if (event.getEventType() != osgGA::GUIEventAdapter::FRAME) return false;
    const std::vector<osg::Camera*> cameras = CameraCulling::drawingCameras(*view);
    if (cameras.empty()) return false;
    osg::Group& overlay = CameraCulling::of(*cameras.front()).overlay();
    _curtain->removeChildren(0, _curtain->getNumChildren());
    if (!_isShown) {
        overlay.removeChild(_curtain);
        return false;
    }
    if (!overlay.containsNode(_curtain)) overlay.addChild(_curtain);
    const TileSurvey survey(*cameras.front(), *view->getFrameStamp());
    const auto hidden = std::find_if(survey.tiles().begin(), survey.tiles().end(),
                                     [](const SurveyedTile& tile) { return tile.verdict == TileVerdict::Occluded; });
    if (survey.covered() && hidden != survey.tiles().end())
        _curtain->addChild(makeCurtain(*survey.covered(), hidden->ecefToWorld));
    computeBounds(overlay);
    return false;
}

void CoveredPictureHandler::getUsage(osg::ApplicationUsage& usage) const {
    usage.addKeyboardMouseBinding(kKey, "Show what of the picture terrain covers: tiles behind it are culled.");
}

}  // namespace osgAnalyticBin::viewer
