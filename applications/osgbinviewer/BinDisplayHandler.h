// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include "KeyHandler.h"

#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <osg/Group>

#include <map>

namespace osgAnalyticBin::viewer {

class TextPanel;

/// Key `B`: draws the bins that the view's camera tests as curved slabs, coloured by verdict: first those where its
/// cull traversal ends (tiles culled or drawn), then also the edges of the others, then none. Key `Q`: the same bins'
/// quadratic approximation as white lines. Bins of maps are not drawn. One handler for each view.
/// Cost: while shown, a TileSurvey for each frame.
class BinDisplayHandler : public KeyHandler {
public:
    /// Which bins are drawn.
    enum class Shown {
        Nothing,  ///< none
        Ends,     ///< where the cull traversal ends: tiles culled or drawn
        All       ///< all that it came to
    };

    /// Of faces. With less, blue of the sea turns red to violet.
    static constexpr float kOpacity = 0.6F;

    BinDisplayHandler();

    /// Which bins are drawn from the next frame on, as key `B` chooses.
    void setShown(Shown shown) { _shown = shown; }
    /// Which bins are drawn.
    [[nodiscard]] Shown shown() const { return _shown; }

    /// The present drawing in the world's frame, one child for each slab.
    [[nodiscard]] const osg::Group& slabs() const { return *_slabs; }

protected:
    ~BinDisplayHandler() override;
    void draw(osgViewer::View& view, osg::Camera& camera) override;

private:
    struct Slab {
        AnalyticBin bin;
        TileVerdict verdict;
        bool isEnd;
        bool withQuadratic;
        osg::Matrixd ecefToWorld;
        osg::ref_ptr<osg::Node> node;
        bool isUsed;
    };

    void drawSlabs(const TileSurvey& survey);
    osg::Node* slabOf(const SurveyedTile& tile);
    void showLegend(const TileSurvey& survey, osg::Camera& camera);

    Shown _shown = Shown::Nothing;
    bool _showsQuadratic = false;
    const osg::ref_ptr<osg::Group> _slabs;
    const osg::ref_ptr<TextPanel> _legend;
    std::map<osg::ref_ptr<osg::Node>, Slab> _known;
};

}  // namespace osgAnalyticBin::viewer
