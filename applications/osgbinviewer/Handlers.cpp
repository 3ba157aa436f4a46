// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Handlers.h"

#include "ViewTools.h"

#include <osgAnalyticBin/InstallBins.h>

#include <osg/MatrixTransform>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <vector>

namespace osgAnalyticBin::viewer {

namespace {

constexpr const char* kFrustumName = "frozen frustum";

void removeFrustum(osg::Group& overlay) {
    for (unsigned int i = overlay.getNumChildren(); i-- > 0;)
        if (overlay.getChild(i)->getName() == kFrustumName) overlay.removeChildren(i, 1);
}

constexpr double kCurtainDistance = 1000.0;  // metres from the eye
constexpr double kSteepest = 5.0;            // walls of earth reach farther down than any picture

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
        const glm::dvec3 point = kCurtainDistance * (x * picture.eye.x + picture.eye.y + height * picture.eye.z);
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

TextPanel::Line changeLine(const std::string& what, std::size_t before, std::size_t now) {
    const std::string difference =
        now >= before ? "+" + std::to_string(now - before) : "-" + std::to_string(before - now);
    const osg::Vec4 colour = now == before ? kSameColour : now < before ? kFewerColour : kMoreColour;
    return {"tiles " + what + ": " + std::to_string(before) + " -> " + std::to_string(now) + "  (" + difference + ")",
            colour};
}

}  // namespace

FreezeCullHandler::FreezeCullHandler() {
    addKey('F', "Freeze the culling camera, to fly round what it draws.",
           [this](osgViewer::View& view) { setFrozen(view, !_isFrozen); });
}

void FreezeCullHandler::setFrozen(osgViewer::View& view, bool frozen) {
    _isFrozen = frozen;
    const auto globe = flight::findGlobe(*view.getSceneData());
    for (osg::Camera* camera : CameraCulling::drawingCameras(view)) {
        CameraCulling& culling = CameraCulling::of(*camera);
        culling.thaw();
        removeFrustum(culling.overlay());
        if (!frozen) continue;
        CullingView seen = CameraCulling::cullingView(*camera);
        // the window may be resized
        seen.viewport = new osg::Viewport(*seen.viewport);
        culling.freeze(seen);
        const osg::ref_ptr<osg::Node> frustum = makeFrustum(seen, globe, view.getSceneData()->getBound().radius());
        frustum->setName(kFrustumName);
        culling.overlay().addChild(frustum);
        computeBounds(*frustum);
    }
}

namespace {

constexpr std::array<TileVerdict, 6> kVerdicts{TileVerdict::Inside, TileVerdict::Straddling, TileVerdict::Outside,
                                               TileVerdict::Hidden, TileVerdict::BeyondEdge, TileVerdict::Occluded};
const osg::Vec4 kTextColour(0.9F, 0.9F, 0.9F, 1.0F);

bool isEnd(const SurveyedTile& tile) {
    return tile.isCulled || tile.isDrawn;
}

// Faces of tiles that the traversal went through would hide those of the tiles within.
osg::ref_ptr<osg::Node> makeNode(const SurveyedTile& tile) {
    const core::Ellipsoid ellipsoid(tile.ellipsoid->getRadiusEquator(), tile.ellipsoid->getRadiusPolar());
    const osg::Vec4 colour = verdictColour(tile.verdict);
    osg::Vec4 faces = colour;
    faces.a() = isEnd(tile) ? BinDisplayHandler::kOpacity : 0.0F;
    osg::ref_ptr<osg::MatrixTransform> node = new osg::MatrixTransform(tile.ecefToWorld);
    node->addChild(makeSlab(slabMesh(tile.bin.bin(), ellipsoid), faces, colour, isEnd(tile) ? 22 : 21));
    return node;
}

}  // namespace

BinDisplayHandler::BinDisplayHandler() {
    addKey('B', "Show bins by verdict: where culling ends, all, none.", [this](osgViewer::View&) {
        _shown = _shown == Shown::Nothing ? Shown::Ends : _shown == Shown::Ends ? Shown::All : Shown::Nothing;
    });
}

osg::Node* BinDisplayHandler::slabOf(const SurveyedTile& tile) {
    Slab& slab = _known[tile.node];
    const bool isKnown = slab.node && slab.bin == tile.bin && slab.verdict == tile.verdict &&
                         slab.isEnd == isEnd(tile) && slab.ecefToWorld == tile.ecefToWorld;
    if (!isKnown) slab = {tile.bin, tile.verdict, isEnd(tile), tile.ecefToWorld, makeNode(tile), true};
    slab.isUsed = true;
    return slab.node.get();
}

void BinDisplayHandler::drawSlabs(const TileSurvey& survey) {
    for (auto& [node, slab] : _known) slab.isUsed = false;
    _slabs->removeChildren(0, _slabs->getNumChildren());
    for (const SurveyedTile& tile : survey.tiles()) {
        if (!tile.hasBin || !tile.bin.valid() || !tile.ellipsoid || (_shown == Shown::Ends && !isEnd(tile))) continue;
        _slabs->addChild(slabOf(tile));
    }
    for (auto slab = _known.begin(); slab != _known.end();)
        slab = slab->second.isUsed ? std::next(slab) : _known.erase(slab);
}

void BinDisplayHandler::showLegend(const TileSurvey& survey, osg::Camera& camera) {
    std::array<std::size_t, kVerdicts.size()> numbers{};
    for (const SurveyedTile& tile : survey.tiles())
        for (std::size_t i = 0; i < kVerdicts.size(); ++i)
            if (tile.hasBin && tile.verdict == kVerdicts[i]) ++numbers[i];
    const TileCounts counts = survey.counts();
    const bool hasBins = std::any_of(numbers.begin(), numbers.end(), [](std::size_t number) { return number > 0; });
    std::vector<TextPanel::Line> lines{{std::to_string(counts.tested) + " tiles tested, " +
                                            std::to_string(counts.kept) + " kept, " + std::to_string(counts.drawn) +
                                            " drawn",
                                        kTextColour}};
    if (!hasBins) lines.push_back({"no bin decides", kTextColour});
    for (std::size_t i = 0; hasBins && i < kVerdicts.size(); ++i)
        lines.push_back({std::to_string(numbers[i]) + " " + verdictName(kVerdicts[i]), verdictColour(kVerdicts[i])});
    _legend->show(camera, lines);
}

void BinDisplayHandler::draw(osgViewer::View& view, osg::Camera& camera) {
    osg::Group& overlay = CameraCulling::of(camera).overlay();
    if (_shown == Shown::Nothing) {
        overlay.removeChild(_slabs);
        _legend->hide();
        _slabs->removeChildren(0, _slabs->getNumChildren());
        _known.clear();
        return;
    }
    if (!overlay.containsNode(_slabs)) overlay.addChild(_slabs);
    const TileSurvey survey(camera, *view.getFrameStamp());
    drawSlabs(survey);
    showLegend(survey, camera);
    computeBounds(overlay);
}

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
    for (const auto& [what, count] :
         {std::pair("tested", &TileCounts::tested), {"kept", &TileCounts::kept}, {"drawn", &TileCounts::drawn}})
        lines.push_back(isComparable ? changeLine(what, _countsBefore.*count, now.*count)
                                     : TextPanel::Line{std::string("tiles ") + what + ": " + std::to_string(now.*count),
                                                       kSameColour});
    _panel->show(camera, lines);
}

}  // namespace osgAnalyticBin::viewer
