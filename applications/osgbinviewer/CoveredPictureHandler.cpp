// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Handlers.h"
#include "ViewTools.h"

#include <algorithm>
#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

namespace {

constexpr double kDistance = 1000.0;  // metres from the eye to the curtain
constexpr double kSteepest = 5.0;     // walls of earth reach farther down than any picture

// In front of everything.
osg::ref_ptr<osg::Geometry> makePart(osg::Vec3Array& vertices, GLenum primitives,
                                     const std::vector<unsigned int>& indices, float opacity, int bin) {
    osg::ref_ptr<osg::Geometry> part =
        makeIndexed(vertices, primitives, indices, osg::Vec4(1.0F, 1.0F, 1.0F, opacity), bin);
    part->getStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
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
    const glm::dvec3& eye = picture.eye.origin;
    return placed(osg::Matrixd::translate(eye.x, eye.y, eye.z) * ecefToWorld,
                  {makePart(*vertices, GL_TRIANGLES, faces, 0.35F, 30), makePart(*vertices, GL_LINES, tops, 1.0F, 31)});
}

}  // namespace

CoveredPictureHandler::CoveredPictureHandler() {
    addKey('O', "Show what of the picture terrain covers: tiles behind it are culled.",
           [this](osgViewer::View&) { _isShown = !_isShown; });
}

void CoveredPictureHandler::draw(osgViewer::View& view, osg::Camera& camera) {
    osg::Group& overlay = CameraCulling::of(camera).overlay();
    _curtain->removeChildren(0, _curtain->getNumChildren());
    _panel->hide();
    if (!_isShown) {
        overlay.removeChild(_curtain);
        return;
    }
    if (!overlay.containsNode(_curtain)) overlay.addChild(_curtain);
    const TileSurvey survey(camera, *view.getFrameStamp());
    const auto hidden = std::find_if(survey.tiles().begin(), survey.tiles().end(),
                                     [](const SurveyedTile& tile) { return tile.verdict == TileVerdict::Occluded; });
    if (survey.covered() && hidden != survey.tiles().end()) {
        _curtain->addChild(makeCurtain(*survey.covered(), hidden->ecefToWorld));
        computeBounds(overlay);
    } else {
        const char* const missing = survey.notCovered() ? survey.notCovered() : "culling by bins (key n)";
        const std::string text = survey.covered() ? "no tile is behind terrain in this view"
                                                  : std::string("terrain hides nothing; it needs ") + missing;
        _panel->show(camera, {{text, verdictColour(TileVerdict::Occluded)}});
    }
}

}  // namespace osgAnalyticBin::viewer
