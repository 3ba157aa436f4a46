// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "Handlers.h"
#include "Slab.h"
#include "ViewTools.h"

#include <osg/MatrixTransform>

#include <algorithm>
#include <array>
#include <string>

namespace osgAnalyticBin::viewer {

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

}  // namespace osgAnalyticBin::viewer
