// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#include "../kit/CallbackChain.h"

#include <osgAnalyticBin/AnalyticBinCullCallback.h>
#include <osgAnalyticBin/BinStatistics.h>
#include <osgAnalyticBin/Declarations.h>
#include <osgAnalyticBin/TileFinder.h>
#include <osgAnalyticBin/viewer/CameraCulling.h>
#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <osg/Geode>
#include <osg/Switch>
#include <osg/Transform>
#include <osg/View>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include <array>
#include <unordered_map>

namespace osgAnalyticBin {

namespace {

using EllipsoidOfTile = std::unordered_map<const osg::Node*, osg::ref_ptr<const osg::EllipsoidModel>>;

EllipsoidOfTile tilesBelow(osg::Group& camera) {
    EllipsoidOfTile tiles;
    for (unsigned int i = 0; i < camera.getNumChildren(); ++i) {
        for (const FoundTile& tile : findTiles(*camera.getChild(i))) tiles[tile.node.get()] = tile.frame.ellipsoid;
    }
    return tiles;
}

const AnalyticBinCullCallback* binCallbackOf(const osg::Node& node) {
    return findCallback<const AnalyticBinCullCallback>(node.getCullCallback());
}

// As osgViewer begins with: that of the view's master, and the camera's own.
std::vector<osg::StateSet*> statesOf(osg::Camera& camera) {
    std::vector<osg::StateSet*> states;
    osg::Camera* const master = camera.getView() ? camera.getView()->getCamera() : nullptr;
    if (master && master != &camera && master->getStateSet()) states.push_back(master->getStateSet());
    if (camera.getStateSet()) states.push_back(camera.getStateSet());
    return states;
}

class Surveyor : public osgUtil::CullVisitor {
public:
    Surveyor(const EllipsoidOfTile& known, const osg::Matrixd& view, std::vector<SurveyedTile>& tiles)
        : _known(known), _eyeToWorld(osg::Matrixd::inverse(view)), _tiles(tiles) {
        // what terrain hides from the camera is to be hidden here, too
        setDrawsAsCullVisitor(*this);
    }

    using osgUtil::CullVisitor::apply;
    void apply(osg::Node& node) override { visit(node); }
    void apply(osg::Geode& node) override { visit(node); }
    void apply(osg::Group& node) override { visit(node); }
    void apply(osg::LOD& node) override { visit(node); }
    void apply(osg::Switch& node) override { visit(node); }
    void apply(osg::Transform& node) override { visit(node); }
    // what is drawn to textures or on top is not this camera's view
    void apply(osg::Camera&) override {}
    void apply(osg::Drawable& drawable) override {
        reach(drawable);
        const bool isTile = open(drawable);
        const unsigned int before = _currentReuseRenderLeafIndex;
        osgUtil::CullVisitor::apply(drawable);
        if (_currentReuseRenderLeafIndex != before && !_open.empty()) {
            _tiles[_open.back().index].isDrawn = true;
            _tiles[_open.back().index].isCulled = false;
        }
        if (isTile) close();
    }

private:
    struct OpenTile {
        std::size_t index;
        const osg::Node* tile;
        BinCounts before;
        bool isDecided;
    };

    template <class NodeType>
    void visit(NodeType& node) {
        reach(node);
        const bool isTile = open(node);
        osgUtil::CullVisitor::apply(node);
        if (isTile) close();
    }

    // The tile that a node is, or whose bin it has: installers put a group with the bin above tiles that are
    // transforms.
    [[nodiscard]] const osg::Node* tileOf(osg::Node& node) const {
        if (_known.count(&node)) return &node;
        const osg::Group* const group = node.asGroup();
        const bool hasOne = group && group->getNumChildren() == 1 && _known.count(group->getChild(0)) != 0;
        return hasOne && binCallbackOf(node) ? group->getChild(0) : nullptr;
    }

    bool open(osg::Node& node) {
        const osg::Node* tile = tileOf(node);
        if (!tile || (!_open.empty() && _open.back().tile == tile)) return false;
        if (!_open.empty()) _tiles[_open.back().index].isRefined = true;
        SurveyedTile found;
        found.node = &node;
        found.isCulled = true;
        if (const AnalyticBinCullCallback* callback = binCallbackOf(node)) {
            found.bin = callback->shownBin();
            found.ellipsoid = _known.at(tile);
            found.ecefToWorld = osg::Matrixd::inverse(callback->getLocalToEcef()) * insideToWorld(node);
        }
        _open.push_back({_tiles.size(), tile, BinStatistics::of(*this).getCounts(), false});
        _tiles.push_back(found);
        return true;
    }

    void close() {
        SurveyedTile& tile = _tiles[_open.back().index];
        const bool isReached = _open.back().isDecided;
        decide();
        // OSG has culled it by its sphere
        if (!isReached && !tile.hasBin && tile.bin.valid()) {
            tile.hasBin = true;
            tile.verdict = TileVerdict::Outside;
        }
        _open.pop_back();
    }

    // A node below the innermost tile: the counters hold that tile's verdict and nothing else yet.
    void reach(const osg::Node& node) {
        if (_open.empty() || _open.back().tile == &node) return;
        decide();
        _tiles[_open.back().index].isCulled = false;
    }

    void decide() {
        OpenTile& open = _open.back();
        if (open.isDecided) return;
        open.isDecided = true;
        const BinCounts now = BinStatistics::of(*this).getCounts();
        const BinCounts& before = open.before;
        SurveyedTile& tile = _tiles[open.index];
        tile.hasBin = now.tested != before.tested;
        if (!tile.hasBin) return;
        const auto grew = [&](std::uint32_t BinCounts::*counter) { return now.*counter != before.*counter; };
        tile.isCulled = grew(&BinCounts::outside);
        tile.verdict = grew(&BinCounts::hidden)       ? TileVerdict::Hidden
                       : grew(&BinCounts::beyondEdge) ? TileVerdict::BeyondEdge
                       : grew(&BinCounts::occluded)   ? TileVerdict::Occluded
                       : grew(&BinCounts::outside)    ? TileVerdict::Outside
                       : grew(&BinCounts::inside)     ? TileVerdict::Inside
                                                      : TileVerdict::Straddling;
    }

    // From the frame of a node's children.
    [[nodiscard]] osg::Matrixd insideToWorld(osg::Node& node) {
        osg::Matrixd matrix = *getModelViewMatrix();
        if (const osg::Transform* transform = node.asTransform()) transform->computeLocalToWorldMatrix(matrix, this);
        return matrix * _eyeToWorld;
    }

    const EllipsoidOfTile& _known;
    const osg::Matrixd _eyeToWorld;
    std::vector<SurveyedTile>& _tiles;
    std::vector<OpenTile> _open;
};

struct Shown {
    const char* name;
    osg::Vec4 colour;
};

const Shown& shownAs(TileVerdict verdict) {
    static const std::array<Shown, 6> kShown{{{"outside", {0.95F, 0.08F, 0.3F, 1.0F}},
                                              {"straddling", {1.0F, 1.0F, 0.05F, 1.0F}},
                                              {"inside", {0.05F, 0.95F, 0.0F, 1.0F}},
                                              {"behind the horizon", {0.4F, 0.38F, 1.0F, 1.0F}},
                                              {"beyond an edge", {0.0F, 1.0F, 0.9F, 1.0F}},
                                              {"behind terrain", {0.95F, 0.5F, 0.0F, 1.0F}}}};
    return kShown[static_cast<std::size_t>(verdict)];
}

}  // namespace

const char* verdictName(TileVerdict verdict) {
    return shownAs(verdict).name;
}

osg::Vec4 verdictColour(TileVerdict verdict) {
    return shownAs(verdict).colour;
}

TileSurvey::TileSurvey(osg::Camera& camera, osg::FrameStamp& frameStamp) {
    const CullingView view = CameraCulling::cullingView(camera);
    const EllipsoidOfTile known = tilesBelow(camera);
    const osg::ref_ptr<osgUtil::StateGraph> graph = new osgUtil::StateGraph;
    const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    const osg::ref_ptr<Surveyor> surveyor = new Surveyor(known, view.view, _tiles);
    stage->setViewport(view.viewport);
    stage->setCamera(&camera);
    surveyor->setStateGraph(graph);
    surveyor->setRenderStage(stage);
    surveyor->setFrameStamp(&frameStamp);
    surveyor->setTraversalNumber(frameStamp.getFrameNumber());
    surveyor->inheritCullSettings(camera);
    surveyor->setTraversalMask(camera.getCullMask());
    BinStatistics::of(*surveyor).setTileByTile(true);
    // counters are reset with each frame: not between this tile and that
    BinStatistics::of(*surveyor).count(core::Side::Outside, frameStamp.getFrameNumber());
    surveyor->pushViewport(view.viewport);
    surveyor->pushProjectionMatrix(new osg::RefMatrix(view.projection));
    surveyor->pushModelViewMatrix(new osg::RefMatrix(view.view), osg::Transform::ABSOLUTE_RF);
    // what can be seen through wireframe is not hidden
    const std::vector<osg::StateSet*> states = statesOf(camera);
    for (osg::StateSet* const state : states) surveyor->pushStateSet(state);
    surveyor->traverse(camera);
    for (std::size_t i = 0; i < states.size(); ++i) surveyor->popStateSet();
    _covered = BinStatistics::of(*surveyor).covered();
    _notCovered = BinStatistics::of(*surveyor).notCovered();
    surveyor->popModelViewMatrix();
    surveyor->popProjectionMatrix();
    surveyor->popViewport();
}

TileCounts TileSurvey::counts() const {
    TileCounts counts;
    counts.tested = _tiles.size();
    for (const SurveyedTile& tile : _tiles) {
        if (!tile.isCulled) ++counts.kept;
        if (tile.isDrawn) ++counts.drawn;
        if (tile.hasBin && tile.verdict == TileVerdict::Hidden) ++counts.hidden;
        if (tile.hasBin && tile.verdict == TileVerdict::BeyondEdge) ++counts.beyondEdge;
        if (tile.hasBin && tile.verdict == TileVerdict::Occluded) ++counts.occluded;
    }
    return counts;
}

}  // namespace osgAnalyticBin
