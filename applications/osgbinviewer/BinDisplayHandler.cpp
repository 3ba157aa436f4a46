// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "BinDisplayHandler.h"

#include "Slab.h"
#include "TextPanel.h"
#include "ViewTools.h"

#include <osgAnalyticBin/viewer/CameraCulling.h>

#include <osg/MatrixTransform>
#include <osgViewer/View>

#include <algorithm>
#include <array>
#include <string>

namespace osgAnalyticBin::viewer {

namespace {

constexpr float kFaceAlpha = 0.3F;
constexpr std::array<TileVerdict, 6> kVerdicts{TileVerdict::Inside, TileVerdict::Straddling, TileVerdict::Outside,
                                               TileVerdict::Hidden, TileVerdict::BeyondEdge, TileVerdict::Occluded};
const osg::Vec4 kQuadraticColour(1.0F, 1.0F, 1.0F, 1.0F);
const osg::Vec4 kTextColour(0.9F, 0.9F, 0.9F, 1.0F);

osg::ref_ptr<osg::Node> makeNode(const SurveyedTile& tile, bool withQuadratic) {
    const core::Ellipsoid ellipsoid(tile.ellipsoid->getRadiusEquator(), tile.ellipsoid->getRadiusPolar());
    const osg::Vec4 colour = verdictColour(tile.verdict);
    osg::Vec4 faces = colour;
    faces.a() = kFaceAlpha;
    osg::ref_ptr<osg::MatrixTransform> node = new osg::MatrixTransform(tile.ecefToWorld);
    node->addChild(makeSlab(slabMesh(tile.bin.bin(), ellipsoid, SlabShape::Bin), faces, colour));
    if (withQuadratic) {
        node->addChild(
            makeSlab(slabMesh(tile.bin.bin(), ellipsoid, SlabShape::Quadratic), osg::Vec4(), kQuadraticColour));
    }
    return node;
}

}  // namespace

osg::Vec4 verdictColour(TileVerdict verdict) {
    switch (verdict) {
        case TileVerdict::Outside:
            return {1.0F, 0.25F, 0.2F, 1.0F};
        case TileVerdict::Straddling:
            return {1.0F, 0.85F, 0.15F, 1.0F};
        case TileVerdict::Inside:
            return {0.3F, 1.0F, 0.35F, 1.0F};
        case TileVerdict::Hidden:
            return {0.35F, 0.6F, 1.0F, 1.0F};
        case TileVerdict::BeyondEdge:
            return {1.0F, 0.35F, 1.0F, 1.0F};
        case TileVerdict::Occluded:
            return {0.75F, 0.55F, 0.35F, 1.0F};
    }
    return kTextColour;
}

const char* verdictName(TileVerdict verdict) {
    switch (verdict) {
        case TileVerdict::Outside:
            return "outside";
        case TileVerdict::Straddling:
            return "straddling";
        case TileVerdict::Inside:
            return "inside";
        case TileVerdict::Hidden:
            return "behind the horizon";
        case TileVerdict::BeyondEdge:
            return "beyond an edge";
        case TileVerdict::Occluded:
            return "behind terrain";
    }
    return "";
}

BinDisplayHandler::BinDisplayHandler()
    : _slabs(new osg::Group), _legend(new TextPanel(TextPanel::Corner::BottomLeft)) {}
BinDisplayHandler::~BinDisplayHandler() = default;

osg::Node* BinDisplayHandler::slabOf(const SurveyedTile& tile) {
    Slab& slab = _known[tile.node];
    const bool isKnown = slab.node && slab.bin == tile.bin && slab.verdict == tile.verdict &&
                         slab.withQuadratic == _showsQuadratic && slab.ecefToWorld == tile.ecefToWorld;
    if (!isKnown)
        slab = {tile.bin, tile.verdict, _showsQuadratic, tile.ecefToWorld, makeNode(tile, _showsQuadratic), true};
    slab.isUsed = true;
    return slab.node.get();
}

void BinDisplayHandler::draw(const TileSurvey& survey) {
    for (auto& [node, slab] : _known) slab.isUsed = false;
    _slabs->removeChildren(0, _slabs->getNumChildren());
    for (const SurveyedTile& tile : survey.tiles()) {
        const bool isEnd = tile.isCulled || tile.isDrawn;
        if (!tile.hasBin || !tile.bin.valid() || !tile.ellipsoid || (_shown == Shown::Ends && !isEnd)) continue;
        _slabs->addChild(slabOf(tile));
    }
    for (auto slab = _known.begin(); slab != _known.end();) {
        slab = slab->second.isUsed ? std::next(slab) : _known.erase(slab);
    }
}

void BinDisplayHandler::showLegend(const TileSurvey& survey, osg::Camera& camera) {
    std::array<std::size_t, kVerdicts.size()> numbers{};
    std::size_t drawn = 0;
    for (const SurveyedTile& tile : survey.tiles()) {
        for (std::size_t i = 0; i < kVerdicts.size(); ++i) {
            if (tile.hasBin && tile.verdict == kVerdicts[i]) ++numbers[i];
        }
        if (tile.isDrawn) ++drawn;
    }
    const bool hasBins = std::any_of(numbers.begin(), numbers.end(), [](std::size_t number) { return number > 0; });
    std::vector<TextPanel::Line> lines{{std::to_string(survey.tiles().size()) + " tiles tested, " +
                                            std::to_string(drawn) + " drawn; " + (hasBins ? "bins:" : "no bin decides"),
                                        kTextColour}};
    for (std::size_t i = 0; hasBins && i < kVerdicts.size(); ++i) {
        lines.push_back({std::to_string(numbers[i]) + " " + verdictName(kVerdicts[i]), verdictColour(kVerdicts[i])});
    }
    if (hasBins && _showsQuadratic) lines.push_back({"the quadratic approximation", kQuadraticColour});
    _legend->show(camera, lines);
}

bool BinDisplayHandler::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) {
    osgViewer::View* view = viewOf(action);
    if (!view || isTaken(event)) return false;
    if (event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN && event.getKey() == kKeyBins) {
        _shown = _shown == Shown::Nothing ? Shown::Ends : _shown == Shown::Ends ? Shown::All : Shown::Nothing;
        return true;
    }
    if (event.getEventType() == osgGA::GUIEventAdapter::KEYDOWN && event.getKey() == kKeyQuadratic) {
        _showsQuadratic = !_showsQuadratic;
        if (_shown == Shown::Nothing) _shown = Shown::Ends;
        return true;
    }
    if (event.getEventType() != osgGA::GUIEventAdapter::FRAME) return false;
    const std::vector<osg::Camera*> cameras = CameraCulling::drawingCameras(*view);
    if (cameras.empty()) return false;
    osg::Camera& camera = *cameras.front();
    osg::Group& overlay = CameraCulling::of(camera).overlay();
    if (_shown == Shown::Nothing) {
        overlay.removeChild(_slabs);
        _legend->hide();
        _slabs->removeChildren(0, _slabs->getNumChildren());
        _known.clear();
        return false;
    }
    if (!overlay.containsNode(_slabs)) overlay.addChild(_slabs);
    const TileSurvey survey(camera, *view->getFrameStamp());
    draw(survey);
    showLegend(survey, camera);
    computeBounds(overlay);
    return false;
}

void BinDisplayHandler::getUsage(osg::ApplicationUsage& usage) const {
    usage.addKeyboardMouseBinding(kKeyBins, "Show bins by verdict: where culling ends, all, none.");
    usage.addKeyboardMouseBinding(kKeyQuadratic, "Show the quadratic approximation of the bins.");
}

}  // namespace osgAnalyticBin::viewer
