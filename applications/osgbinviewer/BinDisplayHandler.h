// SPDX-FileCopyrightText: 2026 osgAnalyticBin contributors
// SPDX-License-Identifier: MIT

#pragma once

#include <osgAnalyticBin/viewer/TileSurvey.h>

#include <osg/Group>
#include <osg/Vec4>
#include <osgGA/GUIEventHandler>

#include <map>

namespace osgAnalyticBin::viewer {

class TextPanel;

/// The colour that a verdict is shown in, opaque.
[[nodiscard]] osg::Vec4 verdictColour(TileVerdict verdict);

/// A short name: "outside", "straddling", "inside", "behind the horizon", "beyond an edge".
[[nodiscard]] const char* verdictName(TileVerdict verdict);

/// Key `B`: draws the bins that the view's camera tests as curved slabs, coloured by verdict: first those where its
/// cull traversal ends (tiles culled or drawn), then all, then none. Key `Q`: the same bins' quadratic approximation as
/// white lines. Bins of maps are not drawn. One handler for each view.
/// Cost: while shown, a TileSurvey for each frame.
class BinDisplayHandler : public osgGA::GUIEventHandler {
public:
    /// Which bins are drawn.
    enum class Shown {
        Nothing,  ///< none
        Ends,     ///< where the cull traversal ends: tiles culled or drawn
        All       ///< all that it came to
    };

    BinDisplayHandler();

    /// Which bins are drawn from the next frame on, as key `B` chooses.
    void setShown(Shown shown) { _shown = shown; }
    /// Which bins are drawn.
    [[nodiscard]] Shown shown() const { return _shown; }

    /// The present drawing in the world's frame, one child for each slab.
    [[nodiscard]] const osg::Group& slabs() const { return *_slabs; }

    /// Handles the keys, and draws anew at every frame. Returns: whether a key was handled.
    bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;
    /// The keys, for osgViewer::HelpHandler.
    void getUsage(osg::ApplicationUsage& usage) const override;

protected:
    ~BinDisplayHandler() override;

private:
    struct Slab {
        AnalyticBin bin;
        TileVerdict verdict;
        bool withQuadratic;
        osg::Matrixd ecefToWorld;
        osg::ref_ptr<osg::Node> node;
        bool isUsed;
    };

    void draw(const TileSurvey& survey);
    osg::Node* slabOf(const SurveyedTile& tile);
    void showLegend(const TileSurvey& survey, osg::Camera& camera);

    static constexpr int kKeyBins = 'B';
    static constexpr int kKeyQuadratic = 'Q';
    Shown _shown = Shown::Nothing;
    bool _showsQuadratic = false;
    const osg::ref_ptr<osg::Group> _slabs;
    const osg::ref_ptr<TextPanel> _legend;
    std::map<osg::ref_ptr<osg::Node>, Slab> _known;
};

}  // namespace osgAnalyticBin::viewer
